#include "majorant/parametrization/seams/internal/mirrored_cuts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

#include "majorant/mesh/cut_graph.h"
#include "majorant/mesh/cut_shortening.h"
#include "majorant/mesh/nearest_point.h"
#include "majorant/parametrization/seams/cut_paths.h"
#include "majorant/parametrization/seams/internal/cut_costs.h"
#include "majorant/parametrization/seams/internal/pieces.h"

namespace majorant {
namespace {

// The cost of an edge grows by this factor times the square of its distance (mean edges) from the
// plane, or from the image of a cut: half an edge doubles it, two edges exclude it.
constexpr double kOffPlaneCost = 4;
// The factor of the cost of spine edges while one half is cut: they count once, since they have no
// image. Edges of the other half are left out.
constexpr double kSpineCost = 0.5;
// The factor of the cost of edges along a cut or its image.
constexpr double kTemplateCost = 0.05;
// The distance beyond which costs do not grow, mean edges.
constexpr double kMaxOffEdges = 3;
// Vertices within this distance of the plane lie in it, mean edges. Narrower bands have crooked
// paths; in wider ones paths are not near their images.
constexpr double kInPlaneEdges = 0.7;

double distance_to(const Vector3& p, const std::pair<Vector3, Vector3>& segment) {
  const Vector3 along = segment.second - segment.first;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp(along.dot(p - segment.first) / square, 0.0, 1.0) : 0;
  return (p - segment.first - t * along).norm();
}

double off_factor(double edges) {
  const double off = std::min(edges, kMaxOffEdges);
  return 1 + kOffPlaneCost * off * off;
}

}  // namespace

MirroredCuts::MirroredCuts(const SurfaceMesh& mesh, const MirrorPlane& plane, const Vec& cost,
                           const StopCheck& stop)
    : mesh_(mesh), plane_(plane), cost_(cost), stop_(stop), edge_(mean_edge_length(mesh)) {
  std::vector<char> border = border_of_sides();
  const std::vector<char> rough = border;
  straighten(border);
  part(border);
  if (!is_parted()) part(rough);
}

bool MirroredCuts::is_in_plane(Index v) const {
  return std::abs(plane_.height(place(v))) <= kInPlaneEdges * edge_;
}

// Returns flags of the edges between polygons on the two sides of the plane. Small parts join their
// surroundings.
std::vector<char> MirroredCuts::border_of_sides() const {
  std::map<Index, std::pair<double, Index>> heights;  // by polygon of the file: sum and count
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    auto& [sum, count] = heights[mesh_.input_face(f)];
    for (Index k = 0; k < 3; ++k) sum += plane_.height(place(mesh_.faces()(f, k)));
    ++count;
  }
  std::vector<char> is_above(to_size(mesh_.face_count()));
  for (Index f = 0; f < mesh_.face_count(); ++f)
    is_above[f] = heights[mesh_.input_face(f)].first >= 0;
  std::vector<Index> opposite = mesh_.opposites();
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (opposite[h] >= 0 && is_above[face_of(h)] != is_above[face_of(mesh_.opposite(h))])
      opposite[h] = -1;
  const std::vector<Index> part = face_components(opposite);
  const Index parts = part.empty() ? 0 : *std::max_element(part.begin(), part.end()) + 1;
  std::vector<Index> size(to_size(parts), 0);
  std::vector<Index> largest = {-1, -1};
  for (Index f = 0; f < mesh_.face_count(); ++f) ++size[part[f]];
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    Index& best = largest[is_above[f] ? 1 : 0];
    if (best < 0 || size[part[f]] > size[best]) best = part[f];
  }
  for (Index f = 0; f < mesh_.face_count(); ++f)
    if (part[f] != largest[is_above[f] ? 1 : 0]) is_above[f] = !is_above[f];
  std::vector<char> border(to_size(mesh_.half_edge_count()), 0);
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (const Index o = mesh_.opposite(h); o >= 0)
      border[h] = is_above[face_of(h)] != is_above[face_of(o)];
  return border;
}

Vec MirroredCuts::cost_near_plane() const {
  Vec cost = cost_;
  for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
    const double off = std::max(std::abs(plane_.height(place(mesh_.from_vertex(h)))),
                                std::abs(plane_.height(place(mesh_.to_vertex(h)))));
    cost[h] *= off_factor(off / edge_);
  }
  return cost;
}

// Straightens the paths between two opposite vertices of each loop.
void MirroredCuts::straighten(std::vector<char>& border) const {
  std::vector<Index> uncut, nodes;
  const SurfaceMesh open = mesh_.cut_along(border, &uncut);
  for (const std::vector<Index>& loop : open.boundary_loops())
    for (const std::size_t k : {std::size_t{0}, loop.size() / 2}) nodes.push_back(uncut[loop[k]]);
  smooth_cuts(mesh_, nodes, cost_near_plane(), border, stop_);
}

