// libmajorant_petsc.so: what `majorant` loads for --linear-solver mumps and cg-hypre. Shown is the
// last line alone (plugin_symbols.map).
#include <cstdlib>

#include "distributed/petsc_solver.h"
#include "distributed/processes.h"

namespace majorant {
namespace {

// One process, which nobody started by mpirun: no daemon beside it, and no search for networks.
// Variables that are set already win.
void start_alone() {
  ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  ::setenv("OMPI_MCA_pml", "ob1", 0);
  ::setenv("OMPI_MCA_btl", "self", 0);
}

SolverFactory ladder(const LadderOptions& options, std::shared_ptr<LadderRecord> record) {
  static const Processes processes = (start_alone(), Processes({}));
  return petsc_solver(options, std::move(record));
}

}  // namespace
}  // namespace majorant

extern "C" const majorant::SolverPlugin majorant_solver_plugin{MAJORANT_VERSION, majorant::ladder};

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
