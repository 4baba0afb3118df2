#include "majorant/certify/internal/rounded_determinant.h"

#include "majorant/elements/internal/bernstein.h"
#include "majorant/framework/internal/rounding.h"

namespace majorant {
namespace {

Vector2 uv_at(const MapFile& file, Index cell, int k) { return file.uv.row(file.cells(cell, k)); }

// The largest derivatives of the map from corner 0 towards corners 1 and 2: control points of them
// are n times differences of neighbours.
Vector2 reach_of(const MapFile& file, Index cell) {
  const TriangleIndices& ix = TriangleIndices::of_degree(file.degree);
  Vector2 largest = Vector2::Zero();
  for (int l = 0; l < ix.count(); ++l) {
    const auto [i, j, k] = ix.multi(l);
    if (i == 0) continue;
    const Vector2 from = uv_at(file, cell, l);
    const Vector2 first = uv_at(file, cell, ix.local(i - 1, j + 1, k)) - from;
    const Vector2 second = uv_at(file, cell, ix.local(i - 1, j, k + 1)) - from;
    largest = largest.cwiseMax(Vector2(first.lpNorm<1>(), second.lpNorm<1>()));
  }
  return file.degree * largest;
}

// At a point of a cell; error: how far it may be from that of the digits, rounding here included.
struct Determinant {
  double value = 0, error = 0;
};

Determinant determinant(const MapFile& file, Index cell, const Barycentric& at) {
  const Eigen::MatrixX2d gradients = bernstein_gradients(file.degree, at);
  Vector2 first = Vector2::Zero(), second = first;  // derivatives as in reach_of()
  for (int l = 0; l < gradients.rows(); ++l) {
    const Vector2 p = uv_at(file, cell, l) - uv_at(file, cell, 0);  // differences keep their digits
    first += (gradients(l, 1) - gradients(l, 0)) * p;
    second -= gradients(l, 0) * p;
  }
  // Of the product alone at degree 1, where gradients are -1, 0, 1; else of all terms of a sum.
  const double operations = file.degree == 1 ? 4 : 32.0 * static_cast<double>(gradients.rows());
  return {cross(first, second),
          rounding_of_determinant(file, cell) +
              operations * 2 * kUnitRoundoff<double> * reach_of(file, cell).prod()};
}

}  // namespace

double rounding_of_determinant(const MapFile& file, Index cell) {
  if (file.uv_rounding.rows() == 0) return 0;
  // A control point off by r in every coordinate moves a derivative of degree n by 2 n r.
  const double off =
      2 * file.degree * file.uv_rounding(file.cells.row(cell), Eigen::all).maxCoeff();
  return 1.01 * (off * reach_of(file, cell).sum() + 2 * off * off);
}

CellPositivity beyond_rounding(const MapFile& file, Index cell, const CellPositivity& exact) {
  if (rounding_of_determinant(file, cell) == 0) return exact;
  const bool is_certified = exact.result == ProofStatus::Proven;
  if (is_certified && file.degree > 1) return {};  // at degree 1 it is the same everywhere
  const Determinant det =
      determinant(file, cell, is_certified ? Barycentric::Constant(1.0 / 3) : exact.at);
  const bool holds = is_certified ? det.value > det.error : det.value < -det.error;
  return holds ? exact : CellPositivity{};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
