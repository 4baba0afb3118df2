// How far seams keep out of sight, and how symmetric they are: `unwrap` at degree 1, with and
// without the weights of hiding_weights(), one row for each mesh.
//
//     seam      its length, in square roots of the area; without the weights, with them, ratio
//     visible   mean visibility under the seams (visibility_of_cuts()), likewise
//     least     mean visibility under those edges that are least visible, 1.15 times as long as the
//               seam without the weights, wherever they lie: no seam that is 15 % longer is less
//               visible; as a part of what is visible without the weights
//     charts    with the weights
//     mirrored  of a surface that is its own mirror image in a coordinate plane, one of a hundred
//               vertices aside to a mean edge: the part of the seams, by length, whose mirror image
//               is within one mean edge of a seam; without the weights, with them
//
// Sample run:
//   build/release/bench/hidden_seams ../shared/data/public/closed/*.obj
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/repair.h"
#include "majorant/parametrization/atlas/unwrap.h"
#include "majorant/parametrization/seams/visibility.h"

using namespace majorant;

namespace {

struct Segment {
  Vector3 from, to;

  double distance(const Vector3& p) const {
    const Vector3 along = to - from;
    const double square = along.squaredNorm();
    const double t = square > 0 ? std::clamp(along.dot(p - from) / square, 0.0, 1.0) : 0;
    return (p - from - t * along).norm();
  }
};

struct Seams {
  double length = 0, visibility = 0, mirrored = 0;
  std::size_t charts = 0;
};

double mean_edge(const SurfaceMesh& mesh) {
  double sum = 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) sum += mesh.edge_length(h);
  return sum / static_cast<double>(mesh.half_edge_count());
}

// Twice the place of the coordinate plane that mirrors the vertices onto each other; the axis, or
// -1.
struct MirrorPlane {
  int axis = -1;
  double twice = 0;

  Vector3 image(Vector3 p) const {
    p[axis] = twice - p[axis];
    return p;
  }
};

MirrorPlane mirror_of(const SurfaceMesh& mesh) {
  const auto& x = mesh.positions();
  const double near = mean_edge(mesh);
  for (int axis = 0; axis < 3; ++axis) {
    const MirrorPlane plane{axis, x.col(axis).minCoeff() + x.col(axis).maxCoeff()};
    Index far = 0;
    for (Index v = 0; v < x.rows(); ++v) {
      const Vector3 p = plane.image(x.row(v));
      far += (x.rowwise() - p.transpose()).rowwise().squaredNorm().minCoeff() > near * near;
    }
    const bool is_mirror = far * 100 <= x.rows();
    if (is_mirror) return plane;
  }
  return {};
}

double mirrored_part(const SurfaceMesh& mesh, const MirrorPlane& plane,
                     const std::vector<char>& is_cut) {
  constexpr int kPoints = 4;  // an edge
  std::vector<Segment> seams;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (mesh.opposite(h) > h) continue;
    if (is_cut[to_size(h)])
      seams.push_back(
          {mesh.positions().row(mesh.from_vertex(h)), mesh.positions().row(mesh.to_vertex(h))});
  }
  const double edge_length = mean_edge(mesh);
  double all = 0, near = 0;
  for (const Segment& edge : seams)
    for (int k = 0; k < kPoints; ++k) {
      const Vector3 p = plane.image(edge.from + (k + 0.5) / kPoints * (edge.to - edge.from));
      const double part = (edge.to - edge.from).norm() / kPoints;
      all += part;
      for (const Segment& other : seams)
        if (other.distance(p) <= edge_length) {
          near += part;
          break;
        }
    }
  return all > 0 ? near / all : 1;
}

// Of edges of this length in all, the least visible ones.
double least_visibility(const SurfaceMesh& mesh, const Vec& visibility, double length) {
  std::vector<std::pair<double, double>> edges;  // how visible, how long
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) > h)
      edges.emplace_back(0.5 * (visibility[mesh.from_vertex(h)] + visibility[mesh.to_vertex(h)]),
                         mesh.edge_length(h));
  std::sort(edges.begin(), edges.end());
  double sum = 0, left = length;
  for (const auto& [visible, along] : edges) {
    const double part = std::min(along, left);
    sum += visible * part;
    left -= part;
  }
  return sum / (length - left);
}

Seams seams_of(const std::shared_ptr<const SurfaceMesh>& mesh, const Vec& visibility,
               const MirrorPlane& plane, std::vector<double> weight) {
  UnwrapOptions options;
  options.packing.reset();
  options.chart.map.degree = 1;
  options.cuts.wanted.weight = std::move(weight);
  RunRecord record;
  const Atlas atlas = unwrap(mesh, options, record);
  Seams seams;
  seams.length = atlas.cuts.length / std::sqrt(mesh->area());
  seams.visibility = visibility_of_cuts(*mesh, visibility, atlas.cuts.is_cut);
  seams.charts = atlas.charts.size();
  if (plane.axis >= 0) seams.mirrored = mirrored_part(*mesh, plane, atlas.cuts.is_cut);
  return seams;
}

// The part by which a seam may be longer for being hidden.
constexpr double kLonger = 0.15;

void print_row(const std::string& path) {
  const RepairedSurface surface = repair(read_mesh(path));
  const SurfaceMesh& mesh = *surface.mesh;
  const Vec visibility = ambient_visibility(mesh);
  const MirrorPlane plane = mirror_of(mesh);
  const Seams any = seams_of(surface.mesh, visibility, plane, {});
  const Seams hidden = seams_of(surface.mesh, visibility, plane, hiding_weights(mesh, visibility));
  const std::string name = path.substr(path.find_last_of('/') + 1);
  fmt::print(
      "| {} | {:.2f} | {:.2f} | {:.2f} | {:.3f} | {:.3f} | {:.2f} | {:.2f} | {} | {} |\n", name,
      any.length, hidden.length, hidden.length / any.length, any.visibility, hidden.visibility,
      hidden.visibility / any.visibility,
      least_visibility(mesh, visibility, (1 + kLonger) * any.length * std::sqrt(mesh.area())) /
          any.visibility,
      hidden.charts,
      plane.axis < 0 ? "-" : fmt::format("{:.2f}, {:.2f}", any.mirrored, hidden.mirrored));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  fmt::print(
      "| mesh | seam | hidden | ratio | visible | hidden | ratio | least | charts | mirrored |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (int k = 1; k < argc; ++k) print_row(argv[k]);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
