#include "apps/compare/ceres_log.h"

#include <glog/logging.h>

namespace majorant {

void silence_ceres() { FLAGS_minloglevel = google::GLOG_FATAL; }

}  // namespace majorant
