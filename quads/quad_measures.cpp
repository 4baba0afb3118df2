#include "majorant/quads/quad_measures.h"

namespace majorant {
namespace {

double min_scaled_jacobian(const PolygonMesh&, const QuadCheck& check) {
  return check.min_scaled_jacobian;
}

double mean_scaled_jacobian(const PolygonMesh&, const QuadCheck& check) {
  return check.mean_scaled_jacobian;
}

double angle_deviation(const PolygonMesh&, const QuadCheck& check) { return check.angle_deviation; }

constexpr QuadMeasure kQuadMeasures[] = {
    {"/scaled_jacobian/min", min_scaled_jacobian},
    {"/scaled_jacobian/mean", mean_scaled_jacobian},
    {"/angle_deviation", angle_deviation},
};

}  // namespace

std::span<const QuadMeasure> quad_measures() { return kQuadMeasures; }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
