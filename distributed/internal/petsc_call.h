// Calls of PETSc, whose failures become exceptions.
//
//     require_petsc(VecCreateMPI(PETSC_COMM_WORLD, owned, size, &vector));
#pragma once

namespace majorant {

// code: a PetscErrorCode. Throws Error(Unsupported) with PETSc's words for it.
void require_petsc(int code);

}  // namespace majorant
