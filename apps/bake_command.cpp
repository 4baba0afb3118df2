// majorant bake NEW --from OLD -o OUT: what one surface carries, as an image in the layout of
// another.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/arguments/suggestion.h"
#include "apps/command.h"
#include "apps/outputs.h"
#include "apps/process.h"
#include "apps/run.h"
#include "apps/streams.h"
#include "majorant/certify/map_proof.h"
#include "majorant/framework/error.h"
#include "majorant/pictures/image_file.h"
#include "majorant/results/bake_job.h"
#include "majorant/results/model_texture.h"

namespace majorant::app {
namespace {

constexpr int kSmallestImage = 1;

struct BakeRequest {
  CommonOptions common;
  std::string surface, from, positional_output, image, attribute;
  std::vector<std::string> outputs;
  std::string size, method = "auto", filter = "bilinear";
  std::optional<double> distance;
  std::optional<int> padding, depth;
  int samples = 1;
  bool linear = false;
  double time_limit = std::numeric_limits<double>::infinity();

  std::string input_of_values() const { return image.empty() ? attribute : image; }
  // What OLD itself shows, where nothing else is named.
  bool is_of_model() const { return image.empty() && attribute.empty(); }
  bool names_file() const {
    if (is_of_model()) return false;
    return !image.empty() || std::find(kBakeAttributes.begin(), kBakeAttributes.end(), attribute) ==
                                 kBakeAttributes.end();
  }
};

std::string shown_extensions() { return fmt::format("{}", fmt::join(writable_images(), " ")); }

// Throws Error(Usage) for what is no size.
void choose_size(const std::string& text, BakeOptions& options) {
  const auto size = size_in(text, kSmallestImage, kLargestImage);
  if (!size)
    throw Error(ErrorKind::Usage,
                fmt::format("--size: '{}' is no size; give pixels, {} to {}: 2048, or 2048,1024",
                            text, kSmallestImage, kLargestImage));
  options.width = (*size)[0];
  options.height = (*size)[1];
}

const std::string& output_of(const BakeRequest& request) { return request.outputs.front(); }

// The file that write_baked() writes beside numbers.
std::vector<std::string> labels_of(const BakeRequest& request) {
  if (extension(output_of(request)) != ".npy") return {};
  return {output_of(request) + ".json"};
}

// Before any work.
void require_usable(BakeRequest& request) {
  if (!request.positional_output.empty()) request.outputs.push_back(request.positional_output);
  require_some_output(request.outputs, writable_images());
  if (request.outputs.size() > 1)
    throw Error(ErrorKind::Usage, "-o: one image a run; the report has its own flag");
  const bool names_both = !request.image.empty() && !request.attribute.empty();
  if (names_both || (request.is_of_model() && !may_have_texture(request.from)))
    throw Error(ErrorKind::Usage,
                "say what to bake: --image FILE, or --attribute position, normal, face, distortion "
                "or FILE.npy; the textures of an OBJ or GLB that is OLD are baked without either");
  if (request.attribute.find("tangent") != std::string::npos)
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("--attribute {}: tangent-space normal maps are not baked: they depend on "
                    "the tangents of the program that shows them; --attribute normal is in "
                    "object space",
                    request.attribute));
  const std::string format = extension(output_of(request));
  const bool is_png = format == ".png";
  if (is_png && !request.attribute.empty() && request.attribute != "normal")
    throw Error(ErrorKind::Usage,
                fmt::format("--attribute {}: these are numbers, which a PNG does not hold; write "
                            "-o OUT.npy{}",
                            request.attribute, writable_images().size() > 2 ? " or OUT.exr" : ""));
  if (request.depth && !is_png)
    throw Error(
        ErrorKind::Usage,
        fmt::format("--depth is of .png, and {} holds floats; leave it out", output_of(request)));
}

// How the image is kept; the image to bake has been read.
void choose_options(const BakeRequest& request, BakeJob& job) {
  BakeOptions& options = job.options;
  if (!job.images.empty()) options.width = options.height = 0;
  for (const Raster& image : job.images) {
    options.width = std::max(options.width, image.width());
    options.height = std::max(options.height, image.height());
  }
  if (!request.size.empty()) choose_size(request.size, options);
  options.samples = request.samples;
  const std::string format = extension(output_of(request));
  options.padding = request.padding.value_or(format == ".npy" ? 0 : BakeOptions().padding);
  options.depth = PixelDepth::Float;
  options.transfer = Transfer::Linear;
  if (format != ".png") return;
  const bool has_image = !job.images.empty();
  const bool is_eight =
      has_image && std::all_of(job.images.begin(), job.images.end(), [](const Raster& image) {
        return image.depth() == PixelDepth::Eight;
      });
  options.depth =
      request.depth.value_or(is_eight ? 8 : 16) == 8 ? PixelDepth::Eight : PixelDepth::Sixteen;
  if (!has_image) options.transfer = Transfer::Signed;
  if (has_image && !request.linear) options.transfer = Transfer::Srgb;
}

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
    ModelTexture texture = run.make("reading the textures of " + request.from, [&] {
      return within_memory(request.from,
                           [&] { return read_texture(job.carrier.polygons, run.stop()); });
    });
    say_warnings(texture.warnings);
    job.images = std::move(texture.images);
    job.image_of_polygon = std::move(texture.image_of_polygon);
  }
  if (!request.image.empty())
    job.images.push_back(
        run.read(request.image, [&] { return read_image(request.image, run.stop()); }));
}

