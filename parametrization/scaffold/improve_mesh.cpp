#include "majorant/parametrization/scaffold/improve_mesh.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/element_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/backtracking.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/element_values.h"
#include "majorant/framework/error.h"
#include "majorant/framework/problem.h"
#include "majorant/maps/quadrature_hierarchy.h"
#include "majorant/mesh/half_edge_flip.h"
#include "majorant/parametrization/scaffold/internal/quadrilateral.h"

namespace majorant {
namespace {

// The energy of many separate pairs of Bezier triangles, minimized over the control points inside
// each pair. Newton's method runs for all pairs at once, with a step length for each of them.
//
//   const PairEnergy pairs(space, rest, options.map.energy, rule);
//   pairs.minimize(x);                   // x is certified before and after
//   const Vec value = pairs.values(x);   // one a face
//
// A pair has few unknowns of its own, so its systems are dense.

class PairEnergy {
 public:
  // Faces 2p and 2p + 1 of the space share an edge and no node with other pairs; `rest` has a shape
  // per face. Throws InvalidArgument if the energy is empty.
  PairEnergy(std::shared_ptr<const BezierTriangleSpace> space, const RestShapes& rest,
             const EnergySum& energy, const Quadrature& rule);

  // Returns the #F integrals of the energy. x: 2 numbers per node.
  Vec values(VecIn x) const;
  // Moves the points that both triangles share and those inside them while that lowers the pair's
  // energy. Faces stay injective: a pair that cannot be certified at the end keeps its points, and
  // so does one of infinite energy.
  void minimize(Vec& x) const;

 private:
  struct Pair;
  void find_variables();
  void linearize(VecIn x, std::vector<Pair>& pairs) const;
  void add_local(VecIn x, const DensityTerm& term, double weight, std::vector<Pair>& pairs) const;
  void find_directions(std::vector<Pair>& pairs) const;
  void search(Vec& x, std::vector<Pair>& pairs) const;
  Index pair_count() const { return space_->element_count() / 2; }
  template <class Visit>
  void for_variables(Index pair, const Visit& visit) const;

