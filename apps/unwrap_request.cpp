#include "apps/unwrap_request.h"

#include <fmt/format.h>

#include "apps/arguments/number_check.h"
#include "majorant/framework/error.h"

namespace majorant::app {
void UnwrapRequest::add_to(CLI::App& verb) {
  seams.add_to(verb);
  verb.add_option("--padding", padding,
                  fmt::format("pixels between charts, at least ({})", padding))
      ->check(non_negative_number());
  verb.add_option("--resolution", resolution,
                  fmt::format("pixels along the side of the layout ({})", resolution))
      ->check(positive_number());
  verb.add_flag("--no-pack", no_pack, "leave charts where they are, also on top of each other")
      ->excludes("--padding")
      ->excludes("--resolution");
  verb.add_option("--weld", weld,
                  "join vertices no farther apart than DISTANCE; 0: at equal positions (default: "
                  "only where no face shares a vertex)")
      ->type_name("DISTANCE")
      ->check(non_negative_number());
}

RepairedSurface UnwrapRequest::repaired(const PolygonMesh& polygons, Strictness strictness,
                                        const StopCheck& stop) const {
  RepairOptions options;
  options.weld = weld;
  RepairedSurface surface = repair(polygons, options, stop);
  if (strictness != Strictness::Everything) return surface;
  for (const Repair& r : surface.repairs)
    if (r.kind != RepairKind::MovedToOrigin)
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}: {}; leave out --strict to have it repaired so", polygons.file,
                              describe(r)));
  return surface;
}

UnwrapOptions UnwrapRequest::options(const PolygonMesh& polygons,
                                     const RepairedSurface& surface) const {
  UnwrapOptions options;
  options.cuts = seams.options(polygons);
  options.cuts.given = surface.given_cuts;
  if (no_pack)
    options.packing.reset();
  else
    options.packing = PackOptions{.padding_pixels = padding, .resolution = resolution};
  return options;
}

Json UnwrapRequest::to_json() const {
  Json options = seams.to_json();
  options.update({{"padding", padding},
                  {"resolution", resolution},
                  {"no_pack", no_pack},
                  {"weld", weld ? Json(*weld) : Json()}});
  return options;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
