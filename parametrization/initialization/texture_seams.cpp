#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "majorant/constraints/cut_surface.h"
#include "majorant/constraints/sector_angle.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/texture_borders.h"
#include "majorant/parametrization/initialization/start.h"

namespace majorant {
namespace {

// The largest deviation of an angle sum from a multiple of 90 degrees, radians: ten times
// kSeamTolerance, which bounds the mismatch along edges.
constexpr double kQuarterTurnTolerance = 1e-2;

// A cut surface as seen through the corner coordinates of its faces.
class CornerView {
 public:
  CornerView(const SurfaceMesh& mesh, const CornerPoints& corners)
      : mesh_(mesh), corners_(corners) {
    double sum = 0;
    for (Index h = 0; h < mesh.half_edge_count(); ++h) sum += edge(h).norm();
    mean_length_ = sum / mesh.half_edge_count();
  }

  Vector2 corner(Index h) const { return corners_.row(face_of(h)).segment<2>(2 * corner_of(h)); }
  Vector2 edge(Index h) const { return corner(next(h)) - corner(h); }
  double mean_length() const { return mean_length_; }

  double signed_area(Index face) const { return 0.5 * cross(edge(3 * face), edge(3 * face + 1)); }
  double angle(Index h) const { return std::abs(sector_angle(edge(h), -edge(previous(h)))); }
  // Returns the k for which this edge is closest to i^k times its opposite, and the distance.
  std::pair<int, double> transition(Index h) const {
    const Vector2 mine = edge(h), other = -edge(mesh_.opposite(h));
    int best = 0;
    for (int k = 1; k < 4; ++k)
      if ((mine - rotated(other, k)).norm() < (mine - rotated(other, best)).norm()) best = k;
    return {best, (mine - rotated(other, best)).norm()};
  }

 private:
  const SurfaceMesh& mesh_;
  const CornerPoints& corners_;
  double mean_length_ = 0;
};

void require_oriented(const SurfaceMesh& mesh, const CornerView& view) {
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (!(view.signed_area(f) > 0))
      throw Refusal(ErrorKind::Infeasible, mesh.file(),
                    fmt::format("{}the texture coordinates are not injective: face {} is not "
                                "positively oriented; repair them or use ",
                                message_prefix(mesh), user_face(mesh, f)),
                    Hint::MakeSeamless);
}

struct Transitions {
  std::vector<int> turns;  // by half-edge
  double residual = 0;     // largest mismatch
};

// Returns the transitions of all cut edges.
Transitions snap_rotations(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                           const CornerView& view) {
  Transitions out{std::vector<int>(is_cut.size(), 0)};
  Index worst = -1;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index opposite = mesh.opposite(h);
    if (!is_cut[h] || opposite < h) continue;
    const auto [k, mismatch] = view.transition(h);
    out.turns[h] = k;
    out.turns[opposite] = (4 - k) % 4;
    if (worst >= 0 && mismatch <= out.residual) continue;
    worst = h;
    out.residual = mismatch;
  }
  if (!(out.residual <= kSeamTolerance * view.mean_length()))
    throw Refusal(
        ErrorKind::Unsupported, mesh.file(),
        fmt::format("{}the seam at edge ({}, {}) is not seamless: its sides differ by {:.3g} "
                    "edge lengths after the best rotation by a multiple of 90 degrees (tolerance "
                    "{:g}); repair the coordinates or use ",
                    message_prefix(mesh), user_vertex(mesh, mesh.from_vertex(worst)),
                    user_vertex(mesh, mesh.to_vertex(worst)), out.residual / view.mean_length(),
                    kSeamTolerance),
        Hint::MakeSeamless);
  return out;
}

std::vector<int> measure_quarter_turns(const SurfaceMesh& mesh, const CornerView& view) {
  std::vector<double> sum(to_size(mesh.vertex_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) sum[mesh.from_vertex(h)] += view.angle(h);
  const std::vector<char> on_boundary = mesh.boundary_flags();
  std::vector<int> quarter_turns(sum.size(), 0);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (on_boundary[v]) continue;
    const auto turns = static_cast<int>(std::lround(2 * sum[v] / std::numbers::pi));
    quarter_turns[v] = turns;
    if (turns > 0 && std::abs(sum[v] - turns * std::numbers::pi / 2) <= kQuarterTurnTolerance)
      continue;
    throw Refusal(
        ErrorKind::Unsupported, mesh.file(),
        fmt::format("{}vertex {}: the angles around it add up to {:.4g} degrees in the "
                    "texture, no multiple of 90; repair the coordinates or use ",
                    message_prefix(mesh), user_vertex(mesh, v), sum[v] * 180 / std::numbers::pi),
        Hint::MakeSeamless);
  }
  return quarter_turns;
}

Start assemble(const SurfaceMesh& mesh, const std::vector<char>& is_cut, const CornerView& view,
               const Transitions& transitions, std::vector<int> quarter_turns) {
  const CutSurface surface = cut_open(mesh, is_cut, transitions.turns, std::move(quarter_turns));
  Vec uv(2 * surface.mesh->vertex_count());
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    uv.segment<2>(2 * surface.mesh->from_vertex(h)) = view.corner(h);
  double moved = 0;
  uv = project_to_seams(surface, uv, &moved);
  return {BezierMap::linear(surface.mesh, std::move(uv), surface.seams), transitions.residual,
          moved};
}

}  // namespace

Vec texture_map(const SurfaceMesh& mesh) {
  if (untextured_polygons(mesh) > 0)
    throw Refusal(ErrorKind::Unsupported, mesh.file(),
                  message_prefix(mesh) + "not every face corner has texture coordinates; ",
                  Hint::OtherStart);
  Vec x = Vec::Zero(2 * mesh.vertex_count());
  std::vector<char> seen(to_size(mesh.vertex_count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Index v = mesh.faces()(f, k);
      const Vector2 uv = mesh.corner_texcoords().row(f).segment<2>(2 * k);
      if (seen[v] && uv != x.segment<2>(2 * v))
        throw Refusal(ErrorKind::Unsupported, mesh.file(),
                      fmt::format("{}vertex {} has several texture coordinates (a seam); ",
                                  message_prefix(mesh), user_vertex(mesh, v)),
                      Hint::CutTexture);
      seen[v] = 1;
      x.segment<2>(2 * v) = uv;
    }
  return x;
}

std::vector<char> texture_cuts(const SurfaceMesh& mesh) {
  if (untextured_polygons(mesh) > 0)
    throw Refusal(ErrorKind::Unsupported, mesh.file(),
                  message_prefix(mesh) + "not every face corner has texture coordinates; use ",
                  Hint::MakeSeamless, " to make a seamless map");
  return texture_borders(mesh);
}

Start seamless_from_corners(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                            const CornerPoints& corners) {
  const CornerView view(mesh, corners);
  require_oriented(mesh, view);
  const Transitions transitions = snap_rotations(mesh, is_cut, view);
  return assemble(mesh, is_cut, view, transitions, measure_quarter_turns(mesh, view));
}

Start seamless_from_layout(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                           const CornerPoints& corners, std::vector<int> quarter_turns) {
  const CornerView view(mesh, corners);
  return assemble(mesh, is_cut, view, snap_rotations(mesh, is_cut, view), std::move(quarter_turns));
}

Start seamless_from_texture(const SurfaceMesh& mesh) {
  return seamless_from_corners(mesh, texture_cuts(mesh), mesh.corner_texcoords());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
