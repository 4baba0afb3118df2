#include "majorant/parametrization/fields/cross_field.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/mesh/geometry.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/fields/internal/cone_potential.h"
#include "majorant/parametrization/fields/internal/field_connection.h"
#include "majorant/parametrization/fields/internal/field_geometry.h"
#include "majorant/parametrization/fields/internal/trivial_connection.h"

namespace majorant {
namespace {

// Principal curvature directions of a triangle mesh, as data for a cross field.

// Integral of the curvature tensor around every vertex: half of each of its edges,
// (dihedral angle) (length) t t^T, t the edge's direction.
std::vector<Eigen::Matrix3d> vertex_tensors(const SurfaceMesh& mesh,
                                            const std::vector<Vector3>& normal) {
  std::vector<Eigen::Matrix3d> tensor(to_size(mesh.vertex_count()), Eigen::Matrix3d::Zero());
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o < h) continue;  // the boundary has -1
    const Vector3 t = edge_vector(mesh, h);
    const Vector3 &n = normal[face_of(h)], &m = normal[face_of(o)];
    const double bend = std::atan2(n.cross(m).dot(t), n.dot(m));
    const double length =
        (mesh.positions().row(mesh.to_vertex(h)) - mesh.positions().row(mesh.from_vertex(h)))
            .norm();
    for (const Index v : {mesh.from_vertex(h), mesh.to_vertex(h)})
      tensor[v] += 0.5 * bend * length * t * t.transpose();
  }
  return tensor;
}

// #F: the fourth power of a unit principal direction (an angle as in CrossField) times
// |k1 - k2| / (|k1| + |k2| + 1 / sqrt(area)): 0 where the surface is flat or umbilic. Curvature is
// that of the edges around the corners [CSM03].
std::vector<std::complex<double>> principal_directions(const SurfaceMesh& mesh,
                                                       const FieldGeometry& geometry) {
  std::vector<Vector3> normal;
  std::vector<double> vertex_area(to_size(mesh.vertex_count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    normal.push_back(edge_vector(mesh, 3 * f).cross(edge_vector(mesh, 3 * f + 1)).normalized());
    for (int k = 0; k < 3; ++k) vertex_area[mesh.faces()(f, k)] += geometry.face_area[f] / 3;
  }
  const std::vector<Eigen::Matrix3d> tensor = vertex_tensors(mesh, normal);
  std::vector<std::complex<double>> directions;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = to_size(mesh.faces()(f, k));
      sum += tensor[v] / (3 * vertex_area[v]);
    }
    const Vector3 x = edge_vector(mesh, 3 * f), y = normal[f].cross(x);
    const double a = x.dot(sum * x), b = x.dot(sum * y), d = y.dot(sum * y);
    // (k1 - k2) e^{2 i angle}: its square points along the fourth power.
    const std::complex<double> deviator(a - d, 2 * b);
    const double mean = (a + d) / 2, half = std::abs(deviator) / 2;
    const double size = std::abs(mean + half) + std::abs(mean - half) + 1 / std::sqrt(mesh.area());
    const std::complex<double> square = deviator * deviator;
    directions.push_back(half > 0 ? square / std::abs(square) * (2 * half / size)
                                  : std::complex<double>(0));
    if (!std::isfinite(std::abs(directions.back()))) directions.back() = 0;  // underflow
  }
  return directions;
}

// Fewer and better cones, by integer changes of the matching of a cross field.
//
// A smoothest field on a coarse mesh has cones that only reflect its triangles: pairs of opposite
// index next to each other, and vertices with more quarter turns than their faces can hold.

// A seamless map needs every angle below 180 degrees; 120 on average leaves room to untangle.
// Chosen, not tuned.
constexpr int kLargestMeanAngle = 120;
// Edges: a quarter turn comes from a vertex that has one too many, rather than from one that
// becomes a cone, up to so far away. Chosen.
constexpr int kNearby = 4;
const std::vector<char> kNoneFixed;
// Of fields that follow edges quads are made. Where they have a vertex their corners are below 180
// degrees; this is the largest that is planned, in quarter turns. One quad around an inner vertex
// would meet itself along an edge.
constexpr double kLargestCorner = 160.0 / 90;
constexpr int kLeastQuads = 2;

// Quarter turns, at least, where angles add up to so many of them; never more than of a regular
// vertex, where quads need none.
int least_turns_at(double angle, int regular) {
  return std::min(regular, static_cast<int>(std::ceil(angle / kLargestCorner)));
}

