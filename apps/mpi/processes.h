// MPI and PETSc around a run: the ranks of all processes that mpirun started.
//
//     Processes processes(arguments_for_petsc);      // first thing in main
//     const std::shared_ptr<const Ranks> ranks = processes.ranks();
//     if (failed) processes.abort(2);                // ends all of them
//
// The only module that includes headers of MPI and PETSc; they are in its source files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "majorant/framework/partition.h"

namespace majorant {

class Processes {
 public:
  // petsc_options: words as PETSc's options database takes them, "-ksp_monitor" and the like; what
  // this library sets by itself gives way, and nothing else is obeyed: no file (.petscrc), no
  // variable (PETSC_OPTIONS), since options load libraries and write files. One a program. Works
  // without mpirun, too: one rank. Throws Error(Usage) for options that PETSc refuses.
  explicit Processes(const std::vector<std::string>& petsc_options);
  ~Processes();  // collective
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  const std::shared_ptr<const Ranks>& ranks() const { return ranks_; }
  // Returns those of petsc_options that nothing has asked for until now: misspelt ones, say.
  std::vector<std::string> unused_options() const;
  // Ends every rank with this exit code, whatever it does at the moment.
  [[noreturn]] void abort(int code) const;

 private:
  std::vector<std::string> words_;  // PETSc keeps pointers to them
  std::size_t own_ = 0;             // of them; the others are petsc_options
  std::vector<char*> pointers_;
  std::shared_ptr<const Ranks> ranks_;
};

// Returns whether this process is the one that speaks; also where a Processes could not be made.
bool is_first_process();

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
