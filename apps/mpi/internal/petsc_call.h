// Calls of PETSc, whose failures become exceptions.
//
//     require_petsc(VecCreateMPI(PETSC_COMM_WORLD, owned, size, &vector));
#pragma once

namespace majorant {

// From now on PETSc prints nothing where a call fails; what it would say is kept for require_petsc.
// Also before PetscInitialize.
void keep_petsc_messages();

// code: a PetscErrorCode. Throws Error(Unsupported) with PETSc's words for it.
void require_petsc(int code);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