// Around a vertex the edges that the field follows bound sectors, each of which holds a number of
// quarter turns as inner vertices do: what its angles add up to in a map. At the border they do
// where both border edges are followed.
struct AlignedSectors {
  std::vector<char> is_bound;          // 3 #F: followed by the faces on both sides
  std::vector<Index> of;               // 3 #F: of the corner where a half-edge starts, or -1
  std::vector<int> turns, wanted;      // by sector: of the field; of its angles, rounded
  std::vector<int> least;              // by sector: turns
  std::vector<int> faces;              // by sector
  std::vector<std::vector<Index>> at;  // #V: sectors
  std::vector<Index> vertex;           // by sector
};

class SectorFinder {
 public:
  // is_aligned: 3 #F. fixed: #F, the directions of faces that follow an edge.
  SectorFinder(const SurfaceMesh& mesh, const FieldGeometry& geometry,
               const std::vector<char>& is_aligned, const Vec& fixed)
      : mesh_(mesh), geometry_(geometry), is_aligned_(is_aligned), fixed_(fixed) {}

  AlignedSectors find(const Vec& rotation) {
    const auto corners = to_size(mesh_.half_edge_count());
    sectors_.of.assign(corners, -1);
    sectors_.at.resize(to_size(mesh_.vertex_count()));
    sectors_.is_bound.assign(corners, 0);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) sectors_.is_bound[h] = is_bound(h);
    for (const Index h : first_bounds())
      if (h >= 0) go_around(h);
    count_turns(rotation);
    return sectors_;
  }

 private:
  bool follows(Index h) const {
    constexpr double kParallel = 1e-6;
    const double off = fixed_[face_of(h)] - geometry_.edge_direction[h];
    return std::abs(std::remainder(off, kQuarter)) < kParallel;
  }

  bool is_bound(Index h) const {
    const Index o = mesh_.opposite(h);
    if (o < 0) return is_aligned_[h] && follows(h);
    return (is_aligned_[h] || is_aligned_[o]) && follows(h) && follows(o);
  }

  // #V: a half-edge that starts there, on the border that of the border, or -1.
  std::vector<Index> first_bounds() const {
    const auto size = to_size(mesh_.vertex_count());
    std::vector<int> border_edges(size, 0);
    std::vector<Index> first(size, -1);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      if (!sectors_.is_bound[h]) continue;
      Index& of_vertex = first[mesh_.from_vertex(h)];
      if (mesh_.opposite(h) < 0) {
        ++border_edges[mesh_.from_vertex(h)];
        ++border_edges[mesh_.to_vertex(h)];
        of_vertex = h;
      } else if (!geometry_.is_boundary[mesh_.from_vertex(h)]) {
        of_vertex = h;
      }
    }
    for (std::size_t v = 0; v < size; ++v)
      if (geometry_.is_boundary[v] && border_edges[v] < 2) first[v] = -1;
    return first;
  }

  void go_around(Index first) {
    Index h = first;
    do {
      if (h == first || sectors_.is_bound[h]) {
        first_.push_back(h);
        sectors_.at[mesh_.from_vertex(h)].push_back(static_cast<Index>(sectors_.faces.size()));
        sectors_.vertex.push_back(mesh_.from_vertex(h));
        sectors_.faces.push_back(0);
      }
      sectors_.of[h] = static_cast<Index>(sectors_.faces.size()) - 1;
      ++sectors_.faces.back();
      h = mesh_.opposite(previous(h));
    } while (h >= 0 && h != first);
  }

  void count_turns(const Vec& rotation) {
    Vec angle = Vec::Zero(static_cast<Index>(sectors_.faces.size()));
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (const Index s = sectors_.of[h]; s >= 0) angle[s] += corner_angle(mesh_, h).radians();
    Vec left = angle;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      const Index o = mesh_.opposite(h);
      if (o >= 0 && sectors_.of[o] >= 0 && !sectors_.is_bound[h])
        left[sectors_.of[o]] -= rotation[h];
    }
    for (Index s = 0; s < static_cast<Index>(left.size()); ++s) {
      sectors_.turns.push_back(static_cast<int>(std::lround(left[s] / kQuarter)));
      // Halfway an edge goes on straight rather than around a corner.
      constexpr double kTie = 1e-3;
      const double turns = angle[s] / kQuarter;
      sectors_.wanted.push_back(
          std::abs(turns - 2) < 0.5 + kTie ? 2 : std::max(1, static_cast<int>(std::lround(turns))));
    }
    lower_beside_tips(angle / kQuarter);
    for (Index s = 0; s < static_cast<Index>(left.size()); ++s)
      sectors_.least.push_back(
          std::max(1, least_turns_at(angle[s] / kQuarter, sectors_.wanted[s])));
  }

  // A tip of less than half a quarter turn has a whole one all the same. The reflex sectors before
  // and after it along the border of their region make up for that, half each: else a cone inside
  // has to for every tooth of a saw. angle: by sector, in quarter turns.
  void lower_beside_tips(const Vec& angle) {
    const std::size_t count = first_.size();
    std::vector<Index> after(count, -1), before(count, -1);
    for (std::size_t s = 0; s < count; ++s) {
      after[s] = sectors_.of[next(first_[s])];
      if (after[s] >= 0) before[after[s]] = static_cast<Index>(s);
    }
    Vec lacking = Vec::Zero(angle.size());
    for (std::size_t s = 0; s < count; ++s) {
      const Index tip = static_cast<Index>(s);
      if (angle[tip] >= 0.5) continue;
      for (const std::vector<Index>* beside : {&after, &before}) {
        Index t = (*beside)[s];
        while (t >= 0 && t != tip && sectors_.wanted[t] == 2) t = (*beside)[t];
        if (t >= 0 && sectors_.wanted[t] > 2) lacking[t] += (1 - angle[tip]) / 2;
      }
    }
    for (Index s = 0; s < lacking.size(); ++s)
      if (lacking[s] > 0 && angle[s] - lacking[s] < sectors_.wanted[s] - 0.5) --sectors_.wanted[s];
  }

  const SurfaceMesh& mesh_;
  const FieldGeometry& geometry_;
  const std::vector<char>& is_aligned_;
  const Vec& fixed_;
  AlignedSectors sectors_;
  std::vector<Index> first_;  // by sector: the half-edge that bounds it, its faces on the left
};