Json options_of(const BakeRequest& request, const BakeJob& job) {
  return {{"from", request.from},
          {"image", request.image},
          {"attribute", request.attribute},
          {"size", {job.options.width, job.options.height}},
          {"method", request.method},
          {"distance", request.distance ? Json(*request.distance) : Json()},
          {"padding", job.options.padding},
          {"samples", request.samples},
          {"filter", request.filter},
          {"linear", request.linear},
          {"strict", request.common.strict}};
}

// Why the image is not written; empty: it is.
std::string refusal(const BakeRequest& request, const BakeJob& job) {
  const BakeCounts& counts = job.baked->counts;
  if (!job.is_proven())
    return fmt::format(
        "{}: the centres of {} texels lie in two places of the layout, those of {} are undecided, "
        "and a texel shows one; unwrap it without overlaps: `majorant unwrap`",
        request.surface, counts.doubly_covered, counts.undecided);
  if (request.common.strict && counts.misses > 0)
    return fmt::format(
        "{}: {} farther than {:.4g} from {}; raise --distance, or leave out --strict to have them "
        "filled",
        request.surface, count_text(static_cast<Index>(counts.misses), "texel"), job.farthest,
        request.from);
  return {};
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
  choose_options(request, job);
  job.attribute = request.attribute;
  job.image_transfer = request.linear ? Transfer::Linear : Transfer::Srgb;
  job.filter = request.filter == "nearest" ? Filter::Nearest : Filter::Bilinear;
  job.method = request.method == "same"      ? BakeMethod::Same
               : request.method == "nearest" ? BakeMethod::Nearest
                                             : BakeMethod::Automatic;
  job.distance = request.distance;
  run.record().begin(Activity::Measuring);
  run.make("baking " + request.surface, [&] {
    const FreeMemoryOnly limit;
    job.run(run.stop());
  });
  Made made{.report = bake_report(job)};
  made.report.options = options_of(request, job);
  if (const std::string why = refusal(request, job); !why.empty()) {
    made.report.status = "failed";
    made.report.message = why;
    made.faults.push_back(fmt::format("majorant: {}; no image is written", why));
    return made;
  }
  made.files.push_back(
      {output_of(request), [&] { write_baked(output_of(request), job); }, labels_of(request)});
  made.summary = [&](const WrittenFiles&) {
    return std::vector<std::string>{summary_of(request, job, run.seconds())};
  };
  return made;
}

