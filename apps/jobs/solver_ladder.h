// The interface of PETSc's solver ladder for its callers: its rungs, their records, and the exports
// of the library for programs that do not link PETSc (apps/plugins/plugin.h).
//
//   auto record = std::make_shared<LadderRecord>();
//   const Json section = linear_solver_section("mumps", OwnSolver::Unused, *record);
//
// apps/mpi/petsc_solver.h describes the rungs and when they fail.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/apps/jobs/report.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {

enum class Rung { Amg, Gamg, Icc, Mumps };
inline constexpr std::array<std::string_view, 4> kRungNames{"cg-hypre", "cg-gamg", "cg-icc",
                                                            "mumps"};

// The record of the solvers of a run, by rung.
struct LadderRecord {
  struct Use {
    long set_ups = 0, solves = 0, iterations = 0, falls = 0;  // falls: failures of the rung
    int most_iterations = 0;  // largest number of iterations in one solve
  };
  std::array<Use, kRungNames.size()> rungs{};
  long indefinite = 0;  // number of indefinite matrices
};

struct LadderOptions {
  // The first rung. Gamg is used only if it is the first.
  Rung first = Rung::Amg;
  // Systems with fewer unknowns begin with MUMPS; 0: none do.
  GlobalIndex direct_below = 0;
};

// Used: the library's own factorization has solved a system.
enum class OwnSolver { Unused, Used };

// Returns "linear_solver" of reports: {"requested", "used"} and, if PETSc solved anything, the
// record of each rung. used: all solvers that were used, "direct + cg-hypre"; null if nothing was
// solved.
Json linear_solver_section(const std::string& name, OwnSolver own, const LadderRecord& record);

// Splits --petsc-options into words for PETSc's options database: "-ksp_rtol 1e-3 -info" has three.
// Throws Error(Usage) for a word that is neither an option nor the value of the previous one, and
// for options with which PETSc prints a text and ends the program: help, version.
std::vector<std::string> petsc_words(const std::string& text);

// The symbol of libmajorant_petsc.so.
struct PetscPlugin {
  const char* version;
  // On the first call, starts MPI and PETSc as one process with these words. They end with the
  // program.
  SolverFactory (*ladder)(const LadderOptions&, std::shared_ptr<LadderRecord>,
                          const std::vector<std::string>& petsc_words);
  // Returns those of these options that PETSc has not used so far.
  std::vector<std::string> (*unused_options)();
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
