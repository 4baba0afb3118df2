#include "majorant/results/internal/solver_ladder.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

constexpr const char* kFile = "libmajorant_petsc.so";

[[noreturn]] void refuse(const std::string& why) { throw Error(ErrorKind::Unreadable, why); }

}  // namespace

Json ladder_section(const LadderRecord& record) {
  Json section{{"indefinite", record.indefinite}};
  for (std::size_t k = 0; k < kRungNames.size(); ++k) {
    const LadderRecord::Use& use = record.rungs[k];
    section[std::string(kRungNames[k])] = {{"set_ups", use.set_ups},
                                           {"solves", use.solves},
                                           {"iterations", use.iterations},
                                           {"most_iterations", use.most_iterations},
                                           {"falls", use.falls}};
  }
  return section;
}

const SolverPlugin& load_solver_plugin(const std::vector<std::string>& folders) {
  const auto folder = std::find_if(folders.begin(), folders.end(), [](const std::string& f) {
    return ::access((f + "/" + kFile).c_str(), F_OK) == 0;
  });
  if (folder == folders.end())
    refuse(
        fmt::format("there is no {} in {}; build majorant where PETSc is (petsc-dev), or install "
                    "its component mpi",
                    kFile, fmt::join(folders, ", ")));
  const std::string path = *folder + "/" + kFile;
  // Global: components that MPI loads by itself look for its symbols there.
  void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (!library) {
    const char* const why = ::dlerror();
    refuse(fmt::format("{} cannot be loaded: {}; install PETSc and MPI", path, why ? why : ""));
  }
  const auto* const plugin =
      static_cast<const SolverPlugin*>(::dlsym(library, "majorant_solver_plugin"));
  if (!plugin || std::strcmp(plugin->version, MAJORANT_VERSION) != 0)
    refuse(fmt::format("{} is of version {}, this is {}; install the same of both", path,
                       plugin ? plugin->version : "?", MAJORANT_VERSION));
  return *plugin;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
