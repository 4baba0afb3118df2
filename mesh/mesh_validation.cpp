#include "majorant/mesh/mesh_validation.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/pair_order.h"
#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

// Refuses a mesh and names the repair that repair() makes.
[[noreturn]] void refuse(const PolygonMesh& input, const std::string& place,
                         const std::string& what, std::string_view does) {
  throw Refusal(ErrorKind::Unsupported, input.file, place + what + "; ", Hint::Repair,
                " " + std::string(does));
}

[[noreturn]] void refuse_list(const PolygonMesh& input, const std::string& what) {
  throw InvalidArgument(message_prefix(input.file) + what);
}

// of_polygon: empty, or for each polygon either nothing or an index below `count` for every corner.
void require_parallel(const PolygonMesh& input, const char* name, const IndexLists& of_polygon,
                      std::size_t count) {
  if (of_polygon.empty()) return;
  if (of_polygon.size() != input.polygons.size())
    refuse_list(input, fmt::format("{} of {} polygons, there are {}", name, of_polygon.size(),
                                   input.polygons.size()));
  for (std::size_t p = 0; p < of_polygon.size(); ++p) {
    if (!of_polygon[p].empty() && of_polygon[p].size() != input.polygons[p].size())
      refuse_list(input, fmt::format("polygon {} has {} corners, but {} {}", p,
                                     input.polygons[p].size(), of_polygon[p].size(), name));
    for (const Index i : of_polygon[p])
      if (i < 0 || to_size(i) >= count)
        refuse_list(input,
                    fmt::format("polygon {}: {} have index {}, there are {}", p, name, i, count));
  }
}

// The shortest edge must span this many units in the last place of the largest coordinate, so that
// edges have eight digits.
constexpr double kUsableUlps = 1e8;
// The smallest and largest length of an edge: their squares, and sums of squares, are normal
// doubles, 1e-308 to 1e308. The smallest is below 1e-150, so that meshes of that size are accepted.
constexpr double kLeastLength = 1e-152, kMostLength = 1e150;

const Vector3& position(const PolygonMesh& m, Index v) { return m.positions[v]; }

struct HalfEdge {
  Index low, high;
  Index triangle;
  bool forward;  // runs from low to high
};

Index vertex_at(const TriangleList& list, Index half_edge) {
  return list.triangles[face_of(half_edge)][corner_of(half_edge)];
}

HalfEdge half_edge_of(const TriangleList& list, Index h) {
  const Index a = vertex_at(list, h), b = vertex_at(list, next(h));
  return {std::min(a, b), std::max(a, b), face_of(h), a < b};
}

// Returns the first triangle that has the same vertices as an earlier one, in any order; the number
// of triangles if there is none.
std::size_t first_duplicate(const PolygonMesh& input, const TriangleList& list) {
  const auto sorted = [&](Index t) {
    std::array<Index, 3> f = list.triangles[t];
    std::sort(f.begin(), f.end());
    return f;
  };
  const auto count = static_cast<Index>(list.triangles.size());
  const PairOrder faces(static_cast<Index>(input.positions.size()), count, [&](Index t) {
    const std::array<Index, 3> f = sorted(t);
    return std::pair(f[0], f[1]);
  });
  Index first = count;
  std::vector<std::pair<Index, Index>> thirds;  // third vertex and triangle, for the triangles of a
                                                // run
  faces.for_each_run([&](std::span<const PairOrder::Entry> run) {
    if (run.size() == 1) return;
    thirds.clear();
    for (const auto& [ignored, t] : run) thirds.emplace_back(sorted(t)[2], t);
    std::sort(thirds.begin(), thirds.end());
    for (std::size_t k = 1; k < thirds.size(); ++k)
      if (thirds[k].first == thirds[k - 1].first) first = std::min(first, thirds[k].second);
  });
  return to_size(first);
}