  std::shared_ptr<const BezierTriangleSpace> space_;
  EnergySum energy_;
  std::vector<std::shared_ptr<const DensityTerm>> terms_;
  std::optional<Curvature> curvature_;  // none: the terms support no common one
  std::vector<int> variable_;           // by node: index among its pair's inner points, -1: outer
  std::vector<std::vector<Index>> inner_;  // by pair: its inner nodes
};

// Upper bound on the Newton steps of a pair, three times what pairs need.
constexpr int kMaxPairSteps = 30;
// A pair is done at a predicted decrease below this, relative to its energy: a fifth of
// LineSearch::kResolution, since a pair's energy is a sum of few terms.
constexpr double kConverged = 1e-13;
// Upper bound on the steps of a line search; the last one is a millionth of the first.
constexpr int kMaxLineSearchSteps = 20;
// The curvature models in the order of preference; those that are never indefinite come first.
constexpr Curvature kPreferred[] = {Curvature::Projected, Curvature::Majorizer,
                                    Curvature::CompositeMajorizer, Curvature::Reweighted,
                                    Curvature::Exact};

struct PairEnergy::Pair {
  bool active = true;
  double value = 0, descent = 0, step = 0;
  Vec gradient, direction;
  Eigen::MatrixXd hessian;
};

PairEnergy::PairEnergy(std::shared_ptr<const BezierTriangleSpace> space, const RestShapes& rest,
                       const EnergySum& energy, const Quadrature& rule)
    : space_(std::move(space)), energy_(energy) {
  if (energy.empty()) throw InvalidArgument("PairEnergy: no energy");
  for (const WeightedEnergy& e : energy) terms_.push_back(e.make(space_, rest, {rule}));
  for (const Curvature c : kPreferred)
    if (!curvature_ && std::all_of(terms_.begin(), terms_.end(),
                                   [c](const auto& term) { return term->supports(c); }))
      curvature_ = c;
  find_variables();
}

void PairEnergy::find_variables() {
  variable_.assign(to_size(space_->node_count()), 0);
  for (const Index node : space_->boundary_nodes()) variable_[node] = -1;
  inner_.resize(to_size(pair_count()));
  std::vector<char> met(variable_.size(), 0);
  for (Index f = 0; f < space_->element_count(); ++f)
    for (Index l = 0; l < space_->cells().cols(); ++l) {
      const Index node = space_->cells()(f, l);
      if (variable_[node] < 0 || met[node]) continue;
      met[node] = 1;
      variable_[node] = static_cast<int>(inner_[f / 2].size());
      inner_[f / 2].push_back(node);
    }
}

// Calls visit(unknown of x, unknown of the pair).
template <class Visit>
void PairEnergy::for_variables(Index pair, const Visit& visit) const {
  const std::vector<Index>& nodes = inner_[pair];
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (Index c = 0; c < 2; ++c) visit(2 * nodes[k] + c, 2 * static_cast<Index>(k) + c);
}

Vec PairEnergy::values(VecIn x) const {
  Vec sum = Vec::Zero(space_->element_count());
  const std::vector<RuleId> rules(to_size(space_->element_count()), 0);
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const ColoredBatches plan(terms_[k]->element_dofs(), rules);
    sum += energy_[k].weight * element_values(*terms_[k], TermState{}, plan, x);
  }
  return sum;
}

void PairEnergy::add_local(VecIn x, const DensityTerm& term, double weight,
                           std::vector<Pair>& pairs) const {
  constexpr int stride = LocalSystem::stride;
  const int size = term.element_dofs().local_size();
  Workspace workspace, memory;
  LocalSystem local;
  local.value = memory.reserve(to_size(stride * (1 + size + size * (size + 1) / 2)));
  local.gradient = local.value + stride;
  local.hessian = local.gradient + size * stride;
  const TermState state;
  const std::vector<RuleId> rules(to_size(space_->element_count()), 0);
  const ColoredBatches plan(term.element_dofs(), rules);
  std::vector<int> variable(to_size(size));
  for (Index c = 0; c < plan.batch_count(); ++c) {
    const ElementBatch batch = plan.batch(c);
    term.local(x, batch, *curvature_, state, workspace, local);
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      Pair& pair = pairs[e / 2];
      for (int i = 0; i < size; ++i) {
        const int v = variable_[space_->cells()(e, i / 2)];
        variable[i] = v < 0 ? -1 : 2 * v + i % 2;
      }
      for (int i = 0; i < size; ++i) {
        if (variable[i] < 0) continue;
        pair.gradient[variable[i]] += weight * local.gradient[to_size(i * stride) + p];
        for (int j = 0; j <= i; ++j) {
          if (variable[j] < 0) continue;
          const auto [low, high] = std::minmax(variable[i], variable[j]);
          pair.hessian(high, low) +=
              weight * local.hessian[to_size((i * (i + 1) / 2 + j) * stride) + p];
        }
      }
    }
  }
}

void PairEnergy::linearize(VecIn x, std::vector<Pair>& pairs) const {
  const Vec value = values(x);
  for (Index p = 0; p < pair_count(); ++p) {
    Pair& pair = pairs[p];
    const auto size = 2 * static_cast<Index>(inner_[p].size());
    pair.value = value[2 * p] + value[2 * p + 1];
    pair.gradient.setZero(size);
    pair.hessian.setZero(size, size);
  }
  for (std::size_t k = 0; k < terms_.size(); ++k)
    add_local(x, *terms_[k], energy_[k].weight, pairs);
}

// Computes Newton directions. A pair without a direction of descent, or next to its minimum, is
// done.
void PairEnergy::find_directions(std::vector<Pair>& pairs) const {
  for (Pair& pair : pairs) {
    if (!pair.active) continue;
    const Eigen::LLT<Eigen::MatrixXd> factor(pair.hessian);
    pair.active = std::isfinite(pair.value) && factor.info() == Eigen::Success;
    if (!pair.active) continue;
    pair.direction = -factor.solve(pair.gradient);
    pair.descent = pair.direction.dot(pair.gradient);
    pair.active = pair.descent < -kConverged * std::abs(pair.value);
  }
}

