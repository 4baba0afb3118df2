#include "majorant/quads/quad_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "majorant/quads/internal/extraction.h"
#include "majorant/quads/internal/quantization.h"
#include "majorant/quads/internal/smoothing.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {
namespace {

// Whole numbers for the arcs of a T-mesh, such that no two cones become one vertex.
class ArcNumbers {
 public:
  // Joined: an arc may have no edges; Separate: all have one at least.
  enum class Arcs { Joined, Separate };

  ArcNumbers(const SeamlessLattice& lattice, const TMesh& mesh, Arcs arcs, const StopCheck& stop)
      : lattice_(lattice),
        mesh_(mesh),
        stop_(stop),
        least_(mesh.arcs.size(), arcs == Arcs::Joined ? 0 : 1) {}

  // Arcs that would join two cones get an edge, one after the other.
  std::vector<Index> at(double edge_length) {
    std::vector<double> wanted;
    for (const TArc& arc : mesh_.arcs)
      wanted.push_back(static_cast<double>(arc.length()) / edge_length);
    for (;;) {
      std::vector<Index> edges = quantize(mesh_, wanted, least_, stop_);
      const std::vector<Index> joining = ExtractedQuads(lattice_, mesh_, edges).joining_arcs();
      if (joining.empty()) return edges;
      for (const Index arc : joining) least_[arc] = 1;
    }
  }

  // The numbers at the edge length at which there are about as many quads as asked.
  std::vector<Index> for_count(double asked) {
    constexpr int kSteps = 12;
    constexpr double kNearEnough = 0.005;
    double length = std::sqrt(static_cast<double>(lattice_.twice_area()) / 2 / asked);
    std::vector<Index> best;
    double least_off = std::numeric_limits<double>::infinity();
    for (int step = 0; step < kSteps; ++step) {
      std::vector<Index> edges = at(length);
      const double ratio = static_cast<double>(quad_count(mesh_, edges)) / asked;
      const double off = std::abs(std::log(ratio));
      if (off < least_off) {
        least_off = off;
        best = std::move(edges);
      }
      if (off <= kNearEnough) break;
      length *= std::sqrt(ratio);
    }
    return best;
  }

 private:
  const SeamlessLattice& lattice_;
  const TMesh& mesh_;
  const StopCheck& stop_;
  std::vector<Index> least_;  // by arc
};

void require_usable(const SurfaceMesh& mesh, const QuadMeshOptions& options) {
  if (options.count && options.edge_length)
    throw InvalidArgument("quad_mesh: both a count and an edge length");
  if (options.count && *options.count < 1)
    throw InvalidArgument(fmt::format("quad_mesh: {} quads", *options.count));
  if (options.edge_length && !(*options.edge_length > 0 && std::isfinite(*options.edge_length)))
    throw InvalidArgument(fmt::format("quad_mesh: edges of length {}", *options.edge_length));
  if (mesh.topology().components != 1)
    throw InvalidArgument("quad_mesh: the surface has several components");
  if (mesh.topology().boundary_loops > 0)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}{}the surface has a border, and quads are made of closed surfaces "
                            "only; close it",
                            mesh.file(), mesh.file().empty() ? "" : ": "));
}

// status receives how the optimization ended.
BezierMap seamless_map(const SurfaceMesh& mesh, const QuadMeshOptions& options, RunRecord& record,
                       Status& status) {
  SeamlessOptions how = options.map;
  how.threads = options.threads;
  record.begin(Activity::Starting);
  const Start start = make_seamless(mesh, how, record);
  ParametrizationOptions optimize;
  optimize.map.degree = 1;
  optimize.solve.threads = options.threads;
  const ParametrizationResult result = parametrize(start.map, optimize, record);
  status = result.status;
  return result.map ? *result.map : start.map;
}

Points3 file_positions(const SurfaceMesh& mesh) {
  return mesh.positions().rowwise() + mesh.origin().transpose();
}

}  // namespace

QuadMesh quad_mesh(const SurfaceMesh& mesh, const QuadMeshOptions& options, RunRecord& record) {
  require_usable(mesh, options);
  const ThreadCount threads(options.threads);
  const StopCheck& stop = record.start_stop();
  QuadMesh result;
  const BezierMap map = seamless_map(mesh, options, record, result.status);
  SeamlessLattice lattice(mesh, map);
  const TMesh t_mesh = trace_t_mesh(lattice, stop);
  result.patches = static_cast<Index>(t_mesh.patches.size());
  for (const TNode& node : t_mesh.nodes) result.cones += node.vertex >= 0 && node.turns != 4;
  if (options.edge_length)
    result.asked = std::lround(mesh.area() / (*options.edge_length * *options.edge_length));
  else
    result.asked = options.count.value_or(std::max(mesh.face_count() / 2, 1));
  // Arcs without edges leave the best angles; other numbers of quads are other meshes, of which one
  // may be valid where the first is not.
  using Arcs = ArcNumbers::Arcs;
  constexpr std::pair<Arcs, double> kAttempts[] = {{Arcs::Joined, 1},    {Arcs::Joined, 1.02},
                                                   {Arcs::Joined, 0.98}, {Arcs::Joined, 1.04},
                                                   {Arcs::Separate, 1},  {Arcs::Separate, 1.03}};
  std::string why;
  for (const auto& [arcs, part] : kAttempts) {
    record.begin(Activity::Solving);
    ArcNumbers numbers(lattice, t_mesh, arcs, stop);
    const std::vector<Index> edges =
        options.edge_length ? numbers.at(*options.edge_length / lattice.unit() / std::sqrt(part))
                            : numbers.for_count(part * static_cast<double>(result.asked));
    result.quads = ExtractedQuads(lattice, t_mesh, edges).polygons();
    smooth_quads(result.quads, file_positions(mesh), mesh.faces(), stop);
    record.begin(Activity::Proving);
    result.check = check_quads(result.quads, &mesh, stop);
    if (!result.check.is_valid()) {
      if (why.empty()) why = result.check.defects.front();
      continue;
    }
    result.has_joined_arcs = std::count(edges.begin(), edges.end(), 0) > 0;
    if (static_cast<double>(result.check.count) >
        (1 + kCountClose) * static_cast<double>(result.asked))
      result.least_count = quad_count(t_mesh, numbers.at(std::numeric_limits<double>::infinity()));
    return result;
  }
  throw Error(ErrorKind::Infeasible,
              fmt::format("{}{}the quads that were made are not valid: {}; ask for more of them",
                          mesh.file(), mesh.file().empty() ? "" : ": ", why));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
