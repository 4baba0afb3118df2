// Calls of PETSc whose failures become exceptions.
//
//     require_petsc(VecCreateMPI(PETSC_COMM_WORLD, owned, size, &vector));
#pragma once

namespace majorant {

// Stops PETSc from printing messages about failed calls; require_petsc() gets them instead. May be
// called before PetscInitialize.
void keep_petsc_messages();

// code: a PetscErrorCode. Throws Error(Unsupported) with PETSc's message for it.
void require_petsc(int code);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
