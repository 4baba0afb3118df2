// --linear-solver: what solves Newton's systems of a run, and whether a factor fits into memory.
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
#include "majorant/apps/jobs/solver_ladder.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant::app {

// "auto": direct where the factor fits.
void add_linear_solver_to(CLI::App& verb, std::string& name);

class LinearSolvers {
 public:
  enum class Runs { One, Several };  // Several at a time have nothing but the direct one

  // name: as that option takes it. Throws Error(Unreadable) where PETSc is asked for and not there,
  // Error(Unsupported) where CHOLMOD is, Error(Usage) for options that PETSc refuses.
  LinearSolvers(std::string name, const CommonOptions& common, Runs runs = Runs::One);
  LinearSolvers(const LinearSolvers&) = delete;
  LinearSolvers& operator=(const LinearSolvers&) = delete;

  // options: of runs that this object outlives, on its thread where there is one at a time.
  void apply(SolveOptions& options);

  // Before a run that goes through lower degrees, which may take hours: says where the last one
  // will not fit.
  void foresee(const SurfaceMesh& mesh, const ParametrizationOptions& options);

  // Says which of --petsc-options nothing has asked for, for the end of the run.
  void say_unused_options() const;

  Json section() const;  // linear_solver_section()
  Json memory() const;   // null where there was nothing to factorize by the direct solver

 private:
  SolverFactory load_petsc(Rung first);
  std::shared_ptr<LinearSolver> make(const SparsePattern& pattern,
                                     const DirectSolverOptions& options);
  bool gives_way(const SolverMemory& memory, int foreseen_degree);

  std::string name_;
  std::vector<std::string> petsc_words_;
  bool quiet_;
  Runs runs_;
  std::mutex mutex_;  // of what follows
  OwnSolver own_ = OwnSolver::Unused;
  bool used_cholmod_ = false;
  SolverFactory plugin_;  // makes what a plugin has that is loaded; empty: none is
  const PetscPlugin* petsc_ = nullptr;
  std::shared_ptr<LadderRecord> record_ = std::make_shared<LadderRecord>();
  SolverMemory largest_;                 // so far
  std::size_t process_ = 0;              // bytes it had then
  std::optional<std::size_t> foreseen_;  // bytes of the last degree's factor
  bool has_said_ = false;
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
