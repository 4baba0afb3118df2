#include "apps/plugins/plugin.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

namespace majorant::app {

const void* plugin_symbol(const PluginFile& file) {
  const auto refuse = [&](const std::string& why) { throw Error(file.kind, why); };
  std::error_code unknown;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
  // Folders of plugins in a build tree and after `make install`.
  const std::filesystem::path places[] = {
      program, (program / MAJORANT_PLUGINS_FROM_PROGRAM).lexically_normal()};
  std::filesystem::path path;
  for (const auto& place : places)
    if (path.empty() && std::filesystem::exists(place / file.name, unknown))
      path = place / file.name;
  if (path.empty())
    refuse(fmt::format("there is no {} in {}, {}; {}", file.name, places[0].string(),
                       places[1].string(), file.missing));
  // RTLD_GLOBAL: components that MPI loads later look up its symbols there.
  void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (!library) {
    const char* const why = ::dlerror();
    refuse(fmt::format("{} cannot be loaded: {}; {}", path.string(), why ? why : "", file.broken));
  }
  const void* const symbol = ::dlsym(library, "majorant_plugin");
  const char* const version = symbol ? *static_cast<const char* const*>(symbol) : "?";
  if (std::strcmp(version, MAJORANT_VERSION) != 0)
    refuse(fmt::format("{} has version {}, and majorant has {}; install the same version of both",
                       path.string(), version, MAJORANT_VERSION));
  return symbol;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
