// The energy term of a density: element tables and rest shapes around a contraction kernel.
//
// Made by make_energy(); nothing here depends on the density's type.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/detail/contraction.h"
#include "majorant/energies/traits.h"
#include "majorant/framework/energy_term.h"

namespace majorant {

// What a term must know of its density.
struct DensityTraits {
  std::string name;
  std::vector<Curvature> curvatures;  // supported
  Barrier barrier = Barrier::Weak;
  FreeScale free_scale = FreeScale::Determined;
  // The density for these TermState::parameters; empty for a density without parameters.
  std::function<std::shared_ptr<const void>(const Vec& parameters)> with_parameters;
  // Of how many elements the density is told something, or has the frame turned; none: it is the
  // same on every mesh.
  std::optional<Index> elements;
};

class DensityTerm final : public EnergyTerm {
 public:
  // `density` is what `kernels` expect; `rules` are numbered by RuleId. Throws
  // InvalidArgument when there is no rule, the rest shapes do not fit the space, the density
  // has data for another number of elements, or its Jacobian has not the element's dimension.
  DensityTerm(DensityTraits traits, std::shared_ptr<const ElementSpace> space,
              const RestShapes& rest, const std::vector<Quadrature>& rules,
              std::shared_ptr<const void> density, const DensityKernels& kernels);

  std::string_view name() const override { return traits_.name; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature curvature) const override;
  RuleId rule_count() const override { return static_cast<RuleId>(rules_.size()); }
  const DensityTraits& traits() const { return traits_; }
  // f = measure * mean density of each element.
  void values(VecIn x, const ElementBatch& batch, const TermState& state, Workspace& workspace,
              std::span<double> f) const override;
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override;

  // The density alone, at TermState{}: summed over the triangles around a vertex at v, which need
  // not be those of the space. Throws InvalidArgument unless the density is of planar maps
  // and the same on all elements.
  StarModel star(const StarView& view, const Vector2& v) const;

 private:
  // Tables of one rule, built when first used: fine rules are large and rarely needed.
  struct Rule {
    Quadrature quadrature;
    std::once_flag built;
    ContractionTable table;
    decltype(ContractionTable::shape_gradient) weighted_shape_gradient, weighted_gradient_product;
    RowMatrix rest;  // curved: #E by (D^2 + 1) L, inverse and measure point by point
    ContractionView view() const;
  };
  const Rule& rule(RuleId id) const;
  std::shared_ptr<const void> density(const TermState& state) const;
  void tabulate_curved(Rule& rule) const;
  struct Gathered {
    BatchView batch;
    double* scratch;
    double* values;  // kMaxSize, aligned
  };
  Gathered gather(VecIn x, const ElementBatch& batch, const Rule& rule,
                  const ContractionView& table, Workspace& w) const;

  DensityTraits traits_;
  ElementDofs element_dofs_;
  RestShapes rest_;
  std::shared_ptr<const ElementSpace> space_;
  std::vector<std::unique_ptr<Rule>> rules_;
  std::shared_ptr<const void> density_;
  DensityKernels kernels_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
