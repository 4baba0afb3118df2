// libmajorant_ceres.so: the Ceres methods of `majorant compare`, loaded on demand.
#include "apps/compare/ceres_plugin.h"

#include <glog/logging.h>

namespace majorant::app {
namespace {

std::unique_ptr<Minimizer> gradient(const CeresOptions& options) {
  return std::make_unique<CeresMinimizer>(options);
}

std::unique_ptr<Minimizer> least_squares(std::shared_ptr<const BezierTriangleSpace> space,
                                         const RestShapes& rest, const Quadrature& rule,
                                         const LeastSquaresOptions& options) {
  return std::make_unique<LeastSquaresMinimizer>(std::move(space), rest, rule, options);
}

void silence() { FLAGS_minloglevel = google::GLOG_FATAL; }

}  // namespace
}  // namespace majorant::app

extern "C" const majorant::app::CeresPlugin majorant_plugin{
    MAJORANT_VERSION, majorant::app::gradient, majorant::app::least_squares,
    majorant::app::silence};

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
