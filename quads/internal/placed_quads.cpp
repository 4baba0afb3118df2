#include "majorant/quads/internal/placed_quads.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/quads/internal/extraction.h"
#include "majorant/quads/internal/infeasibility.h"
#include "majorant/quads/internal/integer_grid_map.h"
#include "majorant/quads/internal/quantization.h"
#include "majorant/quads/internal/smoothing.h"
#include "majorant/quads/internal/timed.h"

namespace majorant {

PlacedQuads QuadPlacer::smoothed(const SeamlessLattice& lattice, const TMesh& t_mesh,
                                 const std::vector<Index>& edges) const {
  const StopCheck& stop = record_.start_stop();
  ExtractedQuads extracted =
      timed(seconds_.place, [&] { return ExtractedQuads(lattice, t_mesh, edges); });
  PolygonMesh quads = timed(seconds_.place, [&] { return extracted.polygons(); });
  QuadCheck check = timed(seconds_.check, [&] { return check_quads(quads, nullptr, {}, stop); });
  HeldVertices held = timed(seconds_.place, [&] { return extracted.held_vertices(); });
  if (check.is_surface) {
    record_.announce(fmt::format("smoothing {} quads", check.count));
    timed(seconds_.smooth, [&] { smooth_quads(quads, lattice.surface(), held, stop); });
    record_.begin(Activity::Proving);
    check = timed(seconds_.check, [&] {
      return check_quads(quads, &mesh_, features_, record_.telling(stop), lattice.border_turn());
    });
  }
  return {std::move(quads), extracted.patches(), std::move(held.feature_edges), std::move(check),
          static_cast<Index>(t_mesh.patches.size())};
}

PlacedQuads QuadPlacer::place(const std::vector<Index>& edges, int degree) const {
  std::optional<PlacedQuads> best;
  std::optional<std::string> first_failure;
  const auto consider = [&](const auto& make) {
    std::optional<PlacedQuads> made;
    std::optional<std::string> failure = infeasibility([&] { made = make(); });
    if (made && !made->check.is_valid()) failure = made->check.defects.front();
    if (failure) {
      if (!first_failure) first_failure = std::move(failure);
    } else if ((!best || made->check.angle_deviation < best->check.angle_deviation)) {
      best = std::move(made);
    }
  };
  if (options_.placing != QuadPlacing::IntegerGrid)
    consider([&] { return smoothed(traced_.lattice, traced_.t_mesh, edges); });
  if (options_.placing != QuadPlacing::Rectangles)
    consider([&] { return on_integer_grid(edges, best ? degree : options_.last_degree); });
  if (!best) throw Error(ErrorKind::Infeasible, first_failure.value_or(""));
  return *std::move(best);
}

PlacedQuads QuadPlacer::on_integer_grid(const std::vector<Index>& edges, int last_degree) const {
  std::optional<AddedSeconds> time(std::in_place, seconds_.place);
  const StopCheck& stop = record_.start_stop();
  const SeamlessLattice& lattice = traced_.lattice;
  const BezierMap& map = traced_.aligned.map;
  const long count = quad_count(traced_.t_mesh, edges);
  const double area =
      static_cast<double>(lattice.twice_area()) / 2 * lattice.unit() * lattice.unit();
  // Few digits, so that its multiples are exact.
  const double length = std::sqrt(area / static_cast<double>(count));
  const double step = std::ldexp(1.0, std::ilogb(length) - 20);
  const GridTranslations grid(map, lattice, traced_.t_mesh, edges,
                              step * std::round(length / step));
  const std::optional<BezierMap> whole =
      integer_grid_map(map, lattice, grid, {options_.first_degree, last_degree}, stop);
  if (!whole)
    throw Error(ErrorKind::Infeasible,
                fmt::format("no integer-grid map of degree {} to {} was reached",
                            options_.first_degree, last_degree));
  const IntegerGrid found(traced_.resolved, *whole, grid.edge_length(), stop);
  if (quad_count(found.t_mesh(), found.edges()) != count)
    throw Error(ErrorKind::Infeasible, "the integer-grid map has another number of quads");
  time.reset();
  PlacedQuads made = smoothed(found.lattice(), found.t_mesh(), found.edges());
  made.placed = QuadPlacing::IntegerGrid;
  made.degree = whole->degree();
  return made;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