// Cones move one edge a sweep; the smoothest field has them nearly in place; chosen, not
// tuned.
constexpr int kMostConeSweeps = 20;
// A sweep takes a solve for each; chosen, not tuned.
constexpr Index kMostCones = 1000;
// The least gain of energy by which a cone moves; rounding shall not move cones: far above the
// rounding of the solves, far below the gain of a move that matters.
constexpr double kLeastConeGain = 1e-6;

// Quarter turns pass along edges from node to node: these are the sectors of followed edges, and
// the vertices that have none.
class Cleanup {
 public:
  Cleanup(const SurfaceMesh& mesh, const FieldGeometry& geometry, const std::vector<char>& is_fixed,
          AlignedSectors sectors, int least_turns, FieldConnection& field)
      : mesh_(mesh),
        geometry_(geometry),
        is_fixed_(is_fixed),
        sectors_(std::move(sectors)),
        least_turns_(least_turns),
        field_(field),
        leaving_(to_size(mesh.vertex_count()) + sectors_.faces.size()) {
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const bool has_sectors = !sectors_.at.empty() && !sectors_.at[v].empty();
      if (!has_sectors) nodes_.push_back(v);
      if (has_sectors)
        for (const Index s : sectors_.at[v]) nodes_.push_back(mesh.vertex_count() + s);
    }
    for (Index h = 0; h < mesh.half_edge_count(); ++h)
      if (movable(h)) leaving_[node_at(h)].push_back(h);
  }

  void lower_energy(ConeEnergy energy, double cone_cost, const StopCheck& stop) {
    Index cones = 0;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) cones += !boundary(v) && turns(v) != 4;
    if (cones > kMostCones) return;
    ConePotential potential(mesh_, geometry_, field_.quarter_turns, energy);
    cancel_pairs(potential, cone_cost, stop);
    for (int sweep = 0; sweep < kMostConeSweeps && improve_places(potential, cone_cost, stop);
         ++sweep)
      cancel_pairs(potential, cone_cost, stop);
  }

  void run() {
    // A pass can make room for the next one; each of them leaves fewer cones.
    while (cancel_neighbours()) {
    }
    for (const Index v : nodes_)
      while (excess(v) != 0) level(v);
  }

 private:
  // Of the corner where a half-edge starts.
  Index node_at(Index h) const {
    const bool in_sector = !sectors_.of.empty() && sectors_.of[h] >= 0;
    return in_sector ? mesh_.vertex_count() + sectors_.of[h] : mesh_.from_vertex(h);
  }
  Index node_beyond(Index h) const { return node_at(mesh_.opposite(h)); }
  // A node's sector, negative for a vertex.
  Index sector(Index v) const { return v - mesh_.vertex_count(); }
  int turns(Index v) const {
    return sector(v) >= 0 ? sectors_.turns[sector(v)] : field_.quarter_turns[v];
  }
  // Of a vertex that is no cone, and of a sector as the surface has it.
  int regular(Index v) const { return sector(v) >= 0 ? sectors_.wanted[sector(v)] : 4; }
  // Any number of turns is welcome there.
  bool boundary(Index v) const { return sector(v) < 0 && geometry_.is_boundary[v]; }
  bool movable(Index h) const {
    const Index o = mesh_.opposite(h);
    if (o < 0 || (!sectors_.is_bound.empty() && sectors_.is_bound[h])) return false;
    return is_fixed_.empty() || !is_fixed_[face_of(h)] || !is_fixed_[face_of(o)] ||
           sector(node_at(h)) >= 0 || sector(node_beyond(h)) >= 0;
  }
  int least_turns(Index v) const {
    if (sector(v) >= 0) return sectors_.least[sector(v)];
    if (sectors_.of.empty()) return least_turns_;
    return std::max(
        {kLeastQuads, least_turns_, least_turns_at(geometry_.angle_sum[v] / kQuarter, regular(v))});
  }
  int most_turns(Index v) const {
    // Faces of less than two quarter turns each.
    if (sector(v) >= 0)
      return std::max(sectors_.faces[sector(v)] * kLargestMeanAngle / 90,
                      std::min(regular(v), 2 * sectors_.faces[sector(v)] - 1));
    return std::max(4, geometry_.valence[v] * kLargestMeanAngle / 90);
  }
  // Quarter turns that v has to give away (> 0) or to receive (< 0).
  int excess(Index v) const {
    if (boundary(v)) return 0;
    const int least = least_turns(v);
    return turns(v) < least ? turns(v) - least : std::max(0, turns(v) - most_turns(v));
  }
  // The change of the number of cones by a quarter turn less at `from` and one more at `to`.
  int change(Index from, Index to) const {
    const auto cost = [&](Index v, int step) {
      return boundary(v) ? 0
                         : std::abs(turns(v) + step - regular(v)) - std::abs(turns(v) - regular(v));
    };
    return cost(from, -1) + cost(to, 1);
  }
  void move(Index h) {
    move_quarter(mesh_, geometry_, h, field_);
    if (const Index s = sector(node_at(h)); s >= 0) --sectors_.turns[s];
    if (const Index s = sector(node_beyond(h)); s >= 0) ++sectors_.turns[s];
  }

  bool cancel_neighbours() {
    bool any = false;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      if (!movable(h) || change(node_at(h), node_beyond(h)) >= 0) continue;
      move(h);
      any = true;
    }
    return any;
  }

  // Pairs (or single cones, at the boundary) that are worth less than they cost, best first.
  void cancel_pairs(ConePotential& potential, double cone_cost, const StopCheck& stop) {
    for (;;) {
      stop.poll();
      std::vector<Index> givers, takers;
      for (Index v = 0; v < mesh_.vertex_count(); ++v)
        if (!boundary(v) && turns(v) != 4) (turns(v) > 4 ? givers : takers).push_back(v);
      if (!mesh_.boundary_loops().empty()) {
        givers.push_back(mesh_.boundary_loops()[0][0]);
        takers.push_back(givers.back());
      }
      std::vector<Index> all = givers;
      all.insert(all.end(), takers.begin(), takers.end());
      potential.watch(std::move(all));
      double best = 0;
      Index from = -1, to = -1;
      for (const Index a : givers)
        for (const Index b : takers) {
          if (a == b) continue;
          const double gain = potential.change(a, b) + cone_cost * change(a, b);
          if (gain >= best) continue;
          best = gain, from = a, to = b;
        }
      if (from < 0) return;
      potential.move(from, to);
      if (boundary(from))
        send(to, -1, [&](Index w) { return boundary(w); });
      else
        send(from, 1, [&](Index w) { return w == to || (boundary(to) && boundary(w)); });
    }
  }

  // Moves every cone to a neighbour, or splits it, where that lowers the energy. True if any moved.
  bool improve_places(ConePotential& potential, double cone_cost, const StopCheck& stop) {
    bool any = false;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (boundary(v) || turns(v) == 4) continue;
      stop.poll();
      const int step = turns(v) > 4 ? 1 : -1;  // what the neighbour gets
      std::vector<Index> ring;
      for (const Index h : leaving_[v]) ring.push_back(mesh_.to_vertex(h));
      potential.watch(std::move(ring));
      Index best = -1;
      double least = 0;
      for (const Index h : leaving_[v]) {
        const Index w = mesh_.to_vertex(h);
        if (boundary(w) || turns(w) + step < least_turns(w) || turns(w) + step > most_turns(w))
          continue;
        const double estimate = potential.estimated_change(v, w, step);
        if (best < 0 || estimate < least) best = h, least = estimate;
      }
      if (best < 0) continue;
      const Index w = mesh_.to_vertex(best), from = step > 0 ? v : w, to = step > 0 ? w : v;
      const double gain = potential.change(from, to) + cone_cost * change(from, to);
      if (gain < -kLeastConeGain) {
        potential.move(from, to);
        move(step > 0 ? best : mesh_.opposite(best));
        any = true;
      }
      for (const Index u : {v, w})
        if (turns(u) == 4) potential.forget(u);
    }
    return any;
  }

  // Gives one quarter turn of a vertex with an excess to the nearest vertex that can take it (or
  // fetches one).
  void level(Index v) {
    const int step = excess(v) > 0 ? 1 : -1;  // what the receiver gets
    const auto takes = [&](Index w, int above) {
      return turns(w) + step >= least_turns(w) && turns(w) + step <= most_turns(w) &&
             turns(w) * step + above <= regular(w) * step;
    };
    const bool found =
        send(
            v, step, [&](Index w) { return !boundary(w) && takes(w, 1); }, kNearby) ||
        send(v, step, [&](Index w) { return boundary(w) || takes(w, 0); });
    if (!found)
      throw Error(ErrorKind::Infeasible,
                  fmt::format("{}vertex {}: the mesh is too coarse for the cones of a cross "
                              "field; refine it or align fewer edges",
                              message_prefix(mesh_),
                              user_vertex(mesh_, sector(v) < 0 ? v : sectors_.vertex[sector(v)])));
  }

  // Moves a quarter turn from v to the nearest vertex that is a goal (step = 1), or from there to v
  // (-1), over as few edges as possible. False when there is none, never if no face is fixed.
  template <class Goal>
  bool send(Index v, int step, const Goal& is_goal,
            int most_edges = std::numeric_limits<int>::max()) {
    std::vector<Index> entered(leaving_.size(), -1), queue{v};
    std::size_t round_end = 1;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      if (next == round_end) {
        if (--most_edges == 0) return false;
        round_end = queue.size();
      }
      for (const Index h : leaving_[queue[next]]) {
        const Index w = node_beyond(h);
        if (w == v || entered[w] >= 0) continue;
        entered[w] = h;
        if (is_goal(w)) {
          for (Index u = w; u != v; u = node_at(entered[u]))
            move(step > 0 ? entered[u] : mesh_.opposite(entered[u]));
          return true;
        }
        queue.push_back(w);
      }
    }
    return false;
  }

  const SurfaceMesh& mesh_;
  const FieldGeometry& geometry_;
  const std::vector<char>& is_fixed_;
  AlignedSectors sectors_;
  const int least_turns_;  // of inner vertices, without edges to follow
  FieldConnection& field_;
  std::vector<Index> nodes_;                 // vertices, or #V + sector, by vertex
  std::vector<std::vector<Index>> leaving_;  // by node, half-edges that may be matched anew
};

