#include <new>
#include <string>

#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"
#include "majorant/mesh/refusal.h"
#include "module.h"

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

const char* python_words(Hint hint) {
  switch (hint) {
    case Hint::Repair:
      return "unwrap()";
    case Hint::CutOpen:
      return "unwrap() cuts it open";
    case Hint::MapWithHoles:
      return "parametrize() maps it with its holes";
    case Hint::Unwrap:
      return "use unwrap()";
    case Hint::OtherStart:
      return "take another start";
    case Hint::OtherStartOrUnwrap:
      return "leave out init='input', or use unwrap()";
    case Hint::AllowOverlaps:
      return "leave out bijective=True, or use unwrap()";
    case Hint::AllowOrOtherStart:
      return "leave out bijective=True or init='input', or use unwrap()";
    case Hint::CutTexture:
      return "use unwrap(seams='uv'), or take another start";
    case Hint::MakeSeamless:
      return "seamless()";
    case Hint::ScaledField:
      return "start='scaled-field'";
    case Hint::OtherCones:
      return "choose other cones";
    case Hint::AutomaticCuts:
      return "seams='auto'";
    case Hint::LeavePin:
      return "leave out its target, start from a map that meets the pins";
    case Hint::FreeBoundary:
      return "boundary='fixed'";
    case Hint::RaiseLimits:
      return "max_iterations or time_limit";
    case Hint::MapAlone:
      return "map it by itself";
    case Hint::WriteSurface:
      return "write it with msh='surface', or leave surface out";
    case Hint::MapIslands:
      return "map them anew";
    case Hint::LeaveOutLegends:
      return "leave the legends out";
  }
  return "";
}

void raise(const char* name, const std::string& message) {
  const py::object type = py::module_::import("majorant._errors").attr(name);
  PyErr_SetString(type.ptr(), message.c_str());
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
      raise(class_of(e.kind()),
            message_of(e, [](const Refusal& r) { return python_words(r.hint()); }));
    } catch (const Stopped& stopped) {
      raise("StoppedError", std::string(stopped.what()) + " before there was a result");
    } catch (const std::bad_alloc&) {
      PyErr_SetString(
          PyExc_MemoryError,
          "out of memory; use a lower degree or a smaller mesh, or raise the memory limit");
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