void PairEnergy::search(Vec& x, std::vector<Pair>& pairs) const {
  Vec direction = Vec::Zero(x.size());
  std::vector<Index> open;
  for (Index p = 0; p < pair_count(); ++p) {
    if (!pairs[p].active) continue;
    for_variables(p, [&](Index i, Index k) { direction[i] = pairs[p].direction[k]; });
    open.push_back(p);
  }
  for (const Index p : open) {
    double step = 1 / kPartOfLimit;
    for (const Index f : {2 * p, 2 * p + 1})
      step = std::min(step, space_->largest_step(f, x, direction, step, ProofDepth::kStart));
    pairs[p].step = kPartOfLimit * step;
  }
  if (open.empty()) return;
  const auto attempt = [&](double part) {  // fraction of every pair's own step
    Vec trial = x;
    for (const Index p : open)
      for_variables(p, [&](Index i, Index) { trial[i] += part * pairs[p].step * direction[i]; });
    const Vec value = values(trial);
    std::erase_if(open, [&](Index p) {
      const Pair& pair = pairs[p];
      const double limit = pair.value + kArmijo * (part * pair.step) * pair.descent;
      if (!(value[2 * p] + value[2 * p + 1] <= limit)) return false;
      for_variables(p, [&](Index i, Index) { x[i] = trial[i]; });
      return true;
    });
    return open.empty() ? kTake : kHalve;
  };
  backtrack(1, {.most_trials = kMaxLineSearchSteps}, attempt);
  for (const Index p : open) pairs[p].active = false;
}

void PairEnergy::minimize(Vec& x) const {
  if (!curvature_ || space_->degree() == 1) return;
  const Vec start = x;
  std::vector<Pair> pairs(to_size(pair_count()));
  const auto any_active = [&] {
    return std::any_of(pairs.begin(), pairs.end(), [](const Pair& p) { return p.active; });
  };
  for (int k = 0; k < kMaxPairSteps && any_active(); ++k) {
    linearize(x, pairs);
    find_directions(pairs);
    search(x, pairs);
  }
  for (Index p = 0; p < pair_count(); ++p)
    for (const Index f : {2 * p, 2 * p + 1})
      if (space_->certify(f, x, ProofDepth::kStart).result != ProofStatus::Proven)
        for_variables(p, [&](Index i, Index) { x[i] = start[i]; });
}

// The largest distance from a plane over the quadrilateral's size: some thousand unit roundoffs,
// the error of coordinates of planes in general position.
constexpr double kCoplanar = 1e-12;
// The least sine of an angle of a new triangle: square root of the unit roundoff.
constexpr double kSine = 1e-8;
// The least gain of a flip, relative to a pair's energy; a smaller gain may come from unfinished
// Newton steps.
constexpr double kGain = 1e-9;
// Energies are equal if they differ by less than this fraction, ten times the tolerance of a pair's
// minimization.
constexpr double kSameEnergy = 1e-12;
// The index of the rule among the measuring ones: accurate to 1e-5 on mild maps.
constexpr std::size_t kRuleOfMaps = 1;
// Upper bound on flips per face. Each flip lowers the energy, and faces need a few; more are due to
// rounding.
constexpr long kMaxFlipsPerFace = 100;

// A separate pair of faces, as it is and with its other diagonal: vertices a, b, c, d are 0, 1, 2,
// 3.
struct Trial {
  Index half_edge;
  bool is_delaunay;  // as it is
  BezierMesh pair, flipped;
};

BezierMesh as_bezier_mesh(const BezierMap& map) {
  return bezier_mesh(map.degree(), map.mesh().faces(), map.space().cells(), map.control_points());
}

Quadrature rule_of_degree(int n) {
  const std::vector<Quadrature> rules = measuring_rules(n);
  return rules[std::min(kRuleOfMaps, rules.size() - 1)];
}

