#include "majorant/parametrization/initialization/collapsing_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

using Vertex3 = Eigen::Vector3d;

// The number of nearest neighbours that a vertex may collapse onto. Chosen, not tuned.
constexpr int kNearestNeighbours = 3;
// The weight of the squared length of the removed edge times the area around it, beside the volume
// between the surfaces. It decides in flat regions. Chosen, not tuned.
constexpr double kLengthWeight = 1e-3;
// Lower bound on the cosine between the normals of a triangle before and after a collapse: 78
// degrees.
constexpr double kMinNormalCosine = 0.2;
// Upper bound on the neighbours of a vertex after a collapse. Larger stars are slow. Chosen, not
// tuned.
constexpr int kMaxNeighbours = 16;
// The fraction of the removable vertices that is removed in one round. Chosen, not tuned.
constexpr double kRoundFraction = 0.6;

// Vertices of a task; fewer are not worth waking a thread for.
constexpr Index kVerticesOfATask = 1024;

struct Candidate {
  double cost = std::numeric_limits<double>::infinity();
  Index vertex = -1, half_edge = -1;  // the vertex is one end of the half-edge
};

// The star of a vertex and the cost of removing it; the mesh does not change meanwhile.
class Star {
 public:
  Star(const CollapsingMesh& mesh, const Points3& positions) : mesh_(mesh), positions_(positions) {}

  Candidate best_of(Index v) {
    gather(v);
    Candidate best;
    const auto consider = [&](std::size_t k, Index h) {
      const double cost = cost_onto(k);
      if (cost < best.cost) best = {cost, v, h};
    };
    if (!closed_) {  // neighbours along the boundary only
      consider(0, spokes_.front());
      consider(edge_.size() - 1, previous(spokes_.back()));
      return best;
    }
    std::array<std::size_t, kNearestNeighbours> nearest;
    const std::size_t count = nearest_to(nearest);
    for (std::size_t k = 0; k < count; ++k) consider(nearest[k], spokes_[nearest[k]]);
    return best;
  }

 private:
  // Sets the star of v: vectors to its neighbours, normals of its faces (their lengths are twice
  // the areas).
  void gather(Index v) {
    spokes_.clear();
    edge_.clear();
    const Vertex3 centre = positions_.row(v);
    mesh_.for_each_leaving(v, [&](Index h) {
      spokes_.push_back(h);
      edge_.push_back(Vertex3(positions_.row(mesh_.to(h))) - centre);
    });
    closed_ = !mesh_.on_boundary(v);
    if (!closed_)
      edge_.push_back(Vertex3(positions_.row(mesh_.from(previous(spokes_.back())))) - centre);
    normal_.clear();
    double area = 0;
    for (std::size_t k = 0; k < spokes_.size(); ++k) {
      normal_.push_back(edge_[k].cross(edge_[(k + 1) % edge_.size()]));
      area += normal_.back().norm();
    }
    area_ = area / 2;
  }

  std::size_t nearest_to(std::array<std::size_t, kNearestNeighbours>& nearest) const {
    std::array<double, kNearestNeighbours> length;
    std::size_t count = 0;
    for (std::size_t k = 0; k < edge_.size(); ++k) {
      if (mesh_.on_boundary(mesh_.to(spokes_[k]))) continue;
      const double l = edge_[k].squaredNorm();
      std::size_t place = count;
      while (place > 0 && l < length[place - 1]) --place;
      if (place >= kNearestNeighbours) continue;
      if (count < kNearestNeighbours) ++count;
      for (std::size_t j = count - 1; j > place; --j) {
        length[j] = length[j - 1];
        nearest[j] = nearest[j - 1];
      }
      length[place] = l;
      nearest[place] = k;
    }
    return count;
  }

  // Returns the cost of moving the vertex onto its k-th neighbour. The cost adds the displacement
  // of its boundary to the squared volume between its old and new faces divided by their areas. The
  // sum is multiplied by the squared deviation of the worst new triangle from an equilateral one.
  double cost_onto(std::size_t k) const {
    const Vertex3& u = edge_[k];
    double volume = 0, worst = 1;
    for (std::size_t f = 0; f < normal_.size(); ++f) {
      const std::size_t g = (f + 1) % edge_.size();
      const Vertex3& n = normal_[f];
      const double squared = n.squaredNorm();
      if (squared > 0) volume += n.dot(u) * n.dot(u) / std::sqrt(squared) / 2;
      if (f == k || g == k) continue;
      const Vertex3 a = edge_[f] - u, b = edge_[g] - u;
      const Vertex3 m = a.cross(b);
      const double area = m.squaredNorm(), turn = m.dot(n);
      if (!(turn > 0) || turn * turn < kMinNormalCosine * kMinNormalCosine * area * squared)
        return std::numeric_limits<double>::infinity();
      // The square of (sum of squared edges) / (4 sqrt(3) area) is 1 for equilateral triangles.
      const double edges = a.squaredNorm() + b.squaredNorm() + (b - a).squaredNorm();
      worst = std::max(worst, edges * edges / (12 * area));
    }
    if (!closed_) volume += boundary_moved();
    return (volume + kLengthWeight * u.squaredNorm() * area_) * worst;
  }