// Cancels cones of opposite sign on adjacent vertices, and moves cones next to the boundary into
// it; then moves quarter turns away from vertices that would have too few, or triangles with a mean
// angle above 120 degrees. The matching changes on the way, the angles stay: relax afterwards.
// Edges with is_fixed faces on both sides keep their matching (#F, or empty), but for those that
// end in a sector of followed edges (sectors, or no entries): these are brought to the turns of the
// surface's angles, where that lets cones go, and to one at least. Throws
// Error(Infeasible) when no place is found for a quarter turn.
void optimize_cones(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                    const std::vector<char>& is_fixed, AlignedSectors sectors, int least_turns,
                    FieldConnection& field) {
  Cleanup(mesh, geometry, is_fixed, std::move(sectors), least_turns, field).run();
}

// Lowers cone_energy (cone_potential.h) + cone_cost * sum |quarter_turns - 4| by moves of single
// quarter turns [FBC18]: cancels pairs of cones of opposite sign, and cones into the boundary,
// however far apart, the best first; and moves cones along edges. After optimize_cones, whose
// bounds it keeps. Takes one or two solves and a vector of #V for every cone: surfaces with more
// than 1000 are left alone. Relax afterwards. Throws Stopped.
void lower_cone_energy(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                       const CrossFieldOptions& options, FieldConnection& field) {
  Cleanup(mesh, geometry, kNoneFixed, {}, options.least_quarter_turns, field)
      .lower_energy(options.cone_energy, options.cone_cost, options.stop);
}