int bake_files(BakeRequest request) {
  require_usable(request);
  BakeJob job;
  if (!request.size.empty()) choose_size(request.size, job.options);
  const RunPlan plan{
      .command = "bake",
      .common = request.common,
      .inputs = {request.surface, request.from,
                 request.names_file() ? request.input_of_values() : std::string()},
      .outputs = {{request.outputs, writable_images()}, {labels_of(request), {".json"}, false}},
      .stages = {Activity::Reading, Activity::Measuring, Activity::Writing},
      .time_limit = request.time_limit};
  return run_verb(plan, [&](Run& run) { return baked(request, job, run); });
}

}  // namespace

void add_bake(CLI::App& app, Action* run) {
  auto request = std::make_shared<BakeRequest>();
  CLI::App& verb =
      *app.add_subcommand("bake", "what one surface carries, as an image in the layout of another");
  BakeRequest& r = *request;
  add_options(
      verb, OptionGroup::Files,
      {{"new",
        &r.surface,
        "surface with the layout to bake into: .obj .ply .vtu .msh, in [0, 1]^2",
        {.required = true}},
       {"output", &r.positional_output, "output file, same as -o"},
       {"-o,--output",
        &r.outputs,
        fmt::format("output: {}; beside OUT.npy stands OUT.npy.json", shown_extensions()),
        {.type = "FILE"}},
       {"--from",
        &r.from,
        "the surface that carries what is baked; may be NEW",
        {.type = "OLD", .required = true}},
       {"--image",
        &r.image,
        fmt::format("bake this image, in OLD's texture coordinates: {}; without it and "
                    "--attribute the textures of OLD, an .obj or .glb",
                    fmt::join(readable_images(), " ")),
        {.type = "FILE"}},
       {"--attribute",
        &r.attribute,
        "bake position, normal (object space), face (number from 0) or distortion of OLD, or the "
        "rows of FILE.npy, one a face or a vertex of OLD",
        {.type = "NAME"}}});
  add_options(
      verb, OptionGroup::Pictures,
      {{"--size",
        &r.size,
        "pixels along both sides, or width and height (that of --image, else 1024)",
        {.type = "N|W,H"}},
       {"--method",
        &r.method,
        "same: equal faces by their numbers; nearest: nearest points; auto: same where that is "
        "possible",
        {.check = one_of({"auto", "same", "nearest"})}},
       {"--distance",
        &r.distance,
        "farthest nearest point, in model units (2 % of OLD's diagonal); beyond, texels are "
        "counted as misses and filled from their neighbours; --strict refuses them",
        {.type = "X", .check = non_negative_number()}},
       {"--padding",
        &r.padding,
        fmt::format("pixels around charts filled with the nearest of their texels ({}; of .npy 0)",
                    BakeOptions().padding),
        {.check = whole_number(0, kLargestImage)}},
       {"--samples",
        &r.samples,
        "samples along each side of a texel (1)",
        {.check = whole_number(1, 64)}},
       {"--filter",
        &r.filter,
        "between the pixels of --image (bilinear)",
        {.check = one_of({"nearest", "bilinear"})}},
       {"--depth",
        &r.depth,
        "PNG: bits a channel (that of --image, else 16)",
        {.check = CLI::IsMember({8, 16})}},
       {"--linear", &r.linear,
        "--image holds numbers, not sRGB colours: they are filtered as they are"}});
  add_options(verb, OptionGroup::Solver,
              {{"--time-limit",
                &r.time_limit,
                "seconds; no image is written beyond",
                {.check = non_negative_number()}}});
  request->common.add_to(verb);
  verb.footer(
      "Example: majorant bake low.obj --from scan.obj --image scan.png -o low.png --size "
      "2048");
  verb.callback([request, run] { *run = [request] { return bake_files(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