  // Returns the squared distance of a boundary vertex from the line between its boundary
  // neighbours, times the squared length of that line.
  double boundary_moved() const {
    const Vertex3 &a = edge_.front(), &b = edge_.back();
    return a.cross(b).squaredNorm() /
           std::max((b - a).squaredNorm(), std::numeric_limits<double>::min()) *
           (a.norm() + b.norm()) * (a.norm() + b.norm());
  }

  const CollapsingMesh& mesh_;
  const Points3& positions_;
  std::vector<Index> spokes_;
  std::vector<Vertex3> edge_, normal_;
  double area_ = 0;
  bool closed_ = false;
};

class Decimation {
 public:
  Decimation(CollapsingMesh& mesh, const Points3& positions, const DecimationGoal& goal,
             const StopCheck& stop)
      : mesh_(mesh),
        goal_(goal),
        stop_(stop),
        stars_(to_size(ThreadCount::current()), Star(mesh, positions)) {
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.is_present(v) && (goal.held.empty() || !goal.held[v])) free_.push_back(v);
    last_change_.assign(to_size(mesh.vertex_count()), -1);
  }

  void run() {
    const double all = mesh_.faces_left() - goal_.faces;
    while (mesh_.faces_left() > goal_.faces && round() > 0) {
      ++round_;
      stop_.advance(1 - (mesh_.faces_left() - goal_.faces) / all);
    }
  }

 private:
  // Returns a candidate for every free vertex, in arbitrary order.
  std::vector<Candidate> candidates() {
    const auto count = static_cast<Index>(free_.size());
    std::vector<Candidate> all(free_.size());
    const auto look = [&](Index task, int thread) {
      stop_.poll();
      const Index last = std::min(count, (task + 1) * kVerticesOfATask);
      for (Index k = task * kVerticesOfATask; k < last; ++k)
        if (goal_.ears == Ears::Leave || !mesh_.is_ear(free_[k]))
          all[k] = stars_[thread].best_of(free_[k]);
    };
    parallel_tasks((count + kVerticesOfATask - 1) / kVerticesOfATask, look,
                   static_cast<int>(stars_.size()));
    std::erase_if(all, [](const Candidate& c) { return c.half_edge < 0; });
    return all;
  }

  // Runs a round and returns the number of removed vertices.
  int round() {
    std::vector<Candidate> candidates = this->candidates();
    const auto cheaper = [](const Candidate& a, const Candidate& b) {
      return a.cost < b.cost || (a.cost == b.cost && a.vertex < b.vertex);
    };
    const auto middle = candidates.begin() +
                        static_cast<std::ptrdiff_t>(
                            std::ceil(kRoundFraction * static_cast<double>(candidates.size())));
    std::nth_element(candidates.begin(), middle, candidates.end(), cheaper);
    std::sort(candidates.begin(), middle, cheaper);
    int left = 0;
    for (auto c = candidates.begin(); c != middle && mesh_.faces_left() > goal_.faces; ++c)
      left += try_collapse(*c) ? 1 : 0;
    std::erase_if(free_, [&](Index v) { return !mesh_.is_present(v); });
    return left;
  }

  bool try_collapse(const Candidate& c) {
    if (last_change_[c.vertex] == round_) return false;
    const auto end = mesh_.from(c.half_edge) == c.vertex ? CollapsingMesh::End::Start
                                                         : CollapsingMesh::End::Target;
    if (!mesh_.may_collapse(c.half_edge, end, kMaxNeighbours)) return false;
    mesh_.ring(c.vertex, ring_);
    for (const Index w : ring_) last_change_[w] = round_;
    mesh_.collapse(c.half_edge, end);
    return true;
  }

  CollapsingMesh& mesh_;
  const DecimationGoal& goal_;
  const StopCheck& stop_;
  std::vector<Star> stars_;  // by thread
  std::vector<Index> free_, ring_;
  std::vector<int> last_change_;  // by vertex: the round in which its star changed
  int round_ = 0;
};

}  // namespace