using Complex = std::complex<double>;

constexpr int kSymmetry = 4;
constexpr double kNotAligned = 10;  // no angle in (-pi, pi]
// Inverse iteration: the shift as a part of 1 / area, far below the eigenvalues that curvature
// causes; it makes the matrix of a flat surface definite; chosen, not tuned.
constexpr double kShift = 1e-5;
// The iterations of inverse iteration: a bound; chosen, not tuned.
constexpr int kMaxIterations = 60;
// 1 - cosine of two iterates: angles are then good to its square root; the field is relaxed
// afterwards.
constexpr double kConverged = 1e-9;
// Noise added to the start, so that it misses no eigenvector; chosen, not tuned.
constexpr double kStartNoise = 0.1;

// Per face the angle it is fixed to, or kNotAligned.
Vec fixed_angles(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                 const std::vector<char>& aligned) {
  Vec angle = Vec::Constant(mesh.face_count(), kNotAligned);
  if (aligned.empty()) return angle;
  Vec longest = Vec::Zero(mesh.face_count());
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (!aligned[h] && (o < 0 || !aligned[o])) continue;
    const double length =
        (mesh.positions().row(mesh.to_vertex(h)) - mesh.positions().row(mesh.from_vertex(h)))
            .norm();
    if (length <= longest[face_of(h)]) continue;
    longest[face_of(h)] = length;
    angle[face_of(h)] = std::remainder(geometry.edge_direction[h], 4 * kQuarter);
  }
  return angle;
}

