// Parts of the command that are libraries of their own, loaded when somebody asks for them: what
// they link (PETSc and MPI, CHOLMOD and BLAS, Ceres and glog) is no part of any other run.
//
//   const CholmodPlugin& cholmod = load_plugin<CholmodPlugin>(kCholmodPlugin);
//   std::unique_ptr<LinearSolver> solver = cholmod.make_solver();
//
// Looked for beside the program and where `make install` puts them, by absolute path, nowhere else
// (docs/trust.md). Each exports one name, `majorant_plugin`, a struct that begins with the
// version that it was built as. The program defines OPENBLAS_NUM_THREADS first (process.h).
#pragma once

#include <memory>
#include <string_view>

#include "majorant/framework/error.h"
#include "majorant/framework/linear_solver.h"

namespace majorant::app {

struct PluginFile {
  const char* name;
  // The remedies where it is missing, and where a library that it needs is; words after "; ".
  const char *missing, *broken;
  ErrorKind kind = ErrorKind::Unreadable;  // of that error
};

// libmajorant_cholmod.so.
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

// The plugin's `majorant_plugin`; it stays loaded. Throws Error of the file's kind where it is not
// there, cannot be loaded, or is of another version.
const void* plugin_symbol(const PluginFile& file);

template <class Plugin>
const Plugin& load_plugin(const PluginFile& file) {
  return *static_cast<const Plugin*>(plugin_symbol(file));
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
