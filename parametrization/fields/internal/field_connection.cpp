#include "majorant/parametrization/fields/internal/field_connection.h"

#include <fmt/format.h>

#include <cmath>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"

namespace majorant {
namespace {

// The largest distance to the nearest integer that counts as rounding. Sums of thousands of angles
// round to 1e-12, and any value below 1/2 would do; a larger distance is an error of logic.
constexpr double kIntegerTolerance = 1e-3;

double nearest_integer(const SurfaceMesh& mesh, double value) {
  const double n = std::round(value);
  if (!(std::abs(value - n) <= kIntegerTolerance))
    throw Error(ErrorKind::Invalid,
                fmt::format("{}a cross field has {} quarter turns, not an integer; check the "
                            "mesh for nearly degenerate faces",
                            message_prefix(mesh), value));
  return n;
}

}  // namespace

FieldConnection nearest_matching(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                 const Vec& angle) {
  FieldConnection field{angle, Vec::Zero(mesh.half_edge_count()), {}};
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o < h) continue;  // the boundary has -1
    const double difference = angle[face_of(o)] - angle[face_of(h)] - geometry.transport[h];
    field.rotation[h] = difference - kQuarter * std::round(difference / kQuarter);
    field.rotation[o] = -field.rotation[h];
  }
  field.quarter_turns = count_quarter_turns(mesh, geometry, field.rotation);
  return field;
}

std::vector<int> count_quarter_turns(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                     const Vec& rotation) {
  Vec left = geometry.angle_sum;
  // The half-edges that enter v are those crossed on a counterclockwise path around v.
  for (Index h = 0; h < mesh.half_edge_count(); ++h) left[mesh.to_vertex(h)] -= rotation[h];
  std::vector<int> quarter_turns(to_size(mesh.vertex_count()), 0);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!geometry.is_boundary[v])
      quarter_turns[v] = static_cast<int>(nearest_integer(mesh, left[v] / kQuarter));
  return quarter_turns;
}

void move_quarter(const SurfaceMesh& mesh, const FieldGeometry& geometry, Index half_edge,
                  FieldConnection& field) {
  field.rotation[half_edge] -= kQuarter;
  field.rotation[mesh.opposite(half_edge)] += kQuarter;
  const Index from = mesh.from_vertex(half_edge), to = mesh.to_vertex(half_edge);
  if (!geometry.is_boundary[from]) --field.quarter_turns[from];
  if (!geometry.is_boundary[to]) ++field.quarter_turns[to];
}

Relaxation::Relaxation(const SurfaceMesh& mesh, const FieldGeometry& geometry, const Vec& hold)
    : mesh_(mesh), geometry_(geometry), is_free_((hold.array() == 0).all()) {
  Index size = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const bool eliminated = is_free_ ? f == 0 : std::isinf(hold[f]);
    row_.push_back(eliminated ? -1 : size++);
  }
  if (size == 0) return;
  std::vector<SparseSpd::Entry> entries;
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (const Index r = row_[f]; r >= 0) entries.push_back({r, r, hold[f]});
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h), r = row_[face_of(h)];
    if (o < 0 || r < 0) continue;
    const Index c = row_[face_of(o)];
    entries.push_back({r, r, geometry.weight[h]});
    if (c > r) entries.push_back({r, c, -geometry.weight[h]});
  }
  system_ = field_system(size, 1, entries);
}

void Relaxation::apply(Vec& angle, Vec& rotation) const {
  if (!system_) return;
  Vec rhs = Vec::Zero(system_->size());
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (const Index r = row_[face_of(h)]; r >= 0) rhs[r] += geometry_.weight[h] * rotation[h];
  const Vec x = system_->solve(rhs);
  Vec turned = Vec::Zero(mesh_.face_count());
  for (Index f = 0; f < mesh_.face_count(); ++f)
    if (row_[f] >= 0) turned[f] = x[row_[f]];
  if (is_free_) turned.array() -= turned.dot(geometry_.face_area) / geometry_.face_area.sum();
  angle += turned;
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (mesh_.opposite(h) >= 0)
      rotation[h] += turned[face_of(mesh_.opposite(h))] - turned[face_of(h)];
}

CrossField cross_field(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                       const FieldConnection& field) {
  CrossField out{Vec(mesh.face_count()), std::vector<int>(to_size(mesh.half_edge_count()), 0),
                 count_quarter_turns(mesh, geometry, field.rotation)};
  for (Index f = 0; f < mesh.face_count(); ++f)
    out.angle[f] = std::remainder(field.angle[f], 4 * kQuarter);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o < h) continue;
    const double turns = nearest_integer(mesh, (out.angle[face_of(o)] - out.angle[face_of(h)] -
                                                geometry.transport[h] - field.rotation[h]) /
                                                   kQuarter);
    const int k = (static_cast<int>(turns) % 4 + 4) % 4;
    out.turns[h] = k;
    out.turns[o] = (4 - k) % 4;
  }
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
