#include "apps/compare/ceres_log.h"

#include <glog/logging.h>

namespace majorant {

void silence_ceres() { FLAGS_minloglevel = google::GLOG_FATAL; }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
