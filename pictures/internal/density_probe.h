// The density of an energy at single Jacobians, of any energy: for scales, and pixels of pictures.
// Likewise the other quantities that pictures show.
//
//   const DensityProbe probe({{symmetric_dirichlet(), 1.0}});
//   probe.at(1, 1);                                            // 4
//
// It uses the kernels that solve, for 128 Jacobians at a time. Not for what can use a DensityTerm
// itself.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "majorant/energies/energy_factory.h"
#include "majorant/pictures/color_scale.h"

namespace majorant {

class DensityProbe {
 public:
  // Isotropic densities of planar maps: functions of singular values alone.
  explicit DensityProbe(const EnergySum& energy);

  double at(double sigma_max, double sigma_min) const;
  // sigma: largest and smallest (signed) of as many Jacobians as there are values to be written;
  // +inf outside the energy's domain. May be called by several threads at a time.
  void evaluate(std::span<const Vector2> sigma, std::span<double> values) const;

 private:
  struct Summand {
    std::shared_ptr<const DensityTerm> term;
    double weight;
  };
  std::vector<Summand> summands_;
};

// Evaluates any quantity; probe: of the density.
void evaluate(Quantity quantity, const DensityProbe& probe, std::span<const Vector2> sigma,
              std::span<double> values);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
