// Evaluates the density of any energy at single Jacobians, and the other quantities of pictures,
// for scales and pixels.
//
//   const DensityProbe probe({{symmetric_dirichlet(), 1.0}});
//   probe.at(1, 1);                                            // 4
//
// It uses the solver's kernels, for 128 Jacobians at a time. Not for code that can use a
// DensityTerm itself.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "majorant/energies/energy_factory.h"
#include "majorant/pictures/color_scale.h"

namespace majorant {

class DensityProbe {
 public:
  // Requires isotropic densities of planar maps, which are functions of singular values.
  explicit DensityProbe(const EnergySum& energy);

  double at(double sigma_max, double sigma_min) const;
  // sigma: largest and smallest (signed) singular values, one pair for each result; +inf outside
  // the energy's domain. May be called by several threads at a time.
  void evaluate(std::span<const Vector2> sigma, std::span<double> values) const;

 private:
  struct Summand {
    std::shared_ptr<const DensityTerm> term;
    double weight;
  };
  std::vector<Summand> summands_;
};

// Evaluates any quantity; probe: for the density.
void evaluate(Quantity quantity, const DensityProbe& probe, std::span<const Vector2> sigma,
              std::span<double> values);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
