// Energies that can be put on any space and rules: what drivers take as "the energy".
//
//   const EnergySum sum{{mips(), 1.0}, {symmetric_dirichlet(), 0.1}};
//   const bool has_a_scale = free_scale_of(sum) == FreeScale::Determined;   // true
//
// Not for a term on one space: make_energy() (make_energy.h) makes that at once.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/detail/contraction.h"
#include "majorant/energies/detail/dilatation_modes.h"
#include "majorant/energies/traits.h"
#include "majorant/framework/energy_term.h"

namespace majorant {

// The energy term of a density: element tables and rest shapes around a contraction kernel.
//
// Made by make_energy(); nothing here depends on the density's type.

// The facts of a density that a term needs.
struct DensityTraits {
  std::string name;
  std::vector<Curvature> curvatures;  // supported
  Barrier barrier = Barrier::Weak;
  FreeScale free_scale = FreeScale::Determined;
  // The density for these TermState::parameters, which it may refer to, those that it was made
  // with, and their number; empty for a density without parameters.
  std::function<std::shared_ptr<const void>(const Vec& parameters)> with_parameters = {};
  std::function<Vec()> parameters = {};
  Index parameter_count = 0;
  // The number of elements that the density has data or turned frames for; none: it is the same on
  // every mesh.
  std::optional<Index> elements = {};
  // The degree of the polynomials that dilatation is projected on inside an element (solid.h);
  // none: det J is what it is at every point.
  std::optional<int> dilatation_degree = {};
};

class DensityTerm final : public EnergyTerm {
 public:
  // `density` is what `kernels` expect; `rules` are numbered by RuleId. Throws
  // InvalidArgument when there is no rule, the rest shapes do not fit the space, the density
  // has data for another number of elements, or its Jacobian has not the element's dimension.
  DensityTerm(DensityTraits traits, std::shared_ptr<const ElementSpace> space,
              std::shared_ptr<const RestShapes> rest, const std::vector<Quadrature>& rules,
              std::shared_ptr<const void> density, const DensityKernels& kernels);

  std::string_view name() const override { return traits_.name; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature curvature) const override;
  RuleId rule_count() const override { return static_cast<RuleId>(rules_.size()); }
  Index parameter_count() const override { return traits_.parameter_count; }
  Vec parameters() const override { return traits_.parameters ? traits_.parameters() : Vec(); }
  Index parameters_per_element() const override {
    return traits_.elements && *traits_.elements > 0 ? traits_.parameter_count / *traits_.elements
                                                     : 0;
  }
  const DensityTraits& traits() const { return traits_; }
  const RestShapes& rest() const { return *rest_; }  // that maps are measured against
  // f = measure * mean density of each element.
  void values(VecIn x, const ElementBatch& batch, const TermState& state, Workspace& workspace,
              std::span<double> f) const override;
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override;

  // The pressure of a solid with a projected dilatation (solid.h), dU/dtheta, positive where the
  // solid is pulled apart: a polynomial on each element, here by its values at points of the
  // reference cell, which are rows as in Quadrature::points. #E by #points, at TermState{} and the
  // first rule. Throws InvalidArgument for other densities.
  RowMatrix pressures(VecIn x, const RowMatrix& points) const;

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
    // Curved: #E by L times D^2 + 1 and mode_count, inverse, measure and modes point by point.
    RowMatrix rest;
    DilatationModes modes;  // not curved
    int mode_count = 0;
    ContractionView view() const;
  };
  const Rule& rule(RuleId id) const;
  std::shared_ptr<const void> density(const TermState& state) const;
  void tabulate_curved(Rule& rule) const;
  int rest_rows(const ContractionView& table) const;  // a point
  struct Gathered {
    BatchView batch;
    double* scratch;
    double* values;  // kMaxSize, aligned
  };
  Gathered gather(VecIn x, const ElementBatch& batch, const Rule& rule,
                  const ContractionView& table, Workspace& w) const;

  DensityTraits traits_;
  ElementDofs element_dofs_;
  std::shared_ptr<const RestShapes> rest_;
  std::shared_ptr<const ElementSpace> space_;
  std::vector<std::unique_ptr<Rule>> rules_;
  std::shared_ptr<const void> density_;
  DensityKernels kernels_;
};

