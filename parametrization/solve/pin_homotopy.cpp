#include "majorant/parametrization/solve/pin_homotopy.h"

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <random>
#include <utility>

#include "majorant/certify/global_injectivity.h"
#include "majorant/constraints/constraints.h"
#include "majorant/framework/elimination.h"
#include "majorant/framework/error.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"
#include "majorant/parametrization/initialization/untangle.h"

namespace majorant {
namespace {

// The relative decrease that ends an auxiliary solve, a thousand times the final one.
constexpr double kRoughly = 1e-3;
// The stiffness of the springs that pull pins: from a hundred times the default of soft handles up
// to where the energy has three digits left beside them.
constexpr double kFirstStiffness = 1e5, kStiffer = 100, kStiffest = 1e13;
// Steps towards the targets, and more of them if these fail: a right angle is turned by 9 degrees
// at a time, or by a quarter of that.
constexpr int kSteps = 10, kSmallSteps = 40;
// Orders in which pins are moved one after the other, and steps of each. Tuned by bench/pins.py,
// seeds 1 to 3: the eighth order solves the last set, and ten steps solve no more than two.
constexpr int kMostOrders = 8, kStepsInTurn = 2;
// A softly held pin has arrived if it is within this fraction of its way from its target. Chosen;
// stiffer springs do the rest.
constexpr double kArrived = 1e-2;
// The largest distance of a target from the map, in sizes of the map; coordinates there leave seven
// digits for the map.
constexpr double kFarthest = 1e9;

Vector2 place_of(const BezierMap& map, Index vertex) {
  return map.control_points().segment<2>(2 * vertex);
}

Index name_of(const BezierMap& map, Index vertex) { return map.mesh().input_vertex(vertex); }

std::string no_way(const BezierMap& map) {
  return message_prefix(map.mesh()) + "no valid way to the pins' targets found: ";
}

[[noreturn]] void refuse_pins(const BezierMap& map, const std::string& why) {
  throw Error(ErrorKind::Infeasible, no_way(map) + why);
}

// Returns whether only pins hold the map, so that it may be rotated and is worth optimizing before.
bool may_move(const MapOptions& options) { return options.boundary == BoundaryCondition::Free; }

// Returns the options of an auxiliary solve of a map of degree 1.
SolveOptions roughly(SolveOptions solve_options) {
  solve_options.tolerance = kRoughly;
  solve_options.triangles = Triangles::Kept;
  return solve_options;
}

// Returns the map optimized without pins, by an energy that determines its scale.
BezierMap roughly_optimized(const BezierMap& start, const MapOptions& options,
                            const SolveOptions& solve_options, const PinSolver& solver) {
  MapOptions free = options;
  free.degree = 1;
  free.energy = {{symmetric_dirichlet(), 1.0}};
  free.pins.clear();
  free.handles.clear();
  SolveOptions projected = roughly(solve_options);
  projected.curvature = Curvature::Projected;
  return solver(start, free, projected).value_or(start);
}

// Returns the map moved by z -> a z + b so that its pins are closest to their targets; a = 1 for
// one pin.
BezierMap moved_to_pins(const BezierMap& map, const std::vector<Pin>& pins) {
  using Complex = std::complex<double>;
  const auto number = [](const Vector2& p) { return Complex(p.x(), p.y()); };
  const double count = static_cast<double>(pins.size());
  Vector2 from = Vector2::Zero(), to = Vector2::Zero();
  for (const Pin& p : pins) {
    from += place_of(map, p.vertex) / count;
    to += *p.target / count;
  }
  Complex turned = 0;
  double spread = 0;
  for (const Pin& p : pins) {
    const Vector2 d = place_of(map, p.vertex) - from;
    turned += std::conj(number(d)) * number(*p.target - to);
    spread += d.squaredNorm();
  }
  const Complex a = pins.size() > 1 && std::abs(turned) > 0 ? turned / spread : 1;
  Vec x = map.control_points();
  for (Index k = 0; k < x.size(); k += 2) {
    const Complex z = a * number(x.segment<2>(k) - from);
    x.segment<2>(k) = to + Vector2(z.real(), z.imag());
  }
  return map.with(map.shared_space(), std::move(x));
}

// Shuffles the pins in the same way with every library, unlike std::shuffle.
void shuffle(std::vector<Pin>& pins, std::mt19937& random) {
  for (std::size_t k = pins.size(); k > 1; --k) std::swap(pins[k - 1], pins[random() % k]);
}

std::vector<FixedPoint> fixed_points(const std::vector<Pin>& pins) {
  std::vector<FixedPoint> points;
  for (const Pin& p : pins) points.push_back({p.vertex, *p.target});
  return points;
}

}  // namespace

void require_no_contradiction(const BezierMap& start, const MapOptions& options) {
  require_pinned_once(start.mesh(), options.pins);
  std::vector<const Pin*> pin_of(to_size(start.mesh().vertex_count()), nullptr);
  const double size = start.control_points().maxCoeff() - start.control_points().minCoeff();
  for (const Pin& p : options.pins) {
    const double distance = (*p.target - place_of(start, p.vertex)).stableNorm();
    if (!(distance <= kFarthest * size))
      throw Error(
          ErrorKind::Unsupported,
          fmt::format("{}the target of vertex {} is {:.3g} sizes of the map away from it, "
                      "too far to compute with; give a nearer one",
                      message_prefix(start.mesh()), name_of(start, p.vertex), distance / size));
    pin_of[p.vertex] = &p;
    if (!start.seams().empty()) continue;  // layouts with seams may cover a place several times
    for (const Pin& q : options.pins)
      if (q.vertex < p.vertex && *q.target == *p.target &&
          name_of(start, q.vertex) == name_of(start, p.vertex))
        refuse_pins(start, fmt::format("vertex {} is on a cut and has several places; pin another",
                                       name_of(start, p.vertex)));
      else if (q.vertex < p.vertex && *q.target == *p.target)
        refuse_pins(start, fmt::format("vertex {} and vertex {} have the same; pin one of them",
                                       name_of(start, q.vertex), name_of(start, p.vertex)));
  }
  const Cells& faces = start.mesh().faces();
  for (Index f = 0; f < faces.rows(); ++f) {
    const Pin *a = pin_of[faces(f, 0)], *b = pin_of[faces(f, 1)], *c = pin_of[faces(f, 2)];
    if (a && b && c && orientation(*a->target, *b->target, *c->target) <= 0)
      refuse_pins(start, fmt::format("those of vertex {}, vertex {} and vertex {} turn face {} "
                                     "over; leave one out",
                                     name_of(start, a->vertex), name_of(start, b->vertex),
                                     name_of(start, c->vertex), user_face(start.mesh(), f)));
  }
  if (options.boundary != BoundaryCondition::Fixed) return;
  for (const auto& loop : start.mesh().boundary_loops())
    for (const Index v : loop)
      if (pin_of[v] && !meets_pins(start, {*pin_of[v]}))
        throw Refusal(ErrorKind::Infeasible, start.mesh().file(),
                      fmt::format("{}vertex {} is on the fixed boundary; leave out ", no_way(start),
                                  name_of(start, v)),
                      Hint::FreeBoundary, ", or the pin");
}

bool PinHomotopy::may_continue() const {
  return record_.iterations_left() > 0 && record_.directive() == Directive::Continue;
}

std::vector<Pin> PinHomotopy::on_the_way(double part) const {
  std::vector<Pin> to;
  for (const auto* points : {&options_.handles, &options_.pins})
    for (const Pin& p : *points) {
      const Vector2 from = place_of(start_, p.vertex);
      to.push_back({p.vertex, Vector2(from + part * (*p.target - from))});
    }
  return to;
}

void PinHomotopy::pull(std::vector<Pin> to, double weight) {
  MapOptions pulled = options_;
  pulled.degree = 1;
  pulled.handle_weight = weight;
  pulled.handles = std::move(to);
  pulled.pins.clear();
  map_ = solver_(map_, pulled, roughly(solve_options_)).value_or(map_);
}

void PinHomotopy::walk(int steps, double weight) {
  for (int k = 1; k <= steps && may_continue(); ++k)
    pull(on_the_way(static_cast<double>(k) / steps), weight);
}

bool PinHomotopy::walk_in_turn(const std::vector<Pin>& order, int steps, double weight) {
  std::vector<Pin> to;
  for (const Pin& p : order) {
    const Vector2 from = place_of(map_, p.vertex), way = *p.target - from;
    to.push_back(p);
    for (int k = 1; k <= steps && may_continue(); ++k) {
      to.back().target = from + static_cast<double>(k) / steps * way;
      pull(to, weight);
    }
    to.back() = p;
    if ((place_of(map_, p.vertex) - *p.target).norm() > kArrived * way.norm()) return false;
  }
  return true;
}

bool PinHomotopy::hold() {
  if (set_pins() || (may_continue() && untangle_with_pins())) return true;
  for (double w = kFirstStiffness; w <= kStiffest && may_continue(); w *= kStiffer) {
    pull(on_the_way(1), w);
    if (set_pins() || (may_continue() && untangle_with_pins())) return true;
  }
  return false;
}

// Returns the closest map that meets pins and seams. None if seams contradict the pins.
std::optional<BezierMap> PinHomotopy::with_pins() const {
  Vec x = map_.control_points();
  if (map_.seams().empty()) {
    for (const Pin& p : options_.pins) x.segment<2>(2 * p.vertex) = *p.target;
  } else {
    ConstraintRows rows;
    FixedPoints(fixed_points(options_.pins)).append_rows(rows);
    SeamlessConstraint(map_.shared_space(), map_.shared_seams()).append_rows(rows);
    try {
      const Elimination elimination(static_cast<Index>(x.size()), rows);
      elimination.expand(elimination.project(map_.control_points()), x);
    } catch (const Error&) {
      return std::nullopt;
    }
  }
  return map_.with(map_.shared_space(), std::move(x));
}

bool PinHomotopy::is_valid(const BezierMap& map) const {
  if (!LocalInjectivity(map.shared_space(), Vec::Ones(map.mesh().face_count()))
           .check(map.control_points())
           .feasible ||
      !AngleSums(map.shared_space(), AngleSums::Vertices::Interior, map.shared_seams())
           .check(map.control_points())
           .feasible)
    return false;
  return options_.injectivity == MapInjectivity::Local ||
         check_boundary(map).result == ProofStatus::Proven;
}

bool PinHomotopy::set_pins() {
  std::optional<BezierMap> held = with_pins();
  if (!held || !is_valid(*held)) return false;
  map_ = *std::move(held);
  return true;
}

bool PinHomotopy::untangle_with_pins() {
  const std::optional<BezierMap> held = with_pins();
  if (!held) return false;
  MapSpecification spec;
  spec.rest = std::make_shared<const RestShapes>(rest_shapes(map_.mesh()));
  spec.seams = map_.shared_seams();
  spec.boundary = options_.boundary;
  spec.pins = fixed_points(options_.pins);
  UntangleResult untangled = untangle(spec, map_.shared_space(), held->control_points(), record_);
  BezierMap map = map_.with(map_.shared_space(), std::move(untangled.x));
  if (!untangled.inverted.empty() || !is_valid(map)) return false;
  map_ = std::move(map);
  return true;
}

void PinHomotopy::refuse() const {
  if (!may_continue())
    throw Refusal(ErrorKind::Infeasible, start_.mesh().file(),
                  message_prefix(start_.mesh()) +
                      "stopped by a limit or Ctrl-C before the pins' targets were reached; raise ",
                  Hint::RaiseLimits);
  Index farthest = -1;
  double distance = -1;
  for (const Pin& p : options_.pins)
    if (const double d = (place_of(map_, p.vertex) - *p.target).norm(); d > distance) {
      distance = d;
      farthest = p.vertex;
    }
  refuse_pins(start_, fmt::format("vertex {} stays {:.3g} away; use soft handles, or targets "
                                  "nearer to the start",
                                  name_of(start_, farthest), distance));
}

BezierMap pin_homotopy(const BezierMap& given, const MapOptions& options,
                       const SolveOptions& solve_options, const PinSolver& solver,
                       RunRecord& record) {
  require_no_contradiction(given, options);
  BezierMap start = given;
  if (may_move(options)) {
    if (options.pins.size() > 1) start = roughly_optimized(start, options, solve_options, solver);
    start = moved_to_pins(start, options.pins);
  }
  PinHomotopy way(start, options, solve_options, solver, record);
  if (way.set_pins()) return way.map();
  way.walk(kSteps, kFirstStiffness);
  if (way.hold()) return way.map();
  if (!way.may_continue()) way.refuse();
  PinHomotopy at_once(start, options, solve_options, solver, record);
  if (at_once.untangle_with_pins()) return at_once.map();
  std::vector<Pin> order = options.pins;
  std::mt19937 random;
  for (int k = 0; k < kMostOrders && order.size() > 1; ++k) {
    PinHomotopy in_turn(given, options, solve_options, solver, record);
    if (in_turn.walk_in_turn(order, kStepsInTurn, kFirstStiffness) && in_turn.hold())
      return in_turn.map();
    if (!in_turn.may_continue()) in_turn.refuse();
    shuffle(order, random);
  }
  PinHomotopy slowly(start, options, solve_options, solver, record);
  slowly.walk(kSmallSteps, kFirstStiffness);
  if (!slowly.hold()) slowly.refuse();
  return slowly.map();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