// The energy of CrossFieldOptions as a real system in (re, im) of the faces that are not fixed.
class PowerSystem {
 public:
  PowerSystem(const SurfaceMesh& mesh, const FieldGeometry& geometry, const Vec& fixed,
              double mass_weight, const StopCheck& stop)
      : fixed_(fixed),
        mass_(geometry.face_area / mesh.area()),
        row_(to_size(mesh.face_count()), -1) {
    for (Index f = 0; f < mesh.face_count(); ++f)
      if (fixed[f] == kNotAligned) row_[f] = free_++;
    assemble(mesh, geometry, mass_weight, stop);
  }

  bool has_fixed() const { return free_ < static_cast<Index>(row_.size()); }

  // z of all faces that minimizes the energy for the data term sum (mass_weight) |z - q|^2; of
  // fixed faces the fixed value. data: mass times q.
  std::vector<Complex> solve(const std::vector<Complex>& data) const {
    Vec rhs = rhs_;
    for (std::size_t f = 0; f < row_.size(); ++f)
      if (row_[f] >= 0) rhs.segment<2>(2 * row_[f]) += Vector2(data[f].real(), data[f].imag());
    const Vec x = free_ > 0 ? system_->solve(rhs) : Vec();
    std::vector<Complex> z;
    for (std::size_t f = 0; f < row_.size(); ++f)
      z.push_back(row_[f] >= 0 ? Complex(x[2 * row_[f]], x[2 * row_[f] + 1])
                               : std::polar(1.0, kSymmetry * fixed_[static_cast<Index>(f)]));
    return z;
  }
  const Vec& mass() const { return mass_; }  // #F, sums to 1

 private:
  void assemble(const SurfaceMesh& mesh, const FieldGeometry& geometry, double mass_weight,
                const StopCheck& stop) {
    rhs_ = Vec::Zero(2 * free_);
    std::vector<SparseSpd::Entry> entries;
    for (Index f = 0; f < mesh.face_count(); ++f)
      for (int k = 0; k < 2; ++k)
        if (const Index r = row_[f]; r >= 0)
          entries.push_back({2 * r + k, 2 * r + k, mass_weight * mass_[f]});
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      const Index o = mesh.opposite(h), r = row_[face_of(h)];
      if (o < 0 || r < 0) continue;
      const double w = geometry.weight[h];
      for (int k = 0; k < 2; ++k) entries.push_back({2 * r + k, 2 * r + k, w});
      // z of the neighbour o / 3 as seen from the face of h is e^{-4 i transport[h]} z.
      const Complex turn = std::polar(1.0, -kSymmetry * geometry.transport[h]);
      const Index c = row_[face_of(o)];
      if (c < 0) {
        const Complex z = w * turn * std::polar(1.0, kSymmetry * fixed_[face_of(o)]);
        rhs_.segment<2>(2 * r) += Vector2(z.real(), z.imag());
      } else if (c < r) {
        entries.push_back({2 * r, 2 * c, -w * turn.real()});
        entries.push_back({2 * r, 2 * c + 1, w * turn.imag()});
        entries.push_back({2 * r + 1, 2 * c, -w * turn.imag()});
        entries.push_back({2 * r + 1, 2 * c + 1, -w * turn.real()});
      }
    }
    if (free_ > 0) system_ = field_system(2 * free_, 2, entries, Ordering::Amd, stop);
  }

  const Vec& fixed_;
  Vec mass_, rhs_;
  std::vector<Index> row_;
  Index free_ = 0;
  std::optional<SparseSpd> system_;
};

Complex inner(const Vec& mass, const std::vector<Complex>& a, const std::vector<Complex>& b) {
  Complex sum = 0;
  for (std::size_t f = 0; f < a.size(); ++f)
    sum += mass[static_cast<Index>(f)] * std::conj(a[f]) * b[f];
  return sum;
}

std::vector<Complex> times_mass(const Vec& mass, const std::vector<Complex>& z, double factor) {
  std::vector<Complex> out(z);
  for (std::size_t f = 0; f < z.size(); ++f) out[f] *= factor * mass[static_cast<Index>(f)];
  return out;
}

