#include "errors.h"

#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"

namespace majorant::python {
namespace {

namespace py = pybind11;

const char* class_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Usage:
      return "UsageError";
    case ErrorKind::Unreadable:
      return "ReadError";
    case ErrorKind::Unsupported:
      return "UnsupportedError";
    case ErrorKind::Infeasible:
      return "InfeasibleError";
    case ErrorKind::Invalid:
      return "InvalidError";
  }
  return "InternalError";
}

// What remedies of the library are called here.
constexpr std::pair<std::string_view, std::string_view> kNames[] = {
    {"repair()", "unwrap()"},
    {"make_seamless()", "seamless()"},
    {"SeamlessMethod::ScaledField", "start='scaled-field'"},
    {"texture_cuts()", "unwrap(seams='uv')"},
    {"CutMethod::Automatic", "seams='auto'"},
    {"BoundaryCondition::Fixed", "boundary='fixed'"},
    {"MapOptions::initial", "init='input'"},
    {"find_defects()", "`majorant info`"}};

std::string in_python(std::string message) {
  for (const auto& [name, here] : kNames)
    if (const std::size_t at = message.find(name); at != std::string::npos)
      message.replace(at, name.size(), here);
  return message;
}

void raise(const char* name, const std::string& message) {
  const py::object type = py::module_::import("majorant._errors").attr(name);
  PyErr_SetString(type.ptr(), in_python(message).c_str());
}

}  // namespace

void translate_errors() {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const py::builtin_exception&) {
      throw;
    } catch (const py::error_already_set&) {
      throw;
    } catch (const Error& e) {
      raise(class_of(e.kind()), e.what());
    } catch (const Stopped& stopped) {
      raise("StoppedError", std::string(stopped.what()) + " before there was a result");
    } catch (const std::bad_alloc&) {
      PyErr_SetString(PyExc_MemoryError,
                      "out of memory; take a lower degree or a smaller mesh, or allow more");
    } catch (const std::invalid_argument& e) {
      raise("UsageError", e.what());
    } catch (const std::exception& e) {
      raise("InternalError", e.what());
    }
  });
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
