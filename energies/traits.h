// Traits: the facts of a formula that a density declares because no code can find them out.
//
//   Traits steep{.barrier = Barrier::Strong};
//   steep.free_scale = FreeScale::Arbitrary;   // for spectral("mine", h, steep)
//
// Drivers decide by these facts and never by a name. No includes: kernels see this file.
//
// Not for what a term is asked: names and supported curvatures are in its DensityTraits
// (energy_factory.h).
#pragma once

namespace majorant {

enum class Domain { PositiveDeterminant, Everywhere };
// Convex: k(A, B) = h(A+B, A-B) is convex in (A, B), that is h in (Sigma, sigma), and increasing in
// B.
enum class Convexity { Convex, Unknown };
// Separable: h = p(Sigma) + p(sigma) with p'(t) (t - 1) >= 0, what SLIM's weights need.
enum class Reweighting { Separable, Refused };
// The barrier that an energy has at det J = 0, beside the line search. None: the energy stays
// finite at det J = 0. Weak: it becomes infinite, and a run that stops at the limit of injectivity
// all the same is lent the barrier of symmetric Dirichlet, as without a barrier. Strong: infinite,
// and nothing is lent, since it would not help: symmetric Dirichlet itself, and what contains a
// good share of it.
enum class Barrier { None, Weak, Strong };
// The scale of minimizers among maps without a fixed boundary. Determined: the minimum has one.
// Arbitrary: the value does not depend on it. Collapses: the smaller the map, the smaller the
// value, so that something else must hold the scale.
enum class FreeScale { Determined, Arbitrary, Collapses };

// Without Convex the majorizers are refused, without Separable reweighting is.
struct Traits {
  Domain domain = Domain::PositiveDeterminant;
  Convexity convexity = Convexity::Unknown;
  Reweighting reweighting = Reweighting::Refused;
  Barrier barrier = domain == Domain::Everywhere ? Barrier::None : Barrier::Weak;
  FreeScale free_scale = FreeScale::Determined;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
