// libmajorant_petsc.so: loaded by `majorant` for --linear-solver mumps and cg-hypre. It exports
// only the symbol in the last line (cmake/plugin_symbols.map).
#include <cstdlib>

#include "apps/mpi/petsc_solver.h"
#include "apps/mpi/processes.h"

namespace majorant {
namespace {

// Sets variables of MPI for one process without mpirun: no daemon, no search for networks.
// Variables of the environment take precedence.
void start_alone() {
  ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  ::setenv("OMPI_MCA_pml", "ob1", 0);
  ::setenv("OMPI_MCA_btl", "self", 0);
}

const Processes& processes(const std::vector<std::string>& petsc_words) {
  static const Processes started = (start_alone(), Processes(petsc_words));
  return started;
}

SolverFactory fallback_chain(const FallbackOptions& options, std::shared_ptr<FallbackRecord> record,
                             const std::vector<std::string>& petsc_words) {
  processes(petsc_words);
  return petsc_solver(options, std::move(record));
}

std::vector<std::string> unused_options() { return processes({}).unused_options(); }

}  // namespace
}  // namespace majorant

extern "C" const majorant::PetscPlugin majorant_plugin{MAJORANT_VERSION, majorant::fallback_chain,
                                                       majorant::unused_options};

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
