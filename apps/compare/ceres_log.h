// What Ceres says by itself.
#pragma once

namespace majorant {

// Ceres reports restarts of conjugate gradients through glog, whatever its options say: nothing
// below a fatal error is printed from now on, by anybody in the process. For programs that own
// theirs.
void silence_ceres();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
