#include "majorant/certify/internal/cell_findings.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>

#include "majorant/certify/internal/match_tolerance.h"
#include "majorant/elements/bernstein.h"
#include "majorant/elements/element_space.h"
#include "majorant/elements/exact_determinant.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/rounding.h"

namespace majorant {
namespace {

constexpr Index kCellsPerTask = 256;

// ---- What is known of det J on a cell for the digits of a file, which are not exactly its doubles
// (MapFile::uv_rounding) ----

Vector2 uv_at(const MapFile& file, Index cell, int k) { return file.uv.row(file.cells(cell, k)); }

// Returns the largest derivatives of the map from corner 0 towards corners 1 and 2. Their control
// points are n times differences of neighbours.
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

// Returns a bound on the difference of det J, anywhere on the cell, between the map of the file's
// digits and that of the doubles; 0 if they are the same.
double rounding_of_determinant(const MapFile& file, Index cell) {
  if (file.uv_rounding.rows() == 0) return 0;
  // If control points are off by r in every coordinate, a derivative of degree n changes by at most
  // 2 n r.
  const double off =
      2 * file.degree * file.uv_rounding(file.cells.row(cell), Eigen::all).maxCoeff();
  return 1.01 * (off * reach_of(file, cell).sum() + 2 * off * off);
}

// The determinant at a point of a cell. error: the distance from the determinant of the digits,
// including rounding here.
struct Determinant {
  double value = 0, error = 0;
};

Determinant determinant(const MapFile& file, Index cell, const Barycentric& at) {
  const Eigen::MatrixX2d gradients = bernstein_gradients(file.degree, at);
  Vector2 first = Vector2::Zero(), second = first;  // derivatives, see reach_of()
  for (int l = 0; l < gradients.rows(); ++l) {
    // Subtracting corner 0 keeps the digits.
    const Vector2 p = uv_at(file, cell, l) - uv_at(file, cell, 0);
    first += (gradients(l, 1) - gradients(l, 0)) * p;
    second -= gradients(l, 0) * p;
  }
  // At degree 1 gradients are -1, 0, 1, so that only the products are rounded; otherwise all terms
  // of a sum are.
  const double operations = file.degree == 1 ? 4 : 32.0 * static_cast<double>(gradients.rows());
  return {cross(first, second),
          rounding_of_determinant(file, cell) +
              operations * 2 * kUnitRoundoff<double> * reach_of(file, cell).prod()};
}

// Turns the exact answer for the doubles into one for the digits: the same, or Undecided.
DeterminantRange beyond_rounding(const MapFile& file, Index cell, const DeterminantRange& exact) {
  if (rounding_of_determinant(file, cell) == 0) return exact;
  const bool is_certified = exact.positive == ProofStatus::Proven;
  if (is_certified && file.degree > 1) return {};  // at degree 1 det J is constant
  const Determinant det =
      determinant(file, cell,
                  is_certified ? Barycentric::Constant(1.0 / 3)
                               : Barycentric(exact.at[0], exact.at[1], exact.at[2]));
  const bool holds = is_certified ? det.value > det.error : det.value < -det.error;
  return holds ? exact : DeterminantRange{};
}

// Throws Stopped, also within a cell.
void judge_positivity(const MapFile& file, const StopCheck& stop, CellPositivity& result) {
  const auto is_stopped = [&] { return stop() != Directive::Continue; };
  NodeNumbering numbering;
  numbering.cells = file.cells;
  numbering.node_count = static_cast<Index>(file.points.rows());
  const BezierTriangleSpace space(std::move(numbering), file.degree);
  const Eigen::Map<const Vec> x(file.uv.data(), file.uv.size());
  const auto cells = static_cast<Index>(file.cells.rows());
  std::vector<char> is_proven(to_size(cells), 0);  // by bounds in floating point
  std::atomic<std::size_t> done = 0;
  parallel_tasks((cells + kCellsPerTask - 1) / kCellsPerTask, [&](Index task, int) {
    if (is_stopped()) return;
    const Index last = std::min(cells, (task + 1) * kCellsPerTask);
    for (Index c = task * kCellsPerTask; c < last; ++c) {
      const PositivityProof proof = space.certify(c, x, ProofDepth::kFinal);
      is_proven[c] = proof.result == ProofStatus::Proven &&
                     proof.lower_bound > rounding_of_determinant(file, c);
    }
    stop.advance(done += to_size(kCellsPerTask), to_size(cells));
  });
  std::string worst;
  bool is_violated = false;
  for (Index c = 0; c < cells; ++c) {
    if (c % kCellsPerTask == 0 && is_stopped()) {
      if (!is_violated) result.finding = stopped_finding();
      if (!is_violated) return;
      break;
    }
    if (is_proven[c]) continue;
    const DeterminantRange exact = beyond_rounding(
        file, c, exact_determinant_of_triangle(file.uv(file.cells.row(c), Eigen::all), stop));
    if (exact.positive == ProofStatus::Proven) continue;
    result.not_positive.push_back(c);
    if (is_violated) continue;
    if (exact.positive == ProofStatus::Violated) {
      is_violated = true;
      worst = fmt::format("cell {}: det J <= 0 at barycentric ({:.6g}, {:.6g}, {:.6g})", c,
                          exact.at[0], exact.at[1], exact.at[2]);
    } else if (worst.empty()) {
      worst = fmt::format("cell {}: det J is not proven positive, nor is it refuted", c);
    }
  }
  if (result.not_positive.empty() && !file.folded.empty()) {
    result.finding = {
        ProofStatus::Violated,
        fmt::format(
            "face {} folds where programs cut it, from its first corner{}", file.folded.front(),
            file.folded.size() > 1 ? fmt::format(" ({} faces in all)", file.folded.size()) : "")};
    return;
  }
  const std::size_t bad = result.not_positive.size();
  if (bad > 1) worst += fmt::format(" ({} cells in all)", bad);
  result.finding = bad == 0      ? Finding{ProofStatus::Proven,
                                      count_text(static_cast<Index>(file.cells.rows()), "cell")}
                   : is_violated ? Finding{ProofStatus::Violated, worst}
                                 : Finding{ProofStatus::Undecided, worst};
}

}  // namespace

CellPositivity cell_positivity(const MapFile& file, const StopCheck& stop) {
  CellPositivity result;
  try {
    judge_positivity(file, stop, result);
  } catch (const Stopped&) {
    result.finding = stopped_finding();
  }
  return result;
}

Finding flatness_of(const MapFile& file) {
  const TriangleIndices& ix = TriangleIndices::of_degree(file.degree);
  Eigen::AlignedBox3d box;
  for (const Index p : file.cells.reshaped()) box.extend(Vector3(file.points.row(p)));
  double worst = 0;
  for (Index c = 0; c < file.cells.rows(); ++c)
    for (int l = 3; l < ix.count(); ++l) {  // corners agree in any case
      Eigen::RowVector3d flat = Eigen::RowVector3d::Zero();
      for (int k = 0; k < 3; ++k)
        flat += ix.multi(l)[k] / double(file.degree) * file.points.row(file.cells(c, k));
      worst = std::max(worst, (flat - file.points.row(file.cells(c, l))).norm());
    }
  if (std::isfinite(worst) && worst <= match_tolerance(box))
    return {ProofStatus::Proven, count_text(static_cast<Index>(file.cells.rows()), "cell")};
  return {ProofStatus::Violated,
          fmt::format("surface control points are off their flat triangles by {:g}", worst)};
}

Finding stopped_finding() { return {ProofStatus::Undecided, "stopped before it was decided"}; }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
