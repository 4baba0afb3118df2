// The functions that `majorant compare` takes from libmajorant_ceres.so.
#pragma once

#include <memory>

#include "apps/compare/least_squares.h"
#include "majorant/framework/ceres_minimizer.h"

namespace majorant::app {

struct CeresPlugin {
  const char* version;
  std::unique_ptr<Minimizer> (*gradient)(const CeresOptions&);
  std::unique_ptr<Minimizer> (*least_squares)(std::shared_ptr<const BezierTriangleSpace>,
                                              const RestShapes&, const Quadrature&,
                                              const LeastSquaresOptions&);
  // Silences glog below fatal errors. Ceres reports restarts of conjugate gradients there, whatever
  // its options say.
  void (*silence)();
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
