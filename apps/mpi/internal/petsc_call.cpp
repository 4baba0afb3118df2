#include "apps/mpi/internal/petsc_call.h"

#include <petscsys.h>

#include <algorithm>
#include <string>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

std::string& last_message() {
  static std::string message;
  return message;
}

PetscErrorCode keep_message(MPI_Comm, int, const char*, const char*, PetscErrorCode code,
                            PetscErrorType type, const char* message, void*) {
  if (type == PETSC_ERROR_INITIAL) last_message() = message ? message : "";
  return code;
}

}  // namespace

void keep_petsc_messages() { PetscPushErrorHandler(keep_message, nullptr); }

void require_petsc(int code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  std::string why = last_message().empty() ? text ? text : "" : last_message();
  while (!why.empty() && (why.back() == '\n' || why.back() == ' ')) why.pop_back();
  std::replace(why.begin(), why.end(), '\n', ' ');
  throw Error(ErrorKind::Unsupported,
              "PETSc failed: " + why + " (error " + std::to_string(code) + ")");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