// Curvature directions and a little noise that depends on the number of the face only: where
// several fields are equally smooth (round spheres), the one that follows curvature is found.
std::vector<Complex> start_vector(std::vector<Complex> curvature) {
  unsigned state = 1;
  const auto noise = [&] {
    state = state * 1664525u + 1013904223u;  // Numerical Recipes' generator
    return kStartNoise * (static_cast<double>(state >> 8) / double(1 << 24) - 0.5);
  };
  for (Complex& z : curvature) {
    const double re = noise(), im = noise();
    z += Complex(re, im);
  }
  return curvature;
}

// The eigenvector of the smallest eigenvalue, by inverse iteration.
std::vector<Complex> smallest_eigenvector(const PowerSystem& system, std::vector<Complex> z,
                                          const StopCheck& stop) {
  const Vec& mass = system.mass();
  const auto normalize = [&](std::vector<Complex>& x) {
    const double norm = std::sqrt(inner(mass, x, x).real());
    for (Complex& value : x) value /= norm;
  };
  normalize(z);
  for (int k = 0; k < kMaxIterations; ++k) {
    stop.poll();
    std::vector<Complex> next = system.solve(times_mass(mass, z, 1));
    normalize(next);
    const double cosine = std::abs(inner(mass, z, next));
    z = std::move(next);
    if (1 - cosine < kConverged) break;
  }
  return z;
}

void require_valid(const SurfaceMesh& mesh, const CrossFieldOptions& options) {
  if (!(options.curvature_weight >= 0) || !std::isfinite(options.curvature_weight))
    throw InvalidArgument("smoothest_cross_field: curvature_weight must be >= 0");
  if (!(options.cone_cost >= 0) || !std::isfinite(options.cone_cost))
    throw InvalidArgument("smoothest_cross_field: cone_cost must be >= 0");
  if (options.least_quarter_turns < 1 || options.least_quarter_turns > 4)
    throw InvalidArgument("smoothest_cross_field: least_quarter_turns must be 1 to 4");
  if (!options.aligned.empty() && options.aligned.size() != to_size(mesh.half_edge_count()))
    throw InvalidArgument("smoothest_cross_field: aligned must have 3 #F entries");
}

[[noreturn]] void refuse(const SurfaceMesh& mesh, const std::string& what) {
  throw Error(ErrorKind::Usage, fmt::format("{}cones: {}", message_prefix(mesh), what));
}

