#include "majorant/parametrization/seams/internal/flattening_strain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace majorant {

FlatteningStrain::FlatteningStrain(FlatteningSystem& system, const std::vector<char>& is_cut,
                                   Index outer, const StopCheck& stop) {
  if (const auto boundary = system.boundary(is_cut, outer)) {
    solve(system, *boundary, stop);
    return;
  }
  const SurfaceMesh open = system.mesh().cut_along(is_cut, nullptr);
  FlatteningSystem own(open, outer);
  const std::vector<char> none(is_cut.size(), 0);
  *this = FlatteningStrain(own, none, outer, stop);
}

FlatteningStrain::FlatteningStrain(const SurfaceMesh& piece, const StopCheck& stop) {
  FlatteningSystem own(piece);
  const std::vector<char> none(to_size(piece.half_edge_count()), 0);
  *this = FlatteningStrain(own, none, -1, stop);
}

void FlatteningStrain::solve(FlatteningSystem& system, const FlatteningSystem::Boundary& boundary,
                             const StopCheck& stop) {
  const SurfaceMesh& mesh = system.mesh();
  unknown_.resize(to_size(mesh.half_edge_count()));
  Vec load = Vec::Zero(system.unknowns());
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index v = mesh.from_vertex(h);
    unknown_[h] = boundary.is_held[v] ? -1 : system.unknown(v);
    if (unknown_[h] >= 0) load[unknown_[h]] = system.load()[unknown_[h]];
  }
  if (std::ranges::all_of(unknown_, [](Index u) { return u < 0; })) return;
  factor_ = system.factorized(boundary, stop);
  if (!factor_) {
    strain_ = std::numeric_limits<double>::infinity();
    return;
  }
  factor_->solver->solve(load, chi_);
  strain_ = std::max(0.0, load.dot(chi_));  // the area is 1
}

double FlatteningStrain::apply(const Functional& functional) const {
  double sum = 0;
  for (const auto& [h, factor] : functional)
    if (unknown_[h] >= 0) sum += factor * chi_[unknown_[h]];
  return sum;
}

FlatteningStrain::Functional FlatteningStrain::load_of(const Functional& functional) const {
  std::map<Index, double> load;
  for (const auto& [h, factor] : functional)
    if (unknown_[h] >= 0) load[unknown_[h]] += factor;
  std::erase_if(load, [](const auto& entry) { return entry.second == 0; });
  return {load.begin(), load.end()};
}

bool FlatteningStrain::is_zero(const Functional& functional) const {
  return load_of(functional).empty();
}

Eigen::MatrixXd FlatteningStrain::responses(const std::vector<Functional>& functionals,
                                            const StopCheck& stop) const {
  std::vector<DirectSolver::SparseColumn> loads;
  for (const Functional& functional : functionals) loads.push_back(load_of(functional));
  return factor_->solver->inverse_products(factor_->pattern.size, loads, stop);
}

double stretch_of_strain(double strain) { return std::sqrt(1 + 1.5 * strain); }
double strain_of_stretch(double stretch) { return (stretch * stretch - 1) / 1.5; }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
