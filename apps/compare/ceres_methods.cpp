#include "apps/compare/ceres_methods.h"

#include "apps/compare/ceres_plugin.h"
#include "apps/parts.h"
#include "apps/plugins/plugin.h"
#include "majorant/energies/named_energies.h"

namespace majorant::app {
namespace {

const CeresPlugin& ceres() {
  static const CeresPlugin& plugin = load_plugin<CeresPlugin>(kCeresPlugin);
  plugin.silence();
  return plugin;
}

void load_ceres() { ceres(); }

Method ceres_gradient(std::string name, std::string summary, CeresOptions::Method method) {
  return {std::move(name), std::move(summary), nullptr,
          [method](const Contest& c) {
            CeresOptions options;
            options.method = method;
            options.max_iterations = c.max_iterations;
            options.stop = c.stop;
            return ceres().gradient(options);
          },
          load_ceres};
}

Method least_squares() {
  const auto obstacle = [](const Contest& c) -> std::string {
    const EnergySum& energy = c.specification.energy;
    const std::string squares = symmetric_dirichlet().traits().name;
    if (energy.size() != 1 || energy[0].make.traits().name != squares || energy[0].weight != 1)
      return "it needs --energy " + squares;
    if (c.specification.face_weight.size()) return "it does not know --weights";
    if (!c.specification.handles.empty()) return "it does not know --handles";
    return {};
  };
  return {"ceres-lm", "Ceres, Levenberg-Marquardt on J and J^-1 as residuals", obstacle,
          [](const Contest& c) {
            LeastSquaresOptions options;
            options.max_iterations = c.max_iterations;
            return ceres().least_squares(c.space, c.specification.rest, c.rule, options);
          },
          load_ceres};
}

}  // namespace

std::vector<Method> ceres_methods() {
  if (!has_gpl_parts()) return {};
  return {
      ceres_gradient("ceres-lbfgs", "Ceres, L-BFGS", CeresOptions::Method::Lbfgs),
      ceres_gradient("ceres-nlcg", "Ceres, nonlinear conjugate gradients",
                     CeresOptions::Method::NonlinearConjugateGradient),
      least_squares(),
  };
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
