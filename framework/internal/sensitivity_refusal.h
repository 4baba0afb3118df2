// The refusal of a derivative that does not exist or cannot be computed.
#pragma once

#include <string>

#include "majorant/framework/error.h"

namespace majorant {

[[noreturn]] inline void refuse_sensitivity(const std::string& why) {
  throw Error(ErrorKind::Unsupported, "Sensitivity: " + why);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