// Made by energy_factory() of make_energy.h, or one of named_energies(). An energy may be that
// of one mesh only, because its formula is told of the elements or their frames are turned: its
// traits say of how many elements.
class EnergyFactory {
 public:
  using Make = std::function<std::shared_ptr<const DensityTerm>(
      std::shared_ptr<const ElementSpace> space, std::shared_ptr<const RestShapes> rest,
      const std::vector<Quadrature>& rules)>;
  using Part = std::function<EnergyFactory(std::span<const Index> elements)>;
  // make: gives terms of these traits. part: for_elements() where traits.elements is set.
  // Throws InvalidArgument where `make` is empty.
  EnergyFactory(DensityTraits traits, Make make, Part part = {});
  // density: what `kernels` are called with; all terms share it.
  static EnergyFactory of_density(DensityTraits traits, std::shared_ptr<const void> density,
                                  const DensityKernels& kernels, Part part = {});

  const DensityTraits& traits() const { return traits_; }
  // Value of the term = sum over elements of measure * mean density. Throws InvalidArgument
  // as DensityTerm does.
  std::shared_ptr<const DensityTerm> operator()(std::shared_ptr<const ElementSpace> space,
                                                std::shared_ptr<const RestShapes> rest,
                                                const std::vector<Quadrature>& rules) const {
    return make_(std::move(space), std::move(rest), rules);
  }
  // Makes it on shapes of its own, a copy.
  std::shared_ptr<const DensityTerm> operator()(std::shared_ptr<const ElementSpace> space,
                                                const RestShapes& rest,
                                                const std::vector<Quadrature>& rules) const {
    return make_(std::move(space), std::make_shared<const RestShapes>(rest), rules);
  }
  // Makes the term on the default rule of the space (ElementSpace::default_rule). Where J is not
  // constant and the energy has a barrier, guarded_rule() adds the corners, with kCornerGuard.
  std::shared_ptr<const DensityTerm> operator()(std::shared_ptr<const ElementSpace> space,
                                                const RestShapes& rest) const;
  // Returns the same energy on a mesh made of these elements, in this order. Throws InvalidArgument
  // for an element it does not know, InvalidArgument if it has no part().
  EnergyFactory for_elements(std::span<const Index> elements) const;

 private:
  DensityTraits traits_;
  Make make_;
  Part part_;
};

namespace detail {
// supported: of each of kCurvatures. No with_parameters, no elements.
DensityTraits traits_of(std::string_view name, const Traits& traits,
                        std::span<const bool> supported);
}  // namespace detail

// The energy in frames that are turned so that their first axes are those given: #E by D, of any
// length, in the frames of the rest shapes (turned() and in_frames() of elements/rest_shapes.h).
//
//   const RowMatrix fibres = in_frames(*mesh, directions);         // #F by 3, in space
//   options.map.energy = {{symmetric_dirichlet()}, {along(fibres, energy_factory(shear)), 0.1}};
//
// Throws InvalidArgument where `make` is for another number of elements; the terms it makes
// do for directions without a length, and for curved rest shapes.
EnergyFactory along(RowMatrix first_axes, EnergyFactory make);

// sum of weight * energy.
struct WeightedEnergy {
  EnergyFactory make;
  double weight = 1.0;
  Vec face_weight = {};  // #E positive factors on single elements, empty = all 1
};
using EnergySum = std::vector<WeightedEnergy>;

// True where a summand is made for the elements of one mesh: has face weights, data or fibres.
bool knows_elements(const EnergySum& energy);
// The sum on a mesh made of these elements: EnergyFactory::for_elements().
EnergySum for_elements(const EnergySum& energy, std::span<const Index> elements);
// Throws InvalidArgument unless the summands are for `count` elements, or for any.
void require_elements(const EnergySum& energy, Index count);

// The strongest of the summands; None of an empty sum.
Barrier barrier_of(const EnergySum& energy);
// Determined if one summand is, else Collapses if one does, else Arbitrary: one scale is enough,
// and nothing but a scale withstands a summand that shrinks the map.
FreeScale free_scale_of(const EnergySum& energy);

// The energies users call by name.
//
//   const NamedEnergy* e = find_energy("arap");
//   options.map.energy = {{e->make, 1.0}, {mips(), 0.1}};
//
// Kernels are compiled for several instruction sets and chosen at run time.

struct NamedEnergy {
  std::string name;
  std::string summary;  // one line: formula; where it is smallest, and how small
  EnergyFactory make;   // its traits() say what else is known
};

std::span<const NamedEnergy> named_energies();
const NamedEnergy* find_energy(std::string_view name);  // null when there is none

// The two that the library itself asks for.
EnergyFactory symmetric_dirichlet();
EnergyFactory mips();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
