// Calls of PETSc, whose failures become exceptions.
//
//     require_petsc(VecCreateMPI(PETSC_COMM_WORLD, owned, size, &vector));
#pragma once

namespace majorant {

// code: a PetscErrorCode. Throws Error(Unsupported) with PETSc's words for it.
void require_petsc(int code);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
