// Energies that can be put on any space and rules; drivers take them as "the energy".
//
//   const EnergySum sum{{mips(), 1.0}, {symmetric_dirichlet(), 0.1}};
//   const bool has_a_scale = free_scale_of(sum) == FreeScale::Determined;   // true
//
// For a term on one space, make_energy() (make_energy.h) is shorter.
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

// The properties of a density that a term needs.
struct DensityTraits {
  std::string name;
  std::vector<Curvature> curvatures;  // supported
  Barrier barrier = Barrier::Weak;
  FreeScale free_scale = FreeScale::Determined;
  // Returns the density for these TermState::parameters, to which it may refer; empty for a density
  // without parameters. `parameters` returns the initial ones.
  std::function<std::shared_ptr<const void>(const Vec& parameters)> with_parameters = {};
  std::function<Vec()> parameters = {};
  Index parameter_count = 0;
  // The number of elements for which the density has data or rotated frames; none: it is the same
  // on every mesh.
  std::optional<Index> elements = {};
  // The degree of the polynomials on which the dilatation is projected inside an element (solid.h);
  // none: det J is not projected.
  std::optional<int> dilatation_degree = {};
};

// The energy term of a density: element tables and rest shapes around a contraction kernel.
// make_energy() makes it; nothing here depends on the density's type.
class DensityTerm final : public EnergyTerm {
 public:
  // density: the type that `kernels` expect. rules: numbered by RuleId. Throws InvalidArgument if
  // there is no rule, the rest shapes do not fit the space, the density has data for another number
  // of elements, or the dimension of its Jacobian is not that of the element.
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
  const RestShapes& rest() const { return *rest_; }  // against which maps are measured
  // Computes f = measure * mean density of each element.
  void values(VecIn x, const ElementBatch& batch, const TermState& state, Workspace& workspace,
              std::span<double> f) const override;
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override;

  // Returns the pressure of a solid with a projected dilatation (solid.h), dU/dtheta, positive in
  // tension. The pressure is a polynomial on each element, given by its values at points of the
  // reference cell, which are rows as in Quadrature::points. The result is #E by #points, at
  // TermState{} and the first rule. Throws InvalidArgument for other densities.
  RowMatrix pressures(VecIn x, const RowMatrix& points) const;

  // Returns the density alone, at TermState{}, summed over the triangles around a vertex at v,
  // which need not be those of the space. Throws InvalidArgument unless the density is of planar
  // maps and the same on all elements.
  StarModel star(const StarView& view, const Vector2& v) const;

 private:
  // Tables of one rule, built when first used, since fine rules are large and rarely needed.
  struct Rule {
    Quadrature quadrature;
    std::once_flag built;
    ContractionTable table;
    decltype(ContractionTable::shape_gradient) weighted_shape_gradient, weighted_gradient_product;
    // For curved shapes, #E by L times D^2 + 1 and mode_count: inverse, measure and modes point by
    // point.
    RowMatrix rest;
    DilatationModes modes;  // for shapes that are not curved
    int mode_count = 0;
    ContractionView view() const;
  };
  const Rule& rule(RuleId id) const;
  std::shared_ptr<const void> density(const TermState& state) const;
  void tabulate_curved(Rule& rule) const;
  int rest_rows(const ContractionView& table) const;  // per point
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

// An energy for any space, from energy_factory() of make_energy.h or named_energies(). An energy
// belongs to one mesh if its formula has data of elements or rotated frames; traits().elements then
// gives their number.
class EnergyFactory {
 public:
  using Make = std::function<std::shared_ptr<const DensityTerm>(
      std::shared_ptr<const ElementSpace> space, std::shared_ptr<const RestShapes> rest,
      const std::vector<Quadrature>& rules)>;
  using Part = std::function<EnergyFactory(std::span<const Index> elements)>;
  // make: returns terms with these traits. part: implements for_elements() if traits.elements is
  // set. Throws InvalidArgument if `make` is empty.
  EnergyFactory(DensityTraits traits, Make make, Part part = {});
  // Returns an energy whose terms share `density`, the object that `kernels` are called with.
  static EnergyFactory of_density(DensityTraits traits, std::shared_ptr<const void> density,
                                  const DensityKernels& kernels, Part part = {});

