#include "apps/unwrap_request.h"

#include <fmt/format.h>

#include "apps/number_check.h"
#include "majorant/framework/error.h"
#include "majorant/io/internal/read_vertex_lists.h"

namespace majorant::app {
namespace {

constexpr std::string_view kSharp = "sharp", kSharpAngle = "sharp=";

bool is_sharp(const std::string& seams) {
  return seams == kSharp || seams.compare(0, kSharpAngle.size(), kSharpAngle) == 0;
}

double sharp_angle(const std::string& seams) {
  const std::string text = seams.substr(kSharpAngle.size());
  double angle = 0;
  if (!CLI::detail::lexical_cast(text, angle) || !(angle > 0) || !(angle < 180))
    throw Error(ErrorKind::Usage,
                fmt::format("--seams {}: '{}' is no angle between 0 and 180 degrees; write "
                            "--seams sharp=40",
                            seams, text));
  return angle;
}

}  // namespace

void UnwrapRequest::add_to(CLI::App& verb) {
  verb.add_option("--seams", seams,
                  "where to cut: auto; uv, the islands of the file's texture coordinates; "
                  "sharp[=DEGREES], edges between faces that meet at that angle or more; or a JSON "
                  "FILE {\"edges\": [[0, 1], ...]}");
  verb.add_option("--max-stretch", max_stretch,
                  fmt::format("auto: mean stretch up to which a chart is left uncut, > 1 ({:g})",
                              CutOptions().max_stretch))
      ->check(positive_number());
  verb.add_option("--padding", padding, "pixels between charts, at least (4)")
      ->check(non_negative_number());
  verb.add_option("--resolution", resolution, "pixels along the side of the layout (1024)")
      ->check(positive_number());
  verb.add_flag("--no-pack", no_pack, "leave charts where they are, also on top of each other");
  verb.add_flag("--strict", strict, "refuse a mesh with defects instead of repairing it");
  verb.add_option("--weld", weld,
                  "join vertices no farther apart than DISTANCE; 0: at equal positions (default: "
                  "only where no face shares a vertex)")
      ->type_name("DISTANCE")
      ->check(non_negative_number());
}

std::string UnwrapRequest::seams_file() const {
  return seams == "auto" || seams == "uv" || is_sharp(seams) ? "" : seams;
}

RepairedSurface UnwrapRequest::repaired(const PolygonMesh& polygons, const StopCheck& stop) const {
  RepairOptions options;
  options.weld = weld;
  RepairedSurface surface = repair(polygons, options, stop);
  if (!strict) return surface;
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
  CutOptions& cuts = options.cuts;
  cuts.given = surface.given_cuts;
  if (max_stretch) cuts.max_stretch = *max_stretch;
  if (seams == "uv") cuts.method = CutMethod::Texture;
  if (is_sharp(seams)) cuts.method = CutMethod::Sharp;
  if (is_sharp(seams) && seams != kSharp) cuts.sharp_angle = sharp_angle(seams);
  if (!seams_file().empty()) {
    cuts.method = CutMethod::Given;
    cuts.edges = read_seams(seams_file(), static_cast<Index>(polygons.positions.size()));
  }
  if (no_pack)
    options.packing.reset();
  else
    options.packing = PackOptions{.padding_pixels = padding, .resolution = resolution};
  return options;
}

Json UnwrapRequest::to_json() const {
  return {{"seams", seams},
          {"max_stretch", max_stretch.value_or(CutOptions().max_stretch)},
          {"padding", padding},
          {"resolution", resolution},
          {"no_pack", no_pack},
          {"strict", strict},
          {"weld", weld ? Json(*weld) : Json()}};
}

}  // namespace majorant::app
