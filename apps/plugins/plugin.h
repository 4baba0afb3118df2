// Parts of the command in libraries that are loaded on demand. Their dependencies (PETSc and MPI,
// CHOLMOD and BLAS, Ceres and glog) do not burden other runs.
//
//   const CholmodPlugin& cholmod = load_plugin<CholmodPlugin>(kCholmodPlugin);
//   std::unique_ptr<LinearSolver> solver = cholmod.make_solver();
//
// Plugins are looked up by absolute path beside the program and where `make install` puts them,
// nowhere else (docs/trust.md). Each exports one symbol, `majorant_plugin`, a struct that begins
// with its version. The program defines OPENBLAS_NUM_THREADS first (process.h).
#pragma once

#include <memory>
#include <string_view>

#include "majorant/framework/error.h"
#include "majorant/framework/linear_solver.h"

namespace majorant::app {

struct PluginFile {
  const char* name;
  // Remedies for a missing plugin, and for a missing library that it needs; they follow "; ".
  const char *missing, *broken;
  ErrorKind kind = ErrorKind::Unreadable;  // of the error
};

// The symbol of libmajorant_cholmod.so.
struct CholmodPlugin {
  const char* version;
  std::unique_ptr<LinearSolver> (*make_solver)();
};

inline constexpr PluginFile kPetscPlugin{
    "libmajorant_petsc.so",
    "build majorant where PETSc is (petsc-dev), or install its component mpi",
    "install PETSc and MPI"};
inline constexpr PluginFile kCholmodPlugin{
    "libmajorant_cholmod.so",
    "build majorant with its GPL parts where CHOLMOD is (libsuitesparse-dev)",
    "install CHOLMOD (libcholmod3)", ErrorKind::Unsupported};
inline constexpr PluginFile kCeresPlugin{
    "libmajorant_ceres.so", "build majorant with its GPL parts (libceres-dev)",
    "install what Ceres needs (libgoogle-glog0v5, libcholmod3, libcxsparse3)"};

// Returns the symbol `majorant_plugin` of a plugin, which stays loaded. Throws Error of the file's
// kind if the plugin is missing, cannot be loaded, or has another version.
const void* plugin_symbol(const PluginFile& file);

template <class Plugin>
const Plugin& load_plugin(const PluginFile& file) {
  return *static_cast<const Plugin*>(plugin_symbol(file));
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