// Makes the two halves, or none if the border leaves another number of pieces.
void MirroredCuts::part(const std::vector<char>& border) {
  std::vector<Index> whole;
  const SurfaceMesh open = mesh_.cut_along(border, &whole);
  std::vector<SurfacePiece> pieces = open.split(stop_);
  if (pieces.size() != 2) return;
  for (SurfacePiece& piece : pieces) {
    double height = 0;
    for (Index v = 0; v < piece.mesh->vertex_count(); ++v)
      height += plane_.height(piece.mesh->positions().row(v));
    HalfSurface& half = halves_[height < 0 ? 1 : 0];
    half.face = piece.face;
    half.number.assign(to_size(mesh_.vertex_count()), -1);
    for (Index v = 0; v < piece.mesh->vertex_count(); ++v) {
      half.vertex.push_back(whole[piece.vertex[v]]);
      half.number[half.vertex.back()] = v;
    }
    half.is_border.assign(half.vertex.size(), 0);
    half.cost.resize(piece.mesh->half_edge_count());
    for (Index h = 0; h < piece.mesh->half_edge_count(); ++h) {
      const Index g = 3 * half.face[face_of(h)] + corner_of(h);
      half.cost[h] = cost_[g];
      if (border[g])
        half.is_border[piece.mesh->from_vertex(h)] = half.is_border[piece.mesh->to_vertex(h)] = 1;
    }
    half.mesh = std::move(piece.mesh);
  }
  if (!is_parted()) halves_ = {};
  is_spine_ = border;
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (mesh_.opposite(h) >= 0 && is_in_plane(mesh_.from_vertex(h)) &&
        is_in_plane(mesh_.to_vertex(h)))
      is_spine_[h] = 1;
}

// Returns the vertex of the border nearest to v if v lies in the plane, else v itself.
Index MirroredCuts::snapped(const HalfSurface& half, Index v) const {
  if (half.is_border[v] ||
      std::abs(plane_.height(half.mesh->positions().row(v))) > kSameImageEdges / 2 * edge_)
    return v;
  Index best = v;
  double least = std::numeric_limits<double>::infinity();
  for (Index h = 0; h < half.mesh->half_edge_count(); ++h) {
    if (half.mesh->from_vertex(h) == v && half.is_border[half.mesh->to_vertex(h)] &&
        half.mesh->edge_length(h) < least)
      least = half.mesh->edge_length(h), best = half.mesh->to_vertex(h);
  }
  return best;
}

// Returns the vertices of the half through which its cuts run.
std::vector<Index> MirroredCuts::terminals(const std::vector<Index>& through, Half which,
                                           Ends of) const {
  const HalfSurface& half = halves_[static_cast<std::size_t>(which)];
  std::vector<Index> own;
  for (const Index v : through)
    if (half.number[v] >= 0) own.push_back(snapped(half, half.number[v]));
  const std::size_t count = own.size();
  const VertexTree vertices(half.mesh->positions());
  for (const Index v : through) {
    if (half.number[v] >= 0 || (of == Ends::OfHalf && count > 0)) continue;
    const Vector3 image = plane_.image(place(v));
    const bool is_same =
        std::any_of(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(count), [&](Index w) {
          return (half.mesh->positions().row(w).transpose() - image).norm() <=
                 kSameImageEdges * edge_;
        });
    if (!is_same) own.push_back(snapped(half, vertices.nearest(image)));
  }
  std::sort(own.begin(), own.end());
  own.erase(std::unique(own.begin(), own.end()), own.end());
  return own;
}

// Returns the costs of the edges of a half, larger away from the images of cuts of the other half.
Vec MirroredCuts::cost_near_images(const HalfSurface& of, const std::vector<char>& cuts,
                                   const HalfSurface& on) const {
  std::vector<std::pair<Vector3, Vector3>> images;
  const auto image = [&](Index v) { return plane_.image(of.mesh->positions().row(v)); };
  for (Index h = 0; h < of.mesh->half_edge_count(); ++h)
    if (cuts[h] && of.mesh->opposite(h) > h)
      images.emplace_back(image(of.mesh->from_vertex(h)), image(of.mesh->to_vertex(h)));
  const SurfaceMesh& mesh = *on.mesh;
  std::vector<std::vector<Index>> around(to_size(mesh.vertex_count()));
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    around[mesh.from_vertex(h)].push_back(mesh.to_vertex(h));
    if (mesh.opposite(h) < 0) around[mesh.to_vertex(h)].push_back(mesh.from_vertex(h));
  }
  std::vector<double> distance(around.size(), std::numeric_limits<double>::infinity());
  struct Reached {
    double distance;
    Index vertex, image;
    bool operator>(const Reached& o) const {
      return std::tie(distance, vertex, image) > std::tie(o.distance, o.vertex, o.image);
    }
  };
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  const auto reach = [&](Index v, Index k) {
    const double d = distance_to(mesh.positions().row(v), images[to_size(k)]);
    if (d >= distance[v] || d > (kMaxOffEdges + 1) * edge_) return;
    distance[v] = d;
    front.push({d, v, k});
  };
  const VertexTree vertices(mesh.positions());
  for (Index k = 0; k < static_cast<Index>(images.size()); ++k)
    for (const Vector3& p : {images[to_size(k)].first, images[to_size(k)].second})
      reach(vertices.nearest(p), k);
  while (!front.empty()) {
    const Reached r = front.top();
    front.pop();
    if (r.distance > distance[r.vertex]) continue;
    for (const Index w : around[r.vertex]) reach(w, r.image);
  }
  Vec cost = on.cost;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    cost[h] *= off_factor(0.5 *
                          (std::min(distance[mesh.from_vertex(h)], kMaxOffEdges * edge_) +
                           std::min(distance[mesh.to_vertex(h)], kMaxOffEdges * edge_)) /
                          edge_);
  return cost;
}

