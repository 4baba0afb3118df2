#include "majorant/parametrization/fields/internal/cone_potential.h"

namespace majorant {
ConePotential::ConePotential(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                             const std::vector<int>& quarter_turns)
    : mesh_(mesh),
      geometry_(geometry),
      row_(to_size(mesh.vertex_count()), -1),
      charge_(Vec::Zero(mesh.vertex_count())),
      potential_(Vec::Zero(mesh.vertex_count())) {
  const bool closed = mesh.boundary_loops().empty();
  Index size = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!geometry.is_boundary[v] && !(closed && v == 0)) row_[v] = size++;
  if (size == 0) return;
  std::vector<SparseSpd::Entry> entries;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (mesh.opposite(h) < 0) continue;
    const Index r = row_[mesh.to_vertex(h)], c = row_[mesh.from_vertex(h)];
    if (r < 0) continue;
    entries.push_back({r, r, 1 / geometry.weight[h]});
    if (c > r) entries.push_back({r, c, -1 / geometry.weight[h]});
  }
  system_ = field_system(size, 1, entries);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!geometry.is_boundary[v]) charge_[v] = geometry.angle_sum[v] - kQuarter * quarter_turns[v];
  potential_ = solve(charge_);
}

Vec ConePotential::solve(const Vec& charge) const {
  Vec out = Vec::Zero(mesh_.vertex_count());
  if (!system_) return out;
  Vec rhs(system_->size());
  for (Index v = 0; v < mesh_.vertex_count(); ++v)
    if (row_[v] >= 0) rhs[row_[v]] = charge[v];
  const Vec x = system_->solve(rhs);
  for (Index v = 0; v < mesh_.vertex_count(); ++v)
    if (row_[v] >= 0) out[v] = x[row_[v]];
  return out;
}

const Vec& ConePotential::response(Index v) {
  const auto [place, is_new] = responses_.try_emplace(v);
  if (is_new) {
    Vec unit = Vec::Zero(mesh_.vertex_count());
    unit[v] = 1;
    place->second = solve(unit);
  }
  return place->second;
}

double ConePotential::energy() const { return 0.5 * charge_.dot(potential_); }

double ConePotential::change(Index from, Index to) {
  const Vec &r = response(from), &s = response(to);
  return kQuarter * (potential_[from] - potential_[to]) +
         0.5 * kQuarter * kQuarter * (r[from] - r[to] - s[from] + s[to]);
}

double ConePotential::estimated_change(Index v, Index w, int step) {
  const Vec& r = response(v);
  return step * kQuarter * (potential_[v] - potential_[w]) + kQuarter * kQuarter * (r[v] - r[w]);
}

void ConePotential::move(Index from, Index to) {
  potential_ += kQuarter * (response(from) - response(to));
  if (!geometry_.is_boundary[from]) charge_[from] += kQuarter;
  if (!geometry_.is_boundary[to]) charge_[to] -= kQuarter;
}

Vec ConePotential::rotations() const {
  Vec rotation = Vec::Zero(mesh_.half_edge_count());
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (mesh_.opposite(h) >= 0)
      rotation[h] =
          (potential_[mesh_.to_vertex(h)] - potential_[mesh_.from_vertex(h)]) / geometry_.weight[h];
  return rotation;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