class Improver {
 public:
  Improver(const BezierMap& map, const EnergySum& energy)
      : map_(map),
        energy_(energy),
        rule_(rule_of_degree(map.degree())),
        mesh_(as_bezier_mesh(map)),
        is_queued_(mesh_.opposite.size(), 0) {
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      input_face_.push_back(map.mesh().input_face(f));
      if (map.space().certify(f, map.control_points(), ProofDepth::kFinal).result !=
          ProofStatus::Proven)
        throw InvalidArgument(fmt::format("improve_mesh: face {} of the map is not injective", f));
    }
    for (Index h = 0; h < 3 * mesh_.face_count(); ++h)
      if (mesh_.opposite[h] > h) push(h);
  }

  // Flips edges; pairs that share no face are tried together.
  ImprovedMap run(const StopCheck& stop) {
    while (!queue_.empty() && flips_.performed < kMaxFlipsPerFace * mesh_.face_count() &&
           stop() == Directive::Continue)
      try_pairs(next_pairs());
    if (flips_.performed == 0) return {map_, flips_};
    return {result(), flips_};
  }

 private:
  const Points3& positions() const { return map_.mesh().positions(); }

  void push(Index h) {
    if (mesh_.opposite[h] < 0 || is_queued_[h]) return;
    is_queued_[h] = 1;
    queue_.push_back(h);
  }

  // Returns the corners of a pair in the plane of one of its faces; none if they are not coplanar.
  std::optional<Quadrilateral> unfolded(Index h) const {
    const Index o = mesh_.opposite[h];
    const auto relative = [&, origin = mesh_.from_vertex(h)](Index side) -> Vector3 {
      return positions().row(mesh_.from_vertex(side)) - positions().row(origin);
    };
    const Vector3 b = relative(o), c = relative(previous(h)), d = relative(previous(o));
    const Vector3 above = b.cross(c), below = d.cross(b);
    const double size = std::max({b.norm(), c.norm(), d.norm()});
    const double volume = std::abs(above.dot(d));
    if (!(volume <= kCoplanar * size * std::min(above.norm(), below.norm()))) return std::nullopt;
    const Vector3 x = b.normalized(), y = above.normalized().cross(x);
    const auto planar = [&](const Vector3& p) { return Vector2(p.dot(x), p.dot(y)); };
    return Quadrilateral{Vector2::Zero(), planar(d), planar(b), planar(c)};
  }

  std::optional<Trial> trial(Index h) const {
    const std::optional<Quadrilateral> quad = unfolded(h);
    if (!quad || !quad->is_strictly_convex(kSine)) return std::nullopt;
    const Index o = mesh_.opposite[h], here = corner_of(h), there = 3 + corner_of(o);
    Trial t{h, !quad->wants_delaunay_flip(Quadrilateral::kUnfoldedRounding), {}, {}};
    t.pair.degree = mesh_.degree;
    t.pair.faces.resize(2, 3);
    const auto set = [&](Index side, Index vertex) {
      t.pair.faces(face_of(side), corner_of(side)) = vertex;
    };
    set(here, 0);
    set(next(here), 1);
    set(previous(here), 2);
    set(there, 1);
    set(next(there), 0);
    set(previous(there), 3);
    t.pair.opposite.assign(6, -1);
    t.pair.opposite[here] = there;
    t.pair.opposite[there] = here;
    t.pair.points.resize(2, mesh_.points.cols());
    t.pair.points.row(0) = mesh_.points.row(face_of(h));
    t.pair.points.row(1) = mesh_.points.row(face_of(o));
    t.flipped = t.pair;
    if (!flip_edge(t.flipped, here)) return std::nullopt;
    return t;
  }

  // Takes edges from the queue whose pairs share no face; the others stay there.
  std::vector<Trial> next_pairs() {
    std::vector<Trial> trials;
    std::vector<Index> waiting;
    std::vector<char> is_taken(to_size(mesh_.face_count()), 0);
    for (const Index h : queue_) {
      const Index f = face_of(h), g = face_of(mesh_.opposite[h]);
      if (mesh_.opposite[h] < 0) {  // an earlier flip gave the number to a boundary edge
        is_queued_[h] = 0;
        continue;
      }
      if (is_taken[f] || is_taken[g]) {
        waiting.push_back(h);
        continue;
      }
      is_queued_[h] = 0;
      std::optional<Trial> t = trial(h);
      if (!t) continue;
      is_taken[f] = is_taken[g] = 1;
      trials.push_back(std::move(*t));
    }
    queue_ = std::move(waiting);
    return trials;
  }

  // The pairs side by side in one mesh, with inner points and values of least energy: pair p has
  // faces 2p, 2p + 1 and vertices 4p .. 4p + 3.
  struct RelaxedPairs {
    std::shared_ptr<const BezierTriangleSpace> space;
    Vec x, value;
    double energy(std::size_t pair) const {
      return value[2 * static_cast<Index>(pair)] + value[2 * static_cast<Index>(pair) + 1];
    }
  };
  RelaxedPairs relaxed(const std::vector<Trial>& trials, BezierMesh Trial::*which) const {
    const auto count = static_cast<Index>(trials.size());
    Cells faces(2 * count, 3);
    Points3 corners(4 * count, 3);
    for (Index p = 0; p < count; ++p) {
      const Index h = trials[p].half_edge, o = mesh_.opposite[h];
      faces.middleRows(2 * p, 2) = (trials[p].*which).faces.array() + 4 * p;
      Index corner = 4 * p;
      for (const Index side : {h, o, previous(h), previous(o)})
        corners.row(corner++) = positions().row(mesh_.from_vertex(side));
    }
    RelaxedPairs out;
    out.space = std::make_shared<const BezierTriangleSpace>(faces, 4 * count, mesh_.degree);
    out.x.resize(2 * out.space->node_count());
    for (Index f = 0; f < 2 * count; ++f)
      for (Index l = 0; l < out.space->cells().cols(); ++l)
        out.x.segment<2>(2 * out.space->cells()(f, l)) =
            (trials[f / 2].*which).point(f % 2, static_cast<int>(l));
    const PairEnergy energy(out.space, flat_triangles(corners, faces), energy_, rule_);
    energy.minimize(out.x);
    out.value = energy.values(out.x);
    return out;
  }

  // Compares both diagonals at their least energy; otherwise the gain of moving points would count
  // for the flip.
  void try_pairs(const std::vector<Trial>& trials) {
    if (trials.empty()) return;
    const RelaxedPairs before = relaxed(trials, &Trial::pair);
    const RelaxedPairs after = relaxed(trials, &Trial::flipped);
    for (std::size_t k = 0; k < trials.size(); ++k) {
      ++flips_.intended;
      const double old = before.energy(k), gain = old - after.energy(k);
      const bool is_better = gain > kGain * std::abs(old);
      const bool is_same = gain >= -kSameEnergy * std::abs(old);
      if (is_better || (is_same && !trials[k].is_delaunay)) accept(trials[k].half_edge, after, k);
    }
  }

  void accept(Index h, const RelaxedPairs& pairs, std::size_t pair) {
    const Index o = mesh_.opposite[h];
    if (!flip_edge(mesh_, h)) return;  // the new edge exists elsewhere
    ++flips_.performed;
    Index relaxed_face = 2 * static_cast<Index>(pair);
    for (const Index face : {face_of(h), face_of(o)}) {
      for (Index l = 0; l < mesh_.points.cols() / 2; ++l)
        mesh_.points.row(face).segment<2>(2 * l) =
            pairs.x.segment<2>(2 * pairs.space->cells()(relaxed_face, l));
      ++relaxed_face;
    }
    input_face_[face_of(h)] = input_face_[face_of(o)] =
        std::min(input_face_[face_of(h)], input_face_[face_of(o)]);
    for (const Index side : flipped_sides(h, o).to) push(side);
  }

  BezierMap result() const {
    auto mesh =
        std::make_shared<const SurfaceMesh>(map_.mesh().with_faces(mesh_.faces, input_face_));
    auto space = std::make_shared<const BezierTriangleSpace>(mesh_.faces, mesh->vertex_count(),
                                                             mesh_.degree);
    Vec x(2 * space->node_count());
    for (Index f = 0; f < mesh_.face_count(); ++f)
      for (Index l = 0; l < space->cells().cols(); ++l)
        x.segment<2>(2 * space->cells()(f, l)) = mesh_.point(f, static_cast<int>(l));
    return BezierMap(std::move(mesh), std::move(space), std::move(x), seams());
  }

  // Seams are sides of the cut surface's boundary, which is renumbered by flips.
  std::shared_ptr<const Seams> seams() const {
    if (map_.seams().empty()) return map_.shared_seams();
    std::map<std::array<Index, 2>, Index> side_of;
    for (Index h = 0; h < 3 * mesh_.face_count(); ++h)
      if (mesh_.opposite[h] < 0) side_of[{mesh_.from_vertex(h), mesh_.to_vertex(h)}] = h;
    const auto renumbered = [&](Index h) {
      return side_of.at({map_.mesh().from_vertex(h), map_.mesh().to_vertex(h)});
    };
    std::vector<SeamEdge> edges = map_.seams().edges();
    for (SeamEdge& edge : edges) {
      edge.side = renumbered(edge.side);
      edge.opposite = renumbered(edge.opposite);
    }
    return std::make_shared<const Seams>(mesh_.faces, map_.seams().surface_vertex(),
                                         std::move(edges), map_.seams().quarter_turns());
  }

  const BezierMap& map_;
  const EnergySum& energy_;
  Quadrature rule_;
  BezierMesh mesh_;
  std::vector<Index> input_face_;
  std::vector<Index> queue_;
  std::vector<char> is_queued_;
  FlipCounts flips_;
};

}  // namespace

ImprovedMap improve_mesh(const BezierMap& map, const EnergySum& energy, const StopCheck& stop) {
  if (energy.empty()) throw InvalidArgument("improve_mesh: no energy");
  if (knows_elements(energy))
    throw InvalidArgument("improve_mesh: the energy has data or weights of faces");
  return Improver(map, energy).run(stop);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
