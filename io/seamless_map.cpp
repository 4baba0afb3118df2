#include "majorant/io/seamless_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>
#include <utility>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/constraints/seamless_constraint.h"
#include "majorant/framework/error.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/seamless_start.h"

namespace majorant {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// The surface that the corners of the cells make, a vertex for every input_vertex.
SurfaceMesh weld(const MapFile& file, const std::string& name) {
  const bool knows_vertices =
      file.input_vertex.size() == file.points.rows() &&
      file.input_vertex(file.cells.leftCols<3>().reshaped()).minCoeff() >= 0;
  if (!knows_vertices)
    throw Error(ErrorKind::Invalid,
                name +
                    ": the file does not say which points are copies of a vertex "
                    "(input_vertex); write it again with majorant");
  PolygonMesh welded = mesh_from_map(file, name);
  PolygonMesh ordered = welded;  // cells as in the file
  for (std::size_t p = 0; p < welded.polygons.size(); ++p) {
    const auto cell = static_cast<std::size_t>(welded.polygon_lines[p] - 1);
    ordered.polygons[cell] = std::move(welded.polygons[p]);
    ordered.polygon_lines[cell] = welded.polygon_lines[p];
  }
  ordered.polygon_texcoords.clear();
  ordered.texcoords.clear();
  return SurfaceMesh::from_polygons(ordered);
}

// The points of the file along the edges of its cells.
class EdgePoints {
 public:
  EdgePoints(const MapFile& file, const std::string& name, const SurfaceMesh& mesh)
      : file_(file),
        name_(name),
        mesh_(mesh),
        indices_(TriangleIndices::of_degree(file.degree)),
        count_(static_cast<std::size_t>(file.degree) + 1) {}

  // Point i = 0..n along a half-edge; of its opposite in the same direction.
  Index point(Index h, std::size_t i) const {
    return file_.cells(h / 3, indices_.edge(static_cast<int>(h % 3))[i]);
  }
  Index opposite_point(Index h, std::size_t i) const {
    return point(mesh_.opposite(h), count_ - 1 - i);
  }

  // 3 #F flags.
  std::vector<char> cuts() const {
    std::vector<char> is_cut(at(mesh_.half_edge_count()), 0);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (mesh_.opposite(h) > h)
        is_cut[at(h)] = is_cut[at(mesh_.opposite(h))] = static_cast<char>(is_apart(h));
    return is_cut;
  }

  // Mean length in uv of the edges of the cells.
  double mean_length() const {
    double sum = 0;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      sum += (file_.uv.row(point(h, 0)) - file_.uv.row(point(h, count_ - 1))).norm();
    return sum / mesh_.half_edge_count();
  }

  // k for which this side is closest to i^k times the opposite one, and how far it is from that.
  std::pair<int, double> transition(Index h) const {
    std::pair<int, double> best{0, mismatch(h, 0)};
    for (int k = 1; k < 4; ++k)
      if (const double distance = mismatch(h, k); distance < best.second) best = {k, distance};
    return best;
  }

  std::string place(Index h) const {
    return fmt::format("edge ({}, {})", mesh_.input_vertex(mesh_.from_vertex(h)),
                       mesh_.input_vertex(mesh_.to_vertex(h)));
  }

 private:
  bool is_apart(Index h) const {
    const auto shared = [&](std::size_t i) { return point(h, i) == opposite_point(h, i); };
    std::size_t inner = 0;
    for (std::size_t i = 1; i + 1 < count_; ++i) inner += shared(i);
    if (count_ == 2) return !shared(0) || !shared(1);
    if (inner == 0) return true;
    if (inner + 2 < count_ || !shared(0) || !shared(count_ - 1))
      throw Error(ErrorKind::Invalid,
                  fmt::format("{}: cells {} and {} share some control points of {} and not others: "
                              "the map is neither continuous nor cut there",
                              name_, h / 3, mesh_.opposite(h) / 3, place(h)));
    return false;
  }

  double mismatch(Index h, int turns) const {
    double worst = 0;
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      const Vector2 mine = file_.uv.row(point(h, i + 1)) - file_.uv.row(point(h, i));
      const Vector2 other =
          file_.uv.row(opposite_point(h, i + 1)) - file_.uv.row(opposite_point(h, i));
      worst = std::max(worst, (mine - rotated(other, turns)).norm());
    }
    return worst;
  }

  const MapFile& file_;
  const std::string& name_;
  const SurfaceMesh& mesh_;
  const TriangleIndices& indices_;
  std::size_t count_;  // of points along an edge
};

std::vector<int> find_turns(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                            const EdgePoints& edges, const std::string& name) {
  const double mean_length = edges.mean_length();
  std::vector<int> turns(is_cut.size(), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (!is_cut[at(h)] || mesh.opposite(h) < h) continue;
    const auto [k, mismatch] = edges.transition(h);
    if (!(mismatch <= kSeamTolerance * mean_length))
      throw Error(ErrorKind::Invalid,
                  fmt::format("{}: the map is not continuous and not seamless at {}: its sides "
                              "differ by {:.3g} after the best rotation by a multiple of 90 "
                              "degrees",
                              name, edges.place(h), mismatch));
    turns[at(h)] = k;
    turns[at(mesh.opposite(h))] = (4 - k) % 4;
  }
  return turns;
}

// Nearest numbers of quarter turns, 0 at the boundary of the uncut surface.
std::vector<int> quarter_turns(const SurfaceMesh& mesh, const std::vector<Index>& surface_vertex,
                               VecIn angle_sums) {
  std::vector<double> sum(at(mesh.vertex_count()), 0);
  for (std::size_t v = 0; v < surface_vertex.size(); ++v)
    sum[at(surface_vertex[v])] += angle_sums[static_cast<Index>(v)];
  std::vector<int> turns;
  for (const double s : sum)
    turns.push_back(std::max(1, static_cast<int>(std::lround(2 * s / std::numbers::pi))));
  for (const auto& loop : mesh.boundary_loops())
    for (const Index v : loop) turns[at(v)] = 0;
  return turns;
}

}  // namespace

BezierMap to_seamless_map(const MapFile& file, const std::string& name) {
  const SurfaceMesh uncut = weld(file, name);
  const EdgePoints edges(file, name, uncut);
  const std::vector<char> is_cut = edges.cuts();
  const std::vector<int> turns = find_turns(uncut, is_cut, edges, name);
  std::vector<Index> surface_vertex;
  const SurfaceMesh cut = uncut.cut_along(is_cut, &surface_vertex);
  const auto space =
      std::make_shared<const BezierTriangleSpace>(cut.faces(), cut.vertex_count(), file.degree);
  Vec x = node_values(file, *space, name);
  const CutSurface surface = cut_open(
      uncut, is_cut, turns, quarter_turns(uncut, surface_vertex, vertex_angle_sums(*space, x)));
  return BezierMap(surface.mesh, space, std::move(x), surface.seams);
}

bool is_cut(const MapFile& file) {
  std::unordered_set<Index> seen;
  return std::any_of(file.input_vertex.begin(), file.input_vertex.end(),
                     [&](Index v) { return v >= 0 && !seen.insert(v).second; });
}

}  // namespace majorant