void MirroredCuts::add_cuts_of(const HalfSurface& half, const std::vector<char>& cuts,
                               std::vector<char>& is_cut) const {
  for (Index h = 0; h < half.mesh->half_edge_count(); ++h)
    if (cuts[h]) is_cut[3 * half.face[face_of(h)] + corner_of(h)] = 1;
}

std::vector<char> MirroredCuts::cut(const std::vector<Index>& through, Half mirrored,
                                    Ends of) const {
  const HalfSurface& one = halves_[static_cast<std::size_t>(mirrored)];
  const HalfSurface& other = halves_[1 - static_cast<std::size_t>(mirrored)];
  std::vector<Index> ends, images;  // of the surface; of the other half
  const VertexTree vertices(other.mesh->positions());
  for (const Index v : terminals(through, mirrored, of)) {
    ends.push_back(one.vertex[v]);
    if (!one.is_border[v])
      images.push_back(vertices.nearest(plane_.image(one.mesh->positions().row(v))));
  }
  Vec cost = cost_;
  for (const Index f : other.face)
    for (Index h = 3 * f; h < 3 * f + 3; ++h) cost[h] *= is_spine_[h] ? 1 : kAvoidedCost;
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (is_spine_[h]) cost[h] *= kSpineCost;
  std::vector<char> half = cut_graph(mesh_, ends, cost, stop_);
  smooth_cuts(mesh_, ends, cost, half, stop_);
  std::vector<char> cut_template(half.size(), 0), own(to_size(one.mesh->half_edge_count()), 0);
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (is_spine_[h]) cut_template[h] = half[h];
  for (Index h = 0; h < one.mesh->half_edge_count(); ++h)
    if (const Index g = 3 * one.face[face_of(h)] + corner_of(h); !is_spine_[g]) own[h] = half[g];
  add_cuts_of(one, own, cut_template);
  add_cuts_of(other, cut_graph(*other.mesh, images, cost_near_images(one, own, other), stop_),
              cut_template);
  for (const Index v : images) ends.push_back(other.vertex[v]);
  cost = cost_;
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (cut_template[h]) cost[h] *= kTemplateCost;
  return cut_graph(mesh_, ends, cost, stop_);
}

std::vector<Index> MirroredCuts::ends_of(const std::vector<char>& is_cut) const {
  std::vector<int> count(to_size(mesh_.vertex_count()), 0);
  const std::vector<char> is_boundary = mesh_.boundary_flags();
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (is_cut[h]) ++count[mesh_.from_vertex(h)];
  std::vector<Index> ends;
  for (Index v = 0; v < mesh_.vertex_count(); ++v)
    if (count[v] == 1 && !is_boundary[v]) ends.push_back(v);
  return ends;
}

std::vector<char> MirroredCuts::with_images(const std::vector<char>& cuts,
                                            const std::vector<char>& part) const {
  std::vector<Index> on;
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (cuts[h]) on.push_back(mesh_.from_vertex(h));
  std::vector<char> is_terminal(to_size(mesh_.vertex_count()), 0);
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    if (part[h]) is_terminal[mesh_.from_vertex(h)] = 1;
  for (const Index v : ends_of(part)) {
    if (is_in_plane(v)) continue;
    const Vector3 image = plane_.image(place(v));
    const Index nearest = *std::min_element(on.begin(), on.end(), [&](Index a, Index b) {
      return (place(a) - image).squaredNorm() < (place(b) - image).squaredNorm();
    });
    is_terminal[nearest] = 1;
  }
  std::vector<char> is_cut = cuts;
  prune_cut(mesh_, is_terminal, is_cut);
  return is_cut;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