// Per vertex the quarter turns asked for; 0 at the boundary.
std::vector<int> checked_quarter_turns(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                       const std::vector<Cone>& cones) {
  std::vector<int> turns(to_size(mesh.vertex_count()), 4);
  for (std::size_t v = 0; v < turns.size(); ++v)
    if (geometry.is_boundary[v]) turns[v] = 0;
  std::vector<char> seen(turns.size(), 0);
  for (const Cone& cone : cones) {
    const Index v = cone.vertex;
    if (v < 0 || v >= mesh.vertex_count())
      refuse(mesh, fmt::format("there is no vertex {} (counting from 0)", v));
    const Index name = mesh.input_vertex(v);  // from 0, as files of cones do
    if (geometry.is_boundary[v])
      refuse(mesh, fmt::format("vertex {} lies on the boundary, where angles are free", name));
    if (seen[v]) refuse(mesh, fmt::format("vertex {} is given twice", name));
    if (cone.quarter_turns < 1)
      refuse(mesh, fmt::format("vertex {} has {} quarter turns, must have at least 1", name,
                               cone.quarter_turns));
    // Angles of a map are below 180 degrees.
    const int faces = geometry.valence[v];
    if (cone.quarter_turns >= 2 * faces)
      refuse(mesh, fmt::format("vertex {} has {} quarter turns, but its {} faces hold at most {}; "
                               "refine the mesh there",
                               name, cone.quarter_turns, faces, 2 * faces - 1));
    seen[v] = 1;
    turns[v] = cone.quarter_turns;
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

// A field whose cones are cleaned up and whose branches are not relaxed to them yet.
struct ConedField {
  FieldConnection field;
  Vec hold;      // #F: how strongly each keeps its direction, as Relaxation has it
  bool is_free;  // follows neither curvature nor edges
};

ConedField coned_field(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                       const CrossFieldOptions& options) {
  const Vec fixed = fixed_angles(mesh, geometry, options.aligned);
  // Masses are parts of the area and edge weights have no unit, so eigenvalues are in 1 / area.
  const double pull = options.curvature_weight * options.curvature_weight;
  std::optional<PowerSystem> system(std::in_place, mesh, geometry, fixed, std::max(pull, kShift),
                                    options.stop);
  const std::vector<Complex> curvature = principal_directions(mesh, geometry);
  const bool is_free = pull == 0 && !system->has_fixed();
  std::vector<Complex> z;
  if (is_free)
    z = smallest_eigenvector(*system, start_vector(curvature), options.stop);
  else
    z = system->solve(times_mass(system->mass(), curvature, pull));
  const Vec mass = system->mass();
  system.reset();  // its memory is wanted
  Vec angle(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f)
    angle[f] = z[f] == Complex(0) ? 0.0 : std::arg(z[f]) / kSymmetry;
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (fixed[f] != kNotAligned) angle[f] = fixed[f];
  FieldConnection field = nearest_matching(mesh, geometry, angle);
  std::vector<char> is_fixed(to_size(mesh.face_count()), 0);
  Vec hold(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    is_fixed[f] = fixed[f] != kNotAligned;
    hold[f] = is_fixed[f] ? std::numeric_limits<double>::infinity()
                          : pull * mass[f] * std::abs(curvature[f]);
  }
  options.stop.poll();
  optimize_cones(mesh, geometry, is_fixed,
                 options.aligned.empty()
                     ? AlignedSectors()
                     : SectorFinder(mesh, geometry, options.aligned, fixed).find(field.rotation),
                 options.least_quarter_turns, field);
  options.stop.poll();
  if (is_free) lower_cone_energy(mesh, geometry, options, field);
  return {std::move(field), std::move(hold), is_free};
}

}  // namespace

CrossField smoothest_cross_field(const SurfaceMesh& mesh, const CrossFieldOptions& options) {
  require_valid(mesh, options);
  const FieldGeometry geometry(mesh);
  auto [field, hold, is_free] = coned_field(mesh, geometry, options);
  if (is_free)
    relax_and_round_turning(mesh, geometry, field);
  else
    Relaxation(mesh, geometry, hold).apply(field.angle, field.rotation);
  return cross_field(mesh, geometry, field);
}

std::vector<Index> smoothest_field_cones(const SurfaceMesh& mesh,
                                         const CrossFieldOptions& options) {
  require_valid(mesh, options);
  const FieldGeometry geometry(mesh);
  const std::vector<int> turns = coned_field(mesh, geometry, options).field.quarter_turns;
  std::vector<Index> cones;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!geometry.is_boundary[v] && turns[v] != 4) cones.push_back(v);
  return cones;
}

std::vector<Index> cone_vertices(const CrossField& field) {
  std::vector<Index> cones;
  for (std::size_t v = 0; v < field.quarter_turns.size(); ++v)
    if (field.quarter_turns[v] != 0 && field.quarter_turns[v] != 4)
      cones.push_back(static_cast<Index>(v));
  return cones;
}

void comb(const SurfaceMesh& mesh, const std::vector<char>& is_cut, CrossField& field) {
  if (is_cut.size() != to_size(mesh.half_edge_count()) || field.turns.size() != is_cut.size())
    throw InvalidArgument("comb: is_cut and field.turns must have 3 #F entries");
  const auto turn = [&](Index f, int quarters) {  // the branch of f becomes the one `quarters` on
    field.angle[f] = std::remainder(field.angle[f] + quarters * kQuarter, 4 * kQuarter);
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const Index o = mesh.opposite(h);
      if (o < 0) continue;
      field.turns[h] = (field.turns[h] - quarters + 8) % 4;
      field.turns[o] = (4 - field.turns[h]) % 4;
    }
  };
  std::vector<char> seen(to_size(mesh.face_count()), 0);
  for (Index start = 0; start < mesh.face_count(); ++start) {
    if (seen[start]) continue;
    seen[start] = 1;
    std::vector<Index> queue{start};
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (Index h = 3 * queue[next]; h < 3 * queue[next] + 3; ++h) {
        const Index o = mesh.opposite(h);
        if (o < 0 || is_cut[h] || seen[face_of(o)]) continue;
        seen[face_of(o)] = 1;
        queue.push_back(face_of(o));
        turn(face_of(o), -field.turns[h]);
      }
  }
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) >= 0 && !is_cut[h] && field.turns[h] != 0)
      throw Error(ErrorKind::Usage,
                  fmt::format("{}edge ({}, {}): the field cannot be combed, the cut surface has "
                              "a cone inside or is not simply connected",
                              message_prefix(mesh), user_vertex(mesh, mesh.from_vertex(h)),
                              user_vertex(mesh, mesh.to_vertex(h))));
}

CrossField cross_field_with_cones(const SurfaceMesh& mesh, const std::vector<Cone>& cones) {
  const FieldGeometry geometry(mesh);
  const std::vector<int> turns = checked_quarter_turns(mesh, geometry, cones);
  return cross_field(mesh, geometry, trivial_connection(mesh, geometry, turns));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
