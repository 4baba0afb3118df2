// cross_field_with_cones: a trivial connection [CDS10].
#include <fmt/format.h>

#include <cmath>

#include "majorant/framework/error.h"
#include "majorant/parametrization/cross_field.h"
#include "majorant/parametrization/field_connection.h"

namespace majorant {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

[[noreturn]] void refuse(const SurfaceMesh& mesh, const std::string& what) {
  throw Error(ErrorKind::Usage, fmt::format("{}: cones: {}", mesh.file(), what));
}

// Per vertex the quarter turns asked for; 0 at the boundary.
std::vector<int> checked_quarter_turns(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                       const std::vector<Cone>& cones) {
  std::vector<int> turns(at(mesh.vertex_count()), 4);
  for (std::size_t v = 0; v < turns.size(); ++v)
    if (geometry.is_boundary[v]) turns[v] = 0;
  std::vector<char> seen(turns.size(), 0);
  for (const Cone& cone : cones) {
    const Index v = cone.vertex;
    if (v < 0 || v >= mesh.vertex_count())
      refuse(mesh, fmt::format("there is no vertex {} (counting from 0)", v));
    const Index name = mesh.input_vertex(v) + 1;
    if (geometry.is_boundary[at(v)])
      refuse(mesh, fmt::format("vertex {} lies on the boundary, where angles are free", name));
    if (seen[at(v)]) refuse(mesh, fmt::format("vertex {} is given twice", name));
    if (cone.quarter_turns < 1)
      refuse(mesh, fmt::format("vertex {} has {} quarter turns, must have at least 1", name,
                               cone.quarter_turns));
    seen[at(v)] = 1;
    turns[at(v)] = cone.quarter_turns;
  }
  const Index chi = mesh.topology().euler_characteristic();
  long long sum = 0;
  for (const int q : turns) sum += 4 - q;
  if (mesh.boundary_loops().empty() && sum != 4 * chi)
    refuse(mesh, fmt::format("the sum of 4 - quarter turns is {}, must be {} on a closed surface "
                             "of Euler characteristic {}",
                             sum, 4 * chi, chi));
  return turns;
}

// The rotations of least sum weight rotation^2 with the given quarter turns, whatever the turning
// along loops: potentials on the interior vertices, one sparse solve.
Vec least_rotations(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                    const std::vector<int>& quarter_turns) {
  const bool closed = mesh.boundary_loops().empty();
  std::vector<Index> row(at(mesh.vertex_count()), -1);
  Index size = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!geometry.is_boundary[at(v)] && !(closed && v == 0)) row[at(v)] = size++;
  Vec rotation = Vec::Zero(mesh.half_edge_count());
  if (size == 0) return rotation;
  std::vector<SymmetricSystem::Entry> entries;
  Vec rhs(size);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (row[at(v)] >= 0) rhs[row[at(v)]] = geometry.angle_sum[v] - kQuarter * quarter_turns[at(v)];
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (mesh.opposite(h) < 0) continue;
    const Index r = row[at(mesh.to_vertex(h))], c = row[at(mesh.from_vertex(h))];
    if (r < 0) continue;
    entries.push_back({r, r, 1 / geometry.weight[h]});
    if (c > r) entries.push_back({r, c, -1 / geometry.weight[h]});
  }
  const Vec potential = SymmetricSystem(size, 1, entries).solve(rhs);
  const auto value = [&](Index v) { return row[at(v)] < 0 ? 0.0 : potential[row[at(v)]]; };
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) >= 0)
      rotation[h] = (value(mesh.to_vertex(h)) - value(mesh.from_vertex(h))) / geometry.weight[h];
  return rotation;
}