// Returns whether flipping some faces makes the orientation consistent, by two-colouring the dual
// graph.
bool orientable(const TriangleList& list, const PairOrder& order) {
  std::vector<HalfEdge> edges;
  order.for_each_run([&](std::span<const PairOrder::Entry> edge) {
    for (const auto& [ignored, h] : edge) edges.push_back(half_edge_of(list, h));
  });
  const auto n = static_cast<Index>(list.triangles.size());
  UnionFind sheets(2 * n);  // t: kept, n + t: flipped
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    const HalfEdge &a = edges[k], &b = edges[k + 1];
    if (a.low != b.low || a.high != b.high) continue;
    const bool agree = a.forward != b.forward;
    sheets.join(a.triangle, agree ? b.triangle : n + b.triangle);
    sheets.join(n + a.triangle, agree ? n + b.triangle : b.triangle);
  }
  for (Index t = 0; t < n; ++t)
    if (sheets.find(t) == sheets.find(n + t)) return false;
  return true;
}

}  // namespace

void require_sound_lists(const PolygonMesh& input) {
  for (std::size_t v = 0; v < input.positions.size(); ++v)
    if (const Vector3& p = input.positions[v]; !p.allFinite())
      refuse_list(input,
                  fmt::format("vertex {} is at ({:g}, {:g}, {:g}), finite numbers are needed", v,
                              p.x(), p.y(), p.z()));
  for (std::size_t p = 0; p < input.polygons.size(); ++p) {
    if (input.polygons[p].size() < 3)
      refuse_list(input, fmt::format("polygon {} has {} corners, at least 3 are needed", p,
                                     input.polygons[p].size()));
    for (const Index v : input.polygons[p])
      if (v < 0 || to_size(v) >= input.positions.size())
        refuse_list(input, fmt::format("polygon {} has vertex {}, there are {}", p, v,
                                       input.positions.size()));
  }
  require_parallel(input, "texture coordinates", input.polygon_texcoords, input.texcoords.size());
  require_parallel(input, "normals", input.polygon_normals, input.normals.size());
  for (std::size_t t = 0; t < input.texcoords.size(); ++t)
    if (!input.texcoords[t].allFinite())
      refuse_list(input, fmt::format("texture coordinates {} are not finite", t));
  if (input.polygons.empty())
    throw Error(ErrorKind::Unsupported, message_prefix(input.file) + "the mesh has no faces");
}

bool has_area(const Vector3& a, const Vector3& b, const Vector3& c) {
  if (has_clear_area(a, b, c)) return true;
  const Vector3 u = b / 4 - a / 4, v = c / 4 - a / 4;  // lengths themselves may overflow
  const double longest = std::max({u.stableNorm(), v.stableNorm(), (u - v).stableNorm()});
  return (u / longest).cross(v / longest).norm() > kDegenerateHeight;
}

void require_usable_coordinates(const PolygonMesh& input) {
  constexpr double kClearly = 1.001;  // far above the rounding of a square
  double largest = 0, longest = 0, shortest = std::numeric_limits<double>::infinity();
  Index where = 0;
  for (std::size_t p = 0; p < input.polygons.size(); ++p) {
    const auto& polygon = input.polygons[p];
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vector3& a = position(input, polygon[k]);
      const Vector3 edge = a - position(input, polygon[k + 1 < polygon.size() ? k + 1 : 0]);
      largest = std::max(largest, a.cwiseAbs().maxCoeff());
      // Skips edges that are clearly neither the shortest nor the longest.
      const double square = edge.squaredNorm();
      if (square > kClearly * shortest * shortest && kClearly * square < longest * longest)
        continue;
      const double length = edge.stableNorm();
      longest = std::max(longest, std::isfinite(length) ? length : largest);
      if (length > 0 && length < shortest) {
        shortest = length;
        where = static_cast<Index>(p);
      }
    }
  }
  if (longest > kMostLength || shortest < kLeastLength)
    throw Error(ErrorKind::Unsupported,
                message_prefix(input.file) +
                    fmt::format("edges of length {:.3g} to {:.3g}: areas leave the range of "
                                "doubles; scale the mesh to lengths between {:g} and {:g}",
                                shortest, longest, kLeastLength, kMostLength));
  const double spacing = std::numeric_limits<double>::epsilon() * largest;
  if (spacing * kUsableUlps > shortest)
    refuse(input, face_place(input, where),
           fmt::format("an edge of length {:.3g} at coordinates near {:.3g} keeps fewer than 8 "
                       "digits",
                       shortest, largest),
           "moves the mesh to the origin and back");
}

