#include "majorant/parametrization/solve/internal/several_paths.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/maps/energy_text.h"

namespace majorant {
namespace {

// An energy whose minimum lies on the way: a sum by name, and the part of the requested energy that
// is added to it.
struct Detour {
  std::string_view energy;
  double requested_part;
};

// The detours whose ends were the lowest on disks of 500 to 10,000 faces; docs/method.md has the
// figures. The first one is the direct path.
constexpr Detour kDetours[] = {
    {"", 1}, {"asap", 1}, {"arap", 0.1}, {"log-isometric", 0}, {"authalic + 0.1*mips", 0}};

EnergySum energy_of(const Detour& detour, const EnergySum& requested) {
  EnergySum sum = find_energy_sum(detour.energy).value();
  if (detour.requested_part > 0)
    for (const WeightedEnergy& part : requested)
      sum.push_back({part.make, detour.requested_part * part.weight});
  return sum;
}

bool has_map(const ParametrizationResult& result) {
  return result.map && result.status != Status::Failed && result.status != Status::Infeasible;
}

// Returns the end of a path.
ParametrizationResult end_of(const Detour& detour, const SolveFromStart& solve,
                             const ParametrizationOptions& options, const RunRecord& record) {
  RunRecord part = record.part();
  if (detour.energy.empty()) return solve(options, part);
  ParametrizationOptions first = options;
  first.map.energy = energy_of(detour, options.map.energy);
  first.solve.curvature = {};
  ParametrizationResult middle = solve(first, part);
  if (!has_map(middle)) return middle;
  RunRecord rest = record.part();
  ParametrizationResult end = parametrize(*middle.map, options, rest);
  end.start = middle.start;
  end.initialize_seconds = middle.initialize_seconds;
  return end;
}

}  // namespace

ParametrizationResult parametrize_on_paths(const std::vector<SolveFromStart>& solves,
                                           const ParametrizationOptions& options,
                                           RunRecord& record) {
  ParametrizationOptions plain = options;
  plain.solve.effort = Effort::Normal;
  ParametrizationOptions straight = plain;
  straight.map.degree = 1;
  straight.solve.watch = {};
  straight.solve.triangles = Triangles::Kept;
  record.begin(Activity::Starting);
  const double started = record.seconds();
  std::optional<ParametrizationResult> lowest;
  const std::size_t count = solves.size() * std::size(kDetours);
  std::size_t number = 0;
  std::optional<double> initial_value;  // of the first start
  for (const SolveFromStart& solve : solves)
    for (const Detour& detour : kDetours) {
      record.announce(fmt::format("path {} of {}", ++number, count));
      if (lowest && record.stop()() != Directive::Continue) continue;
      try {
        ParametrizationResult end = end_of(detour, solve, straight, record);
        if (!initial_value) initial_value = end.initial_value;
        if (!lowest || (has_map(end) && end.value_quadrature < lowest->value_quadrature))
          lowest = std::move(end);
      } catch (const Stopped&) {
        if (!lowest) throw;
      } catch (const InvalidArgument&) {
        throw;
      } catch (const Error&) {  // this path has no start, or ends at once
        if (!lowest) throw;
      }
      record.advance(static_cast<double>(number) / static_cast<double>(count));
      if (lowest && !has_map(*lowest)) return *std::move(lowest);
    }
  ParametrizationResult result = parametrize(*lowest->map, plain, record);
  result.start = lowest->start;
  result.initial_value = *initial_value;
  result.initialize_seconds =
      record.seconds() - started - result.optimize_seconds - result.measure_seconds;
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
