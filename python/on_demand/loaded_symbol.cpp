#include "loaded_symbol.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "majorant/framework/error.h"

namespace majorant::python {
namespace {

std::filesystem::path folder_of_module() {
  Dl_info info;
  if (::dladdr(reinterpret_cast<const void*>(&loaded_address), &info) == 0) return {};
  return std::filesystem::path(info.dli_fname).parent_path();
}

}  // namespace

void* loaded_address(const LibraryOnDemand& library, const char* name) {
  const std::filesystem::path beside = folder_of_module() / library.file;
  void* const loaded =
      ::dlopen(library.is_part ? beside.c_str() : library.file, RTLD_LAZY | RTLD_LOCAL);
  void* const address = loaded ? ::dlsym(loaded, name) : nullptr;
  if (address) return address;
  const char* const why = ::dlerror();
  throw Error(ErrorKind::Unsupported,
              fmt::format("{} cannot be had: {}", library.use, why ? why : library.file));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
