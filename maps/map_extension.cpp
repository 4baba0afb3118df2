#include "majorant/maps/map_extension.h"

#include <fmt/format.h>

#include <cmath>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

template <class Pointer>
void require(const Pointer& p, const char* what) {
  if (!p) throw InvalidArgument(fmt::format("MapExtension: the {} is null", what));
}

}  // namespace

MapExtension::MapExtension(BezierMap start, std::shared_ptr<const RestShapes> rest, double scale)
    : start_(std::move(start)), rest_(std::move(rest)), scale_(scale) {
  require(rest_, "pointer to rest shapes");
}

MapExtension& MapExtension::add(std::shared_ptr<const EnergyTerm> term, double weight) {
  require(term, "term");
  if (!(weight > 0) || !std::isfinite(weight))
    throw InvalidArgument(
        fmt::format("MapExtension: the weight {:g} of term '{}' is not positive and finite", weight,
                    term->name()));
  const ElementDofs& s = term->element_dofs();
  if (s.nodes.size() && (s.nodes.minCoeff() < 0 ||
                         s.block * (s.nodes.maxCoeff() + 1) > start_.control_points().size()))
    throw InvalidArgument(
        fmt::format("MapExtension: a stencil of term '{}' leaves the {} unknowns of the map",
                    term->name(), start_.control_points().size()));
  terms_.push_back({std::move(term), weight});
  return *this;
}

MapExtension& MapExtension::add(std::shared_ptr<const Constraint> constraint) {
  require(constraint, "constraint");
  constraints_.push_back(std::move(constraint));
  return *this;
}

MapExtension& MapExtension::add(std::shared_ptr<const FeasibilityChecker> checker) {
  require(checker, "checker");
  checkers_.push_back(std::move(checker));
  return *this;
}

MapExtension& MapExtension::observe(MapObserver observer) {
  require(observer, "observer");
  observers_.push_back(std::move(observer));
  return *this;
}

MapExtension MapExtension::with(
    std::vector<std::shared_ptr<const FeasibilityChecker>> checkers) const {
  MapExtension other = *this;
  other.checkers_ = std::move(checkers);
  return other;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
