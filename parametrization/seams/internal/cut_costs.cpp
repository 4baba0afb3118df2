#include "majorant/parametrization/seams/internal/cut_costs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "majorant/mesh/geometry.h"

namespace majorant {
namespace {

// Dihedral angles, degrees, at which edges begin to be sharp and are fully sharp. A smooth surface
// of 1000 faces bends by up to 30 degrees at its edges, a box by 90.
constexpr double kSharpFrom = 40, kSharpTo = 70;
// The cost of a crease, relative to its length. A seam along it costs half of the length, a chart
// bent over it a quarter; the difference decides.
constexpr double kCreaseCost = 0.25;
// The cost of an edge inside a polygon, relative to its length: more than any detour.
constexpr double kInnerCost = 1e6;
// The least length of an edge, relative to the mean one, so that no path is free; far below any
// usable edge.
constexpr double kMinLengthRatio = 1e-9;

}  // namespace

Vector3 area_vector(const SurfaceMesh& mesh, Index face) {
  const Vector3 a = mesh.positions().row(mesh.faces()(face, 0)),
                b = mesh.positions().row(mesh.faces()(face, 1)),
                c = mesh.positions().row(mesh.faces()(face, 2));
  return (b - a).cross(c - a);
}

bool is_inner(const SurfaceMesh& mesh, Index half_edge) {
  return mesh.input_face(face_of(half_edge)) == mesh.input_face(face_of(mesh.opposite(half_edge)));
}

Vec dihedral_angles(const SurfaceMesh& mesh) {
  Vec angle = Vec::Zero(mesh.half_edge_count());
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o < h || is_inner(mesh, h)) continue;  // the boundary has -1
    const Vector3 a = area_vector(mesh, face_of(h)), b = area_vector(mesh, face_of(o));
    angle[h] = angle[o] = std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return angle;
}

Vec sharpness(const SurfaceMesh& mesh, const std::vector<char>& creases) {
  Vec sharp = dihedral_angles(mesh) * (180 / std::numbers::pi);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    sharp[h] = std::clamp((sharp[h] - kSharpFrom) / (kSharpTo - kSharpFrom), 0.0, 1.0);
    if (!creases.empty() && creases[h]) sharp[h] = 1;
  }
  return sharp;
}

Vec cut_costs(const SurfaceMesh& mesh, const CutPreferences& preferences) {
  Vec cost(mesh.half_edge_count());
  for (Index h = 0; h < mesh.half_edge_count(); ++h) cost[h] = mesh.edge_length(h);
  const double least = kMinLengthRatio * cost.mean();
  const Vec sharp = sharpness(mesh, preferences.creases);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const bool inner = mesh.opposite(h) >= 0 && is_inner(mesh, h);
    cost[h] = (inner ? kInnerCost : 1 - (1 - kCreaseCost) * sharp[h]) * std::max(cost[h], least);
    if (!preferences.weight.empty()) cost[h] *= preferences.weight[h];
  }
  return cost;
}

Vec cut_costs(const SurfaceMesh& mesh, const CutPreferences& preferences,
              const std::vector<char>& is_whole) {
  Vec cost = cut_costs(mesh, preferences);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_whole[mesh.from_vertex(h)] || is_whole[mesh.to_vertex(h)]) cost[h] *= kAvoidedCost;
  return cost;
}

double cost_of_cuts(const SurfaceMesh& mesh, const CutPreferences& preferences,
                    const std::vector<char>& is_cut) {
  const Vec cost = cut_costs(mesh, preferences);
  double sum = 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_cut[h]) sum += 0.5 * cost[h];
  return sum;
}

Vec angle_defects(const SurfaceMesh& mesh) {
  Vec defect = Vec::Constant(mesh.vertex_count(), 2 * std::numbers::pi);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    defect[mesh.from_vertex(h)] -= corner_angle(mesh, h).radians();
  for (const auto& loop : mesh.boundary_loops())
    for (const Index v : loop) defect[v] = 0;
  return defect;
}

CutPreferences preferences_on(const std::vector<Index>& faces, const CutPreferences& all) {
  CutPreferences out;
  const auto take = [&](const auto& from, auto& to) {
    if (from.empty()) return;
    to.reserve(3 * faces.size());
    for (const Index f : faces)
      for (Index k = 0; k < 3; ++k) to.push_back(from[3 * f + k]);
  };
  take(all.creases, out.creases);
  take(all.weight, out.weight);
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
