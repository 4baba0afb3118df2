#include "majorant/parametrization/seams/internal/flattening_strain.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "majorant/framework/pattern_of_pairs.h"
#include "majorant/mesh/geometry.h"

namespace majorant {
namespace {

// Bound of cotangents, and least area of a vertex in parts of the mean: needles beyond it
// are lines, as far as distortion goes.
constexpr double kMaxCotangent = 1e3;
constexpr double kMinVertexAreaRatio = 1e-6;

struct Entry {
  Index unknown;
  double value;
};
using Row = std::vector<Entry>;

void add(Row& row, Index unknown, double value) {
  for (Entry& entry : row)
    if (entry.unknown == unknown) {
      entry.value += value;
      return;
    }
  row.push_back({unknown, value});
}

double loop_length(const SurfaceMesh& mesh, const std::vector<Index>& loop) {
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    length +=
        (mesh.positions().row(loop[i]) - mesh.positions().row(loop[(i + 1) % loop.size()])).norm();
  return length;
}

// Number of the loop through the vertex, or of the longest one.
std::size_t outer_loop(const SurfaceMesh& mesh, Index outer) {
  const auto& loops = mesh.boundary_loops();
  std::size_t longest = 0;
  double most = -1;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (outer >= 0 && std::find(loops[l].begin(), loops[l].end(), outer) != loops[l].end())
      return l;
    const double length = loop_length(mesh, loops[l]);
    if (length > most) most = length, longest = l;
  }
  return longest;
}

}  // namespace

FlatteningStrain::FlatteningStrain(const SurfaceMesh& piece, Index outer, const StopCheck& stop,
                                   Ordering ordering) {
  measure(piece);
  number_unknowns(piece, outer);
  if (unknowns_ > 0) factorize(piece, ordering, stop);
}

// Angles, areas, cotangents of the surface scaled to area 1.
void FlatteningStrain::measure(const SurfaceMesh& piece) {
  area_ = Vec::Zero(piece.vertex_count());
  load_ = Vec::Constant(piece.vertex_count(), 2 * std::numbers::pi);
  cotangent_.resize(piece.half_edge_count());
  for (Index h = 0; h < piece.half_edge_count(); ++h) {
    const Index v = piece.from_vertex(h);
    const CornerAngle angle = corner_angle(piece, h);
    load_[v] -= angle.radians();
    area_[v] += angle.sine / 6;
    cotangent_[next(h)] = angle.sine * kMaxCotangent > std::abs(angle.cosine)
                              ? angle.cosine / angle.sine
                              : std::copysign(kMaxCotangent, angle.cosine);
  }
  area_ /= area_.sum();
  area_ = area_.cwiseMax(kMinVertexAreaRatio * area_.mean());
}

// The outer loop is held, any other is one unknown, as every vertex inside.
void FlatteningStrain::number_unknowns(const SurfaceMesh& piece, Index outer) {
  row_.assign(to_size(piece.vertex_count()), 0);
  const auto& loops = piece.boundary_loops();
  const std::size_t held = outer_loop(piece, outer);
  for (std::size_t l = 0; l < loops.size(); ++l) {
    for (const Index v : loops[l]) {
      row_[v] = l == held ? -1 : unknowns_;
      load_[v] -= std::numbers::pi;  // a boundary is straight at pi
    }
    if (l == held) continue;
    load_[loops[l].front()] += 2 * std::numbers::pi;  // a hole turns the other way
    ++unknowns_;
  }
  const std::vector<char> is_boundary = piece.boundary_flags();
  for (Index v = 0; v < piece.vertex_count(); ++v)
    if (!is_boundary[v]) row_[v] = unknowns_++;
}

void FlatteningStrain::factorize(const SurfaceMesh& piece, Ordering ordering,
                                 const StopCheck& stop) {
  std::vector<Row> rows(to_size(piece.vertex_count()));  // of L, in the unknowns
  for (Index h = 0; h < piece.half_edge_count(); ++h) {
    const Index a = piece.from_vertex(h), b = piece.to_vertex(h), r = row_[a], s = row_[b];
    if (r == s) continue;  // both held, or of one loop
    const double w = 0.5 * cotangent_[h];
    if (r >= 0) add(rows[a], r, w), add(rows[b], r, -w);
    if (s >= 0) add(rows[b], s, w), add(rows[a], s, -w);
  }
  pattern_ =
      std::make_unique<const SparsePattern>(pattern_of_pairs(unknowns_, 1, [&](const auto& add) {
        for (const Row& row : rows)
          for (const Entry& x : row)
            for (const Entry& y : row)
              if (y.unknown > x.unknown) add(y.unknown, x.unknown);
      }));
  Vec values = Vec::Zero(pattern_->nonzeros());
  for (std::size_t v = 0; v < rows.size(); ++v)
    for (const Entry& x : rows[v])
      for (const Entry& y : rows[v])
        if (y.unknown >= x.unknown)
          values[pattern_->slot(y.unknown, x.unknown)] +=
              x.value * y.value / area_[static_cast<Index>(v)];
  stop.poll();
  solver_ = make_direct_solver({.ordering = ordering});
  solver_->analyze(*pattern_);
  if (factorize_shifted(*solver_, *pattern_, values, kSmallestShift, stop).status !=
      FactorStatus::Ok) {
    strain_ = std::numeric_limits<double>::infinity();
    return;
  }
  Vec load = Vec::Zero(unknowns_);
  for (std::size_t v = 0; v < row_.size(); ++v)
    if (row_[v] >= 0) load[row_[v]] += load_[static_cast<Index>(v)];
  solver_->solve(load, chi_);
  strain_ = std::max(0.0, load.dot(chi_));  // the area is 1
}

double FlatteningStrain::apply(const Functional& functional, const Vec& chi) const {
  double sum = 0;
  for (const auto& [v, factor] : functional)
    if (row_[v] >= 0) sum += factor * chi[row_[v]];
  return sum;
}

FlatteningStrain::Functional FlatteningStrain::load_of(const Functional& functional) const {
  std::map<Index, double> load;
  for (const auto& [v, factor] : functional)
    if (row_[v] >= 0) load[row_[v]] += factor;
  std::erase_if(load, [](const auto& entry) { return entry.second == 0; });
  return {load.begin(), load.end()};
}

bool FlatteningStrain::is_zero(const Functional& functional) const {
  return load_of(functional).empty();
}

Eigen::MatrixXd FlatteningStrain::responses(const std::vector<Functional>& functionals,
                                            const StopCheck& stop) const {
  std::vector<DirectSolver::SparseColumn> loads;
  for (const Functional& functional : functionals) loads.push_back(load_of(functional));
  return solver_->inverse_products(unknowns_, loads, stop);
}

double stretch_of_strain(double strain) { return std::sqrt(1 + 1.5 * strain); }
double strain_of_stretch(double stretch) { return (stretch * stretch - 1) / 1.5; }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