CollapsingMesh::CollapsingMesh(const Cells& faces, std::vector<Index> opposite, Index vertex_count)
    : from_(opposite.size()),
      opposite_(std::move(opposite)),
      leaving_(to_size(vertex_count), -1),
      is_present_(to_size(vertex_count), 1),
      has_face_(to_size(static_cast<Index>(faces.rows())), 1),
      faces_left_(static_cast<Index>(faces.rows())) {
  for (Index h = 0; h < static_cast<Index>(from_.size()); ++h) from_[h] = from_vertex(faces, h);
  for (Index h = 0; h < static_cast<Index>(from_.size()); ++h) {
    Index& leaving = leaving_[from(h)];
    if (leaving < 0 || this->opposite(h) < 0) leaving = h;
  }
}

void CollapsingMesh::ring(Index v, std::vector<Index>& ring) const {
  ring.clear();
  Index last = -1;
  for_each_leaving(v, [&](Index h) {
    ring.push_back(to(h));
    last = h;
  });
  if (on_boundary(v)) ring.push_back(from(previous(last)));
}

bool CollapsingMesh::may_collapse(Index h, End leaves, int most) {
  const Index v = leaves == End::Start ? from(h) : to(h),
              u = leaves == End::Start ? to(h) : from(h);
  const Index o = opposite(h);
  if (on_boundary(v) ? o >= 0 : on_boundary(u)) return false;
  // Neither face beside the edge may be attached by this edge alone.
  const auto hangs = [&](Index e) { return opposite(next(e)) < 0 && opposite(previous(e)) < 0; };
  if (hangs(h) || (o >= 0 && hangs(o))) return false;
  ring(v, ring_);
  ring(u, other_ring_);
  const auto sides = static_cast<std::size_t>(o >= 0 ? 2 : 1);
  if (ring_.size() + other_ring_.size() > static_cast<std::size_t>(most) + 2 + sides) return false;
  std::size_t common = 0;
  for (const Index w : ring_)
    common += static_cast<std::size_t>(std::count(other_ring_.begin(), other_ring_.end(), w));
  return common == sides;
}

void CollapsingMesh::link(Index a, Index b) {
  if (a >= 0) opposite_[a] = b;
  if (b >= 0) opposite_[b] = a;
}

// Removes the face of h: its other two edges become one.
void CollapsingMesh::take_out(Index h) {
  link(opposite(next(h)), opposite(previous(h)));
  has_face_[face_of(h)] = 0;
  --faces_left_;
}

void CollapsingMesh::put_back(Index h) {
  for (const Index e : {next(h), previous(h)})
    if (opposite(e) >= 0) opposite_[opposite(e)] = e;
  has_face_[face_of(h)] = 1;
  ++faces_left_;
}

void CollapsingMesh::rename_corners(Index v, Index name) {
  for_each_leaving(v, [&](Index h) { from_[h] = name; });
}

void CollapsingMesh::collapse(Index h, End leaves) {
  // This half-edge has the removed face on its left.
  const Index away = leaves == End::Start ? h : opposite(h);
  const Index back = leaves == End::Start ? opposite(h) : h;
  const Index v = leaves == End::Start ? from(h) : to(h),
              u = leaves == End::Start ? to(h) : from(h);
  Gone gone{v, u, away, back, leaving(u), -1, -1};
  if (away >= 0) gone.leaving_left = leaving(from(previous(away)));
  if (back >= 0) gone.leaving_right = leaving(from(previous(back)));
  const Index v_leaving = leaving(v);
  const bool inside = !on_boundary(u);

  rename_corners(v, u);
  if (away >= 0) take_out(away);
  if (back >= 0) take_out(back);

  // If the outgoing half-edge of a vertex belongs to a removed face, the one glued in its place
  // replaces it.
  Index& at_u = leaving_[u];
  if (inside || (away >= 0 && at_u == next(away))) {
    at_u = opposite(previous(away));
  } else if (away < 0) {  // the boundary ran from u to v
    at_u = v_leaving == next(back) ? opposite(previous(back)) : v_leaving;
  }
  for (const Index e : {away, back}) {
    if (e < 0) continue;
    Index& at_w = leaving_[from(previous(e))];
    if (at_w == previous(e)) at_w = opposite(next(e));
  }
  is_present_[v] = 0;
  gone_.push_back(gone);
}

CollapsingMesh::Restored CollapsingMesh::restore() {
  const Gone gone = gone_.back();
  gone_.pop_back();
  for (const Index e : {gone.away, gone.back})
    if (e >= 0) put_back(e);
  leaving_[gone.onto] = gone.leaving_onto;
  if (gone.away >= 0) leaving_[from(previous(gone.away))] = gone.leaving_left;
  if (gone.back >= 0) leaving_[from(previous(gone.back))] = gone.leaving_right;
  is_present_[gone.vertex] = 1;
  rename_corners(gone.vertex, gone.vertex);
  return {gone.vertex, gone.onto};
}

void decimate(CollapsingMesh& mesh, const Points3& positions, const DecimationGoal& goal,
              const StopCheck& stop) {
  Decimation(mesh, positions, goal, stop).run();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
