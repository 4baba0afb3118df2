// MPI and PETSc around a run: the ranks of all processes that mpirun started.
//
//     Processes processes(arguments_for_petsc);      // first thing in main
//     const std::shared_ptr<const Ranks> ranks = processes.ranks();
//     if (failed) processes.abort(2);                // ends all of them
//
// The only room that includes headers of MPI and PETSc; they are in its source files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "majorant/framework/ranks.h"

namespace majorant {

class Processes {
 public:
  // petsc_options: words as PETSc's options database takes them, "-ksp_monitor" and the like; what
  // this library sets by itself gives way. One a program. Works without mpirun, too: one rank.
  explicit Processes(const std::vector<std::string>& petsc_options);
  ~Processes();  // collective
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  const std::shared_ptr<const Ranks>& ranks() const { return ranks_; }
  // Ends every rank with this exit code, whatever it does at the moment.
  [[noreturn]] void abort(int code) const;

 private:
  std::vector<std::string> words_;  // PETSc keeps pointers to them
  std::vector<char*> pointers_;
  std::shared_ptr<const Ranks> ranks_;
};

// What this rank has sent until now, for ranks() and inside PETSc; hypre and MUMPS count for
// themselves, and are not in it.
struct Traffic {
  double messages = 0, bytes = 0;  // to single ranks
  double reductions = 0;           // among all of them
};
Traffic traffic();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