void require_proper_faces(const PolygonMesh& input, const TriangleList& list, Shapes shapes,
                          const StopCheck& stop) {
  const std::size_t duplicate = first_duplicate(input, list);
  for (std::size_t t = 0; t < list.triangles.size(); ++t) {
    stop.poll_at(t);
    const std::array<Index, 3>& f = list.triangles[t];
    const auto place = [&] { return face_place(input, list.polygon[t]); };
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0])
      refuse(input, place(), "a vertex occurs twice", "makes it a piece of its own");
    if (shapes == Shapes::Proper &&
        !has_area(position(input, f[0]), position(input, f[1]), position(input, f[2])))
      refuse(input, place(),
             fmt::format("zero area (vertices {}, {}, {})",
                         shown_number(input.file, list.triangles[t][0]),
                         shown_number(input.file, list.triangles[t][1]),
                         shown_number(input.file, list.triangles[t][2])),
             "measures it against a needle");
    if (t == duplicate) refuse(input, place(), "the same face occurs twice", "makes each a piece");
  }
}

void require_manifold_edges(const PolygonMesh& input, const TriangleList& list) {
  const PairOrder order = order_of_edges(
      static_cast<Index>(input.positions.size()), static_cast<Index>(3 * list.triangles.size()),
      [&](Index h) { return std::pair(vertex_at(list, h), vertex_at(list, next(h))); });
  Index third = -1, against = -1;  // half-edges: the first with a third face, and with the same
                                   // direction
  order.for_each_run([&](std::span<const PairOrder::Entry> edge) {
    if (edge.size() > 2 && third < 0) third = edge[2].number;
    if (edge.size() != 2 || against >= 0) return;
    if ((vertex_at(list, edge[0].number) < vertex_at(list, next(edge[0].number))) ==
        (vertex_at(list, edge[1].number) < vertex_at(list, next(edge[1].number))))
      against = edge[1].number;
  });
  if (third < 0 && against < 0) return;
  const HalfEdge edge = half_edge_of(list, third >= 0 ? third : against);
  const std::string place = face_place(input, list.polygon[edge.triangle]);
  const std::string ends = fmt::format("({}, {})", shown_number(input.file, edge.low),
                                       shown_number(input.file, edge.high));
  if (third >= 0)
    refuse(input, place, fmt::format("edge {} has more than two faces (non-manifold)", ends),
           "splits the surface there");
  if (orientable(list, order))
    refuse(input, place,
           fmt::format("faces on both sides of edge {} run against each other (inconsistent "
                       "orientation)",
                       ends),
           "turns the faces that disagree");
  refuse(input, place,
         fmt::format("the surface is not orientable (a Moebius strip passes edge {})", ends),
         "cuts it");
}

void require_one_component(const PolygonMesh& input, const TriangleList& list) {
  UnionFind components(static_cast<Index>(input.positions.size()));
  for (const auto& t : list.triangles) {
    components.join(t[0], t[1]);
    components.join(t[0], t[2]);
  }
  std::map<Index, Index> first;  // component -> a triangle of it
  for (std::size_t t = 0; t < list.triangles.size(); ++t)
    first.emplace(components.find(list.triangles[t][0]), static_cast<Index>(t));
  if (first.size() <= 1) return;
  if (first.size() == list.triangles.size())
    refuse(input, message_prefix(input.file),
           fmt::format("none of the {} faces shares a vertex with another (unwelded soup)",
                       first.size()),
           "merges coincident vertices");
  Index other = 0;
  const Index home = components.find(list.triangles[0][0]);
  for (const auto& [component, triangle] : first)
    if (component != home && (other == 0 || triangle < other)) other = triangle;
  refuse(input, face_place(input, list.polygon[other]),
         fmt::format("the mesh has {} components, a second one starts here", first.size()),
         "maps all of them");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
