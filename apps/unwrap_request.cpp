#include "apps/unwrap_request.h"

#include <fmt/format.h>

#include <utility>

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

void UnwrapRequest::open(AtlasJob& job, PolygonMesh polygons, Strictness strictness) const {
  RepairOptions how;
  how.weld = weld;
  job.open(std::move(polygons), how);
  const Repair* const first = job.first_repair();
  if (first && strictness == Strictness::Everything)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: {}; leave out --strict to have it repaired so", job.polygons->file,
                            describe(*first)));
  job.options.cuts = seams.options(*job.polygons);
  job.options.packing.reset();
  if (!no_pack)
    job.options.packing = PackOptions{.padding_pixels = padding, .resolution = resolution};
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
