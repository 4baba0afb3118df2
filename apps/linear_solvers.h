// --linear-solver: chooses the linear solver of a run, by whether a factor fits into memory.
//
//   LinearSolvers solvers("cg-hypre", common);   // loads the plugin that has it
//   solvers.apply(options.solve);
//   solvers.foresee(*mesh, options);
//   parametrize(mesh, options);
//   const Json used = solvers.section(), memory = solvers.memory();   // for the report
#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "majorant/apps/jobs/machine_memory.h"
#include "majorant/apps/jobs/petsc_fallback.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant::app {

// Adds the option. "auto" is direct if the factor fits.
void add_linear_solver_to(CLI::App& verb, std::string& name);

class LinearSolvers {
 public:
  enum class Runs { One, Several };  // runs that solve several problems at a time always use direct

  // name: a value of the option. Throws Error(Unreadable) if PETSc is named and missing,
  // Error(Unsupported) if CHOLMOD is, Error(Usage) for options that PETSc refuses.
  LinearSolvers(std::string name, const CommonOptions& common, Runs runs = Runs::One);
  LinearSolvers(const LinearSolvers&) = delete;
  LinearSolvers& operator=(const LinearSolvers&) = delete;

  // Sets the solver of these options. This object must outlive the runs; a single run stays on this
  // object's thread.
  void apply(SolveOptions& options);

  // Prints a warning before a run through several degrees, which may take hours, if the factor of
  // the last degree will not fit.
  void foresee(const SurfaceMesh& mesh, const ParametrizationOptions& options);

  // Prints the words of --petsc-options that PETSc did not use. Call it at the end of the run.
  void say_unused_options() const;

  Json section() const;  // for the report: linear_solver_section()
  Json memory() const;   // for the report; null if the direct solver factorized nothing

 private:
  SolverFactory load_petsc(PetscMethod first);
  std::shared_ptr<LinearSolver> make(const SparsePattern& pattern,
                                     const DirectSolverOptions& options);
  bool gives_way(const SolverMemory& memory, int foreseen_degree);

  std::string name_;
  std::vector<std::string> petsc_words_;
  bool quiet_;
  Runs runs_;
  std::mutex mutex_;  // guards the members below
  OwnSolver own_ = OwnSolver::Unused;
  bool used_cholmod_ = false;
  SolverFactory plugin_;  // makes the solver of a loaded plugin; empty: no plugin is loaded
  const PetscPlugin* petsc_ = nullptr;
  std::shared_ptr<FallbackRecord> record_ = std::make_shared<FallbackRecord>();
  SolverMemory largest_;                 // the largest so far
  std::size_t process_ = 0;              // bytes of the process at that time
  std::optional<std::size_t> foreseen_;  // bytes of the factor at the last degree
  bool has_warned_ = false;
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