// Makes the branches follow `rotation` from face to face along a spanning tree of the faces. Where
// the tree does not pass, the branches that meet differ by `gap` from it, up to quarter turns. The
// gaps vanish on disks and spheres; else each of the independent loops has one, rounded to the
// nearest, and those of the other edges follow from the gaps around every vertex adding up to 0.
class BranchesAlongTree {
 public:
  BranchesAlongTree(const SurfaceMesh& mesh, const FieldGeometry& geometry, Vec rotation)
      : mesh_(mesh), geometry_(geometry), crossed_(at(mesh.half_edge_count()), 0) {
    field_.angle = Vec::Zero(mesh.face_count());
    field_.rotation = std::move(rotation);
    follow();
    close_gaps();
    field_.quarter_turns = count_quarter_turns(mesh, geometry, field_.rotation);
  }
  const FieldConnection& field() const { return field_; }

 private:
  void follow() {
    std::vector<char> seen(at(mesh_.face_count()), 0);
    std::vector<Index> queue{0};
    seen[0] = 1;
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (Index h = 3 * queue[next]; h < 3 * queue[next] + 3; ++h) {
        const Index o = mesh_.opposite(h);
        if (o < 0 || seen[at(o / 3)]) continue;
        seen[at(o / 3)] = crossed_[at(h)] = crossed_[at(o)] = 1;
        field_.angle[o / 3] = std::remainder(
            field_.angle[h / 3] + geometry_.transport[h] + field_.rotation[h], 4 * kQuarter);
        queue.push_back(o / 3);
      }
  }

  void close_gaps() {
    // A spanning tree of the vertices over edges that were not crossed; the boundary is one vertex.
    std::vector<std::vector<Index>> leaving(at(mesh_.vertex_count()));
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (mesh_.opposite(h) >= 0 && !crossed_[at(h)])
        leaving[at(mesh_.from_vertex(h))].push_back(h);
    std::vector<char> seen = geometry_.is_boundary;
    std::vector<Index> entered(seen.size(), -1), queue;
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (seen[at(v)]) queue.push_back(v);
    if (queue.empty()) {
      queue.push_back(0);
      seen[0] = 1;
    }
    std::vector<char> in_tree(at(mesh_.half_edge_count()), 0);
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (const Index h : leaving[at(queue[next])]) {
        const Index v = mesh_.to_vertex(h);
        if (seen[at(v)]) continue;
        seen[at(v)] = in_tree[at(h)] = in_tree[at(mesh_.opposite(h))] = 1;
        entered[at(v)] = h;
        queue.push_back(v);
      }
    Vec around = Vec::Zero(mesh_.vertex_count());  // sum of the gaps of half-edges that enter
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      const Index o = mesh_.opposite(h);
      if (o < h || crossed_[at(h)] || in_tree[at(h)]) continue;
      const double gap =
          field_.angle[o / 3] - field_.angle[h / 3] - geometry_.transport[h] - field_.rotation[h];
      add_gap(h, gap - kQuarter * std::round(gap / kQuarter), around);
    }
    for (std::size_t k = queue.size(); k-- > 0;)
      if (const Index h = entered[at(queue[k])]; h >= 0) add_gap(h, -around[queue[k]], around);
  }

  void add_gap(Index h, double gap, Vec& around) {
    const Index o = mesh_.opposite(h);
    field_.rotation[h] += gap;
    field_.rotation[o] -= gap;
    around[mesh_.to_vertex(h)] += gap;
    around[mesh_.from_vertex(h)] -= gap;
  }

  const SurfaceMesh& mesh_;
  const FieldGeometry& geometry_;
  std::vector<char> crossed_;
  FieldConnection field_;
};

}  // namespace

CrossField cross_field_with_cones(const SurfaceMesh& mesh, const std::vector<Cone>& cones) {
  const FieldGeometry geometry(mesh);
  const std::vector<int> turns = checked_quarter_turns(mesh, geometry, cones);
  FieldConnection field =
      BranchesAlongTree(mesh, geometry, least_rotations(mesh, geometry, turns)).field();
  relax(mesh, geometry, {}, field);
  return cross_field(mesh, geometry, field);
}

}  // namespace majorant
