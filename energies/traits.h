// Traits: properties of a formula that a density declares, since code cannot derive them.
//
//   Traits steep{.barrier = Barrier::Strong};
//   steep.free_scale = FreeScale::Arbitrary;   // for spectral("mine", h, steep)
//
// Drivers decide by these properties and never by a name. This header includes nothing, since
// kernels include it.
//
// Names and supported curvatures of a term are in its DensityTraits (energy_factory.h).
#pragma once

namespace majorant {

enum class Domain { PositiveDeterminant, Everywhere };
// Convex: k(A, B) = h(A+B, A-B) is convex in (A, B), which is equivalent to h being convex in
// (Sigma, sigma), and increasing in B.
enum class Convexity { Convex, Unknown };
// Separable: h = p(Sigma) + p(sigma) with p'(t) (t - 1) >= 0, as SLIM's weights require.
enum class Reweighting { Separable, Refused };
// The barrier of an energy at det J = 0, beside the line search.
// * None: the energy stays finite at det J = 0.
// * Weak: it becomes infinite. A run that still stops at the limit of injectivity gets the barrier
//  of symmetric Dirichlet in addition, as it does without a barrier.
// * Strong: it becomes infinite and gets no other barrier, which would not help: symmetric
//  Dirichlet itself, and sums with a large share of it.
enum class Barrier { None, Weak, Strong };
// The scale of minimizers among maps without a fixed boundary. Determined: the minimum has one.
// Arbitrary: the value does not depend on it. Collapses: the value decreases with the scale, so
// that something else must hold it.
enum class FreeScale { Determined, Arbitrary, Collapses };

// The declared properties. Majorizers require Convex, and reweighting requires Separable.
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
