// majorant bake NEW --from OLD -o OUT: transfers data of one surface to an image in the layout of
// another.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "apps/bake_request.h"
#include "apps/command.h"
#include "apps/process.h"
#include "apps/run.h"
#include "apps/streams.h"
#include "majorant/apps/jobs/bake_job.h"
#include "majorant/apps/jobs/model_texture.h"
#include "majorant/certify/map_proof.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/geometry.h"
#include "majorant/pictures/images/image_file.h"

namespace majorant::app {
namespace {

void read_inputs(const BakeRequest& request, BakeJob& job, const Run& run) {
  const auto surface = [&](const std::string& path, Texcoords texcoords) {
    BakeSurface read = run.read(path, [&] {
      return read_bake_surface(path, texcoords, run.stop(),
                               request.common.strictness(Strictness::Texcoords));
    });
    say_warnings(read.warnings);
    return read;
  };
  job.target = surface(request.surface, Texcoords::Needed);
  job.carrier = surface(request.from, Texcoords::Optional);
  if (request.is_of_model()) {
    std::optional<ModelTexture> texture = run.make("reading the textures of " + request.from, [&] {
      return within_memory(request.from, [&] {
        return find_texture(job.carrier.polygons, Layers::Color, run.stop());
      });
    });
    if (!texture) {
      if (!has_vertex_colors(job.carrier))
        throw Error(ErrorKind::Unsupported,
                    fmt::format("{}: has nothing to bake: no texture (texture coordinates, and a "
                                "map_Kd of an mtllib, or a base colour texture of a GLB), and no "
                                "colours of vertices",
                                request.from));
      job.attribute = "color";
    } else {
      say_warnings(texture->warnings);
      job.images = std::move(texture->color.images);
      job.wraps = std::move(texture->color.wraps);
      job.image_of_polygon = std::move(texture->color.image_of_polygon);
    }
  }
  if (!request.image.empty())
    job.images.push_back(
        run.read(request.image, [&] { return read_image(request.image, run.stop()); }));
}

// Returns the reason why no image is written; empty if there is none.
std::string refusal(const BakeRequest& request, const BakeJob& job) {
  const BakeCounts& counts = job.baked->counts;
  if (!job.is_proven())
    return fmt::format(
        "{}: the centres of {} texels lie in two places of the layout, those of {} are undecided, "
        "and a texel shows one; unwrap it without overlaps: `majorant unwrap`",
        request.surface, counts.doubly_covered, counts.undecided);
  if (job.is_all_missed())
    return fmt::format(
        "{}: all of its {} miss: the nearest point of {} is {:.4g} away, and --distance is {:.4g}; "
        "diagonals: {:.4g} and {:.4g}; {}",
        request.surface,
        count_text(static_cast<Index>(counts.covered + counts.partly), "covered texel"),
        request.from, job.apart.value_or(0), job.farthest, diagonal(job.target.mesh->positions()),
        diagonal(job.carrier.mesh->positions()),
        "bring both to the same units and place, or raise --distance");
  if (request.common.strict && counts.misses > 0)
    return fmt::format(
        "{}: {} farther than {:.4g} from {}; raise --distance, or leave out --strict to have them "
        "filled",
        request.surface, count_text(static_cast<Index>(counts.misses), "texel"), job.farthest,
        request.from);
  return {};
}

// Returns remarks about texels whose normals are opposed to the surface that they show.
std::vector<std::string> remarks_of(const BakeRequest& request, const BakeJob& job) {
  std::vector<std::string> lines;
  if (job.sense == Sense::Reversed)
    lines.push_back(
        fmt::format("{}: its faces are oriented the other way than those of {}; its normals were "
                    "reversed for the comparison",
                    request.from, request.surface));
  if (job.baked->counts.opposed > 0)
    lines.push_back(
        fmt::format("{}: {:.3g} % of its texels show places of {} whose normals point the other "
                    "way, since no other place is within {:.4g}",
                    request.surface, 100 * job.opposed(), request.from, job.farthest));
  return lines;
}

std::string summary_of(const BakeRequest& request, const BakeJob& job, double seconds) {
  const BakeCounts& counts = job.baked->counts;
  return fmt::format(
      "{}: {} x {}, {} of {} texels covered, each once, {} partly, {} miss{}, {} of {} "
      "without texels, {:.4g} texels per unit, method {}, {:.2f} s",
      request.surface, job.options.width, job.options.height, counts.covered, counts.texels,
      counts.partly, counts.misses, counts.misses == 1 ? "" : "es", counts.charts_without_texels,
      count_text(static_cast<Index>(counts.charts), "chart"), job.density.mean,
      method_name(job.method), seconds);
}

Made baked(const BakeRequest& request, BakeJob& job, Run& run) {
  read_inputs(request, job, run);
  if (!is_in_unit_square(*job.target.layout))
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("{}: its layout leaves [0, 1]^2, which is what an image shows; write it "
                    "with --normalize",
                    request.surface));
  request.apply(job);
  run.record().begin(Activity::Measuring);
  run.make("baking " + request.surface, [&] {
    const ScopedMemoryLimit limit;
    job.run(run.record().telling(run.stop()));
  });
  Made made{.report = bake_report(job)};
  made.report.options = request.to_json(job);
  if (const std::string why = refusal(request, job); !why.empty()) {
    made.report.status = "failed";
    made.report.message = why;
    made.faults.push_back(fmt::format("majorant: {}; no image is written", why));
    return made;
  }
  made.files.push_back(
      {request.output(), [&] { write_baked(request.output(), job); }, request.labels()});
  made.remarks = remarks_of(request, job);
  made.summary = [&](const WrittenFiles&) {
    return std::vector<std::string>{summary_of(request, job, run.seconds())};
  };
  return made;
}

int bake_files(BakeRequest request) {
  request.require_usable();
  BakeJob job;
  const RunPlan plan{
      .command = "bake",
      .common = request.common,
      .inputs = {request.surface, request.from,
                 request.names_file() ? request.input_of_values() : std::string()},
      .outputs = {{request.outputs, writable_images()}, {request.labels(), {".json"}, false}},
      .stages = {Activity::Reading, Activity::Measuring, Activity::Writing},
      .time_limit = request.time_limit,
      .images_are_results = true};
  return run_verb(plan, [&](Run& run) { return baked(request, job, run); });
}

}  // namespace

void add_bake(CLI::App& app, Action* run) {
  auto request = std::make_shared<BakeRequest>();
  CLI::App& verb = *app.add_subcommand(
      "bake",
      "transfer a texture, normals or vertex data from one surface to the UV layout of another");
  request->add_to(verb);
  verb.footer(
      "Example: majorant bake low.obj --from scan.obj --image scan.png -o low.png --size "
      "2048");
  verb.callback([request, run] { *run = [request] { return bake_files(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
