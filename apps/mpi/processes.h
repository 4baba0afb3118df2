// MPI and PETSc for a run: the ranks of all processes that mpirun started.
//
//     Processes processes(arguments_for_petsc);      // first thing in main
//     const std::shared_ptr<const Ranks> ranks = processes.ranks();
//     if (failed) processes.abort(2);                // ends all of them
//
// Only source files of this module include headers of MPI and PETSc.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "majorant/framework/partition.h"

namespace majorant {

class Processes {
 public:
  // petsc_options: words for PETSc's options database, "-ksp_monitor" and the like, which override
  // the library's settings. No file (.petscrc) and no variable (PETSC_OPTIONS) is obeyed, because
  // options can load libraries and write files. Create one object in a program. Without mpirun
  // there is one rank. Throws Error(Usage) for options that PETSc refuses.
  explicit Processes(const std::vector<std::string>& petsc_options);
  ~Processes();  // collective
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  const std::shared_ptr<const Ranks>& ranks() const { return ranks_; }
  // Returns those petsc_options that PETSc has not used so far, such as misspelt ones.
  std::vector<std::string> unused_options() const;
  // Ends all ranks with this exit code at once.
  [[noreturn]] void abort(int code) const;

 private:
  std::vector<std::string> words_;  // PETSc keeps pointers to them
  std::size_t own_ = 0;             // number of the library's own words; the rest are petsc_options
  std::vector<char*> pointers_;
  std::shared_ptr<const Ranks> ranks_;
};

// Returns whether this process prints messages. Also valid if no Processes could be made.
bool is_first_process();

// The traffic of this rank so far, for ranks() and inside PETSc. hypre and MUMPS are not counted.
struct Traffic {
  double messages = 0, bytes = 0;  // to single ranks
  double reductions = 0;           // among all of them
};
Traffic traffic();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
