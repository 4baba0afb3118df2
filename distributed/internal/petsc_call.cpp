#include "distributed/internal/petsc_call.h"

#include <petscsys.h>

#include <string>

#include "majorant/framework/error.h"

namespace majorant {

void require_petsc(int code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw Error(ErrorKind::Unsupported, "PETSc failed: " + std::string(text ? text : "") +
                                          " (error " + std::to_string(code) + ")");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