  const DensityTraits& traits() const { return traits_; }
  // Returns a term with the value sum over elements of measure * mean density. Throws
  // InvalidArgument as DensityTerm does.
  std::shared_ptr<const DensityTerm> operator()(std::shared_ptr<const ElementSpace> space,
                                                std::shared_ptr<const RestShapes> rest,
                                                const std::vector<Quadrature>& rules) const {
    return make_(std::move(space), std::move(rest), rules);
  }
  // Returns a term on a copy of these shapes.
  std::shared_ptr<const DensityTerm> operator()(std::shared_ptr<const ElementSpace> space,
                                                const RestShapes& rest,
                                                const std::vector<Quadrature>& rules) const {
    return make_(std::move(space), std::make_shared<const RestShapes>(rest), rules);
  }
  // Returns a term on the default rule of the space (ElementSpace::default_rule). If J is not
  // constant and the energy has a barrier, guarded_rule() adds the corners, with kCornerGuard.
  std::shared_ptr<const DensityTerm> operator()(std::shared_ptr<const ElementSpace> space,
                                                const RestShapes& rest) const;
  // Returns the same energy on a mesh of these elements, in this order. Throws InvalidArgument for
  // an element out of range, or if the energy has no part().
  EnergyFactory for_elements(std::span<const Index> elements) const;

 private:
  DensityTraits traits_;
  Make make_;
  Part part_;
};

namespace detail {
// Returns traits without with_parameters and elements. supported: for each of kCurvatures.
DensityTraits traits_of(std::string_view name, const Traits& traits,
                        std::span<const bool> supported);
}  // namespace detail

// Returns the energy in frames whose first axes are those given: #E by D, of any length, in the
// frames of the rest shapes (turned() and in_frames() of elements/rest_shapes.h).
//
//   const RowMatrix fibres = in_frames(*mesh, directions);         // #F by 3, in space
//   options.map.energy = {{symmetric_dirichlet()}, {along(fibres, energy_factory(shear)), 0.1}};
//
// Throws InvalidArgument if `make` is for another number of elements. Terms throw it for directions
// without a length and for curved rest shapes.
EnergyFactory along(RowMatrix first_axes, EnergyFactory make);

// A summand weight * energy of a sum.
struct WeightedEnergy {
  EnergyFactory make;
  double weight = 1.0;
  Vec face_weight = {};  // #E positive factors of single elements, empty = all 1
};
using EnergySum = std::vector<WeightedEnergy>;

// Returns whether a summand belongs to the elements of one mesh: it has face weights, data or
// fibres.
bool knows_elements(const EnergySum& energy);
// Returns the sum on a mesh of these elements: EnergyFactory::for_elements().
EnergySum for_elements(const EnergySum& energy, std::span<const Index> elements);
// Throws InvalidArgument unless the summands fit `count` elements.
void require_elements(const EnergySum& energy, Index count);

// Returns the strongest barrier of the summands; None for an empty sum.
Barrier barrier_of(const EnergySum& energy);
// Returns Determined if one summand is, else Collapses if one does, else Arbitrary. One scale
// suffices, and only a scale prevents a summand from shrinking the map.
FreeScale free_scale_of(const EnergySum& energy);

// The energies that users call by name.
//
//   const NamedEnergy* e = find_energy("arap");
//   options.map.energy = {{e->make, 1.0}, {mips(), 0.1}};
//
// Kernels are compiled for several instruction sets and chosen at run time.

struct NamedEnergy {
  std::string name;
  std::string summary;  // one line: formula; where it is smallest, and its value there
  EnergyFactory make;   // its traits() have further properties
};

std::span<const NamedEnergy> named_energies();
const NamedEnergy* find_energy(std::string_view name);  // null when there is none

// The two energies that the library itself uses.
EnergyFactory symmetric_dirichlet();
EnergyFactory mips();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
