// The ladder of PETSc's linear solvers, as those see it who ask for it: its rungs, what they did,
// and what the library exports that programs load which do not link PETSc (apps/plugins/plugin.h).
//
//   auto record = std::make_shared<LadderRecord>();
//   const Json section = linear_solver_section("mumps", OwnSolver::Unused, *record);
//
// The rungs of the ladder, and when they fail: apps/mpi/petsc_solver.h.
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

// The record of the solvers of a run, rung by rung.
struct LadderRecord {
  struct Use {
    long set_ups = 0, solves = 0, iterations = 0, falls = 0;  // falls: what failed there
    int most_iterations = 0;                                  // of one solve
  };
  std::array<Use, kRungNames.size()> rungs{};
  long indefinite = 0;  // matrices
};

struct LadderOptions {
  // The first rung; Gamg is not on the way down of the others.
  Rung first = Rung::Amg;
  // Systems of fewer unknowns begin with MUMPS, 0: none does.
  GlobalIndex direct_below = 0;
};

// Used: the library's own factorization has solved something.
enum class OwnSolver { Unused, Used };

// "linear_solver" of reports: {"requested", "used"} and, where PETSc solved anything, what each
// rung of the ladder did. used: all that did, "direct + cg-hypre"; null where there was nothing to
// solve.
Json linear_solver_section(const std::string& name, OwnSolver own, const LadderRecord& record);

// The words of --petsc-options, for PETSc's options database: "-ksp_rtol 1e-3 -info" has three.
// Throws Error(Usage) for what is neither an option nor the value of the one before it, and for
// options by which PETSc prints a text and ends the program: help, version.
std::vector<std::string> petsc_words(const std::string& text);

// libmajorant_petsc.so.
struct PetscPlugin {
  const char* version;
  // Starts MPI and PETSc when it is called first, as one process and with these words; they end
  // with the program.
  SolverFactory (*ladder)(const LadderOptions&, std::shared_ptr<LadderRecord>,
                          const std::vector<std::string>& petsc_words);
  // The options among these words that nothing has asked for until now.
  std::vector<std::string> (*unused_options)();
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
