// The interface of PETSc's solvers, which form a fallback chain: a method that fails hands over to
// the next one. Here are the methods, the record of their use, and the exports of the library for
// programs that do not link PETSc (apps/plugins/plugin.h).
//
//   auto record = std::make_shared<FallbackRecord>();
//   const Json section = linear_solver_section("mumps", OwnSolver::Unused, *record);
//
// apps/mpi/petsc_solver.h describes the methods and when they fail.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/apps/jobs/report.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {

enum class PetscMethod { Amg, Gamg, Icc, Mumps };
inline constexpr std::array<std::string_view, 4> kPetscMethodNames{"cg-hypre", "cg-gamg", "cg-icc",
                                                                   "mumps"};

// The use of PETSc's methods in a run.
struct FallbackRecord {
  struct Use {
    long set_ups = 0, solves = 0, iterations = 0, falls = 0;  // falls: failures of the method
    int most_iterations = 0;  // largest number of iterations in one solve
  };
  std::array<Use, kPetscMethodNames.size()> methods{};
  long indefinite = 0;  // number of indefinite matrices
};

struct FallbackOptions {
  // The first method of the chain. Gamg is used only if it is the first.
  PetscMethod first = PetscMethod::Amg;
  // Systems with fewer unknowns begin with MUMPS; 0: none do.
  GlobalIndex direct_below = 0;
};

// Used: the library's own factorization has solved a system.
enum class OwnSolver { Unused, Used };

// Returns "linear_solver" of reports: {"requested", "used"} and, if PETSc solved anything, the
// record of each method. used: all solvers that were used, "direct + cg-hypre"; null if nothing was
// solved.
Json linear_solver_section(const std::string& name, OwnSolver own, const FallbackRecord& record);

// Splits --petsc-options into words for PETSc's options database: "-ksp_rtol 1e-3 -info" has three.
// Throws Error(Usage) for a word that is neither an option nor the value of the previous one, and
// for options with which PETSc prints a text and ends the program: help, version.
std::vector<std::string> petsc_words(const std::string& text);

// The symbol of libmajorant_petsc.so.
struct PetscPlugin {
  const char* version;
  // On the first call, starts MPI and PETSc as one process with these words. They end with the
  // program.
  SolverFactory (*fallback_chain)(const FallbackOptions&, std::shared_ptr<FallbackRecord>,
                                  const std::vector<std::string>& petsc_words);
  // Returns those of these options that PETSc has not used so far.
  std::vector<std::string> (*unused_options)();
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
