// majorant bake NEW --from OLD -o OUT: what one surface carries, as an image in the layout of
// another.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "apps/arguments/suggestion.h"
#include "apps/command.h"
#include "apps/or_interrupted.h"
#include "apps/outputs.h"
#include "apps/process.h"
#include "apps/progress.h"
#include "apps/streams.h"
#include "apps/within_memory.h"
#include "majorant/certify/map_proof.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
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

// "N" or "W,H".
void parse_size(const std::string& text, BakeOptions& options) {
  const std::vector<std::string> parts = CLI::detail::split(text, ',');
  std::vector<int> sides;
  for (const std::string& part : parts) {
    int side = 0;
    if (CLI::detail::lexical_cast(part, side) && kSmallestImage <= side && side <= kLargestImage)
      sides.push_back(side);
  }
  if (sides.size() != parts.size() || sides.empty() || sides.size() > 2)
    throw Error(ErrorKind::Usage,
                fmt::format("--size: '{}' is no size; give pixels, {} to {}: 2048, or 2048,1024",
                            text, kSmallestImage, kLargestImage));
  options.width = sides.front();
  options.height = sides.back();
}

const std::string& output_of(const BakeRequest& request) { return request.outputs.front(); }

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
  if (!(request.time_limit >= 0))
    throw Error(ErrorKind::Usage, "--time-limit is not a number of seconds");
  require_writable(request.common, {{request.outputs, writable_images()}},
                   {request.surface, request.from,
                    request.names_file() ? request.input_of_values() : std::string()});
}

// How the image is kept; the image to bake has been read.
void choose_options(const BakeRequest& request, BakeJob& job) {
  BakeOptions& options = job.options;
  if (!job.images.empty()) options.width = options.height = 0;
  for (const Raster& image : job.images) {
    options.width = std::max(options.width, image.width());
    options.height = std::max(options.height, image.height());
  }
  if (!request.size.empty()) parse_size(request.size, options);
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

void read_inputs(const BakeRequest& request, BakeJob& job, const StopCheck& stop) {
  const auto surface = [&](const std::string& path, Texcoords texcoords) {
    return or_interrupted("reading " + path, [&] {
      BakeSurface read = within_memory(path, [&] {
        return read_bake_surface(path, texcoords, stop,
                                 request.common.strictness(Strictness::Texcoords));
      });
      say_warnings(read.warnings);
      return read;
    });
  };
  job.target = surface(request.surface, Texcoords::Needed);
  job.carrier = surface(request.from, Texcoords::Optional);
  if (request.is_of_model()) {
    ModelTexture texture = or_interrupted("reading the textures of " + request.from, [&] {
      return within_memory(request.from, [&] { return read_texture(job.carrier.polygons, stop); });
    });
    say_warnings(texture.warnings);
    job.images = std::move(texture.images);
    job.image_of_polygon = std::move(texture.image_of_polygon);
  }
  if (!request.image.empty())
    job.images.push_back(or_interrupted("reading " + request.image, [&] {
      return within_memory(request.image, [&] { return read_image(request.image, stop); });
    }));
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

void summarize(const BakeRequest& request, const BakeJob& job, const WrittenFiles& written,
               double seconds) {
  if (request.common.quiet) return;
  const BakeCounts& counts = job.baked->counts;
  written.say_sizes();
  say("{}: {} x {}, {} of {} texels covered, each once, {} partly, {} miss{}, {} of {} "
      "without texels, {:.4g} texels per unit, method {}, {:.2f} s\n",
      request.surface, job.options.width, job.options.height, counts.covered, counts.texels,
      counts.partly, counts.misses, counts.misses == 1 ? "" : "es", counts.charts_without_texels,
      count_text(static_cast<Index>(counts.charts), "chart"), job.density.mean,
      method_name(job.method), seconds);
}

int bake_files(BakeRequest request) {
  const auto start = std::chrono::steady_clock::now();
  require_usable(request);
  BakeJob job;
  if (!request.size.empty()) parse_size(request.size, job.options);
  const ThreadCount threads(usable_threads(request.common.threads));
  Progress progress(request.common, {Activity::Reading, Activity::Measuring, Activity::Writing});
  const RunRecord record(request.time_limit, 0, interruption_flag(), &progress);
  record.begin(Activity::Reading);
  read_inputs(request, job, record.stop());
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
  record.begin(Activity::Measuring);
  or_interrupted("baking " + request.surface, [&] {
    const FreeMemoryOnly limit;
    job.run(record.stop());
  });
  record.begin(Activity::Writing);
  const std::string why = refusal(request, job);
  WrittenFiles written;
  if (why.empty()) written.write(output_of(request), [&] { write_baked(output_of(request), job); });
  if (const std::string& path = request.common.report; !path.empty()) {
    Json report{{"schema_version", 1},
                {"version", MAJORANT_VERSION},
                {"command", "bake"},
                {"status", why.empty() ? "converged" : "failed"},
                {"message", why},
                {"input", {{"file", request.surface}}},
                {"options", options_of(request, job)},
                {"bake", bake_section(job)},
                {"warnings", job.target.warnings},
                {"outputs", written.to_json()},
                {"seconds", {{"total", seconds_since(start)}}},
                {"peak_memory_bytes", peak_memory_bytes()},
                {"threads", ThreadCount::current()}};
    written.write(path, [&] { write_json(path, report); });
  }
  progress.finish();
  if (!why.empty()) say("majorant: {}; no image is written\n", why);
  if (why.empty()) summarize(request, job, written, seconds_since(start));
  return written.conclude(why.empty() ? kSuccess : kInvalid);
}

}  // namespace

void add_bake(CLI::App& app, Action* run) {
  auto request = std::make_shared<BakeRequest>();
  CLI::App& verb =
      *app.add_subcommand("bake", "what one surface carries, as an image in the layout of another");
  begin_group(verb, OptionGroup::Files);
  verb.add_option("new", request->surface,
                  "surface with the layout to bake into: .obj .ply .vtu .msh, in [0, 1]^2")
      ->required();
  verb.add_option("output", request->positional_output, "output file, same as -o");
  verb.add_option("-o,--output", request->outputs,
                  fmt::format("output: {}; beside OUT.npy stands OUT.npy.json", shown_extensions()))
      ->type_name("FILE")
      ->allow_extra_args(false);
  verb.add_option("--from", request->from, "the surface that carries what is baked; may be NEW")
      ->type_name("OLD")
      ->required();
  verb.add_option("--image", request->image,
                  fmt::format("bake this image, in OLD's texture coordinates: {}; without it and "
                              "--attribute the textures of OLD, an .obj or .glb",
                              fmt::join(readable_images(), " ")))
      ->type_name("FILE");
  verb.add_option(
          "--attribute", request->attribute,
          "bake position, normal (object space), face (number from 0) or distortion of OLD, "
          "or the rows of FILE.npy, one a face or a vertex of OLD")
      ->type_name("NAME");
  begin_group(verb, OptionGroup::Pictures);
  verb.add_option("--size", request->size,
                  "pixels along both sides, or width and height (that of --image, else 1024)")
      ->type_name("N|W,H");
  verb.add_option("--method", request->method,
                  "same: equal faces by their numbers; nearest: nearest points; auto: same where "
                  "that is possible")
      ->check(one_of({"auto", "same", "nearest"}));
  verb.add_option("--distance", request->distance,
                  "farthest nearest point, in model units (2 % of OLD's diagonal); beyond, texels "
                  "are counted as misses and filled from their neighbours; --strict refuses them")
      ->type_name("X")
      ->check(non_negative_number());
  verb.add_option("--padding", request->padding,
                  fmt::format("pixels around charts filled with the nearest of their texels ({}; "
                              "of .npy 0)",
                              BakeOptions().padding))
      ->check(whole_number(0, kLargestImage));
  verb.add_option("--samples", request->samples, "samples along each side of a texel (1)")
      ->check(whole_number(1, 64));
  verb.add_option("--filter", request->filter, "between the pixels of --image (bilinear)")
      ->check(one_of({"nearest", "bilinear"}));
  verb.add_option("--depth", request->depth, "PNG: bits a channel (that of --image, else 16)")
      ->check(CLI::IsMember({8, 16}));
  verb.add_flag("--linear", request->linear,
                "--image holds numbers, not sRGB colours: they are filtered as they are");
  begin_group(verb, OptionGroup::Solver);
  verb.add_option("--time-limit", request->time_limit, "seconds; no image is written beyond")
      ->check(non_negative_number());
  request->common.add_to(verb);
  verb.footer(
      "Example: majorant bake low.obj --from scan.obj --image scan.png -o low.png --size "
      "2048");
  verb.callback([request, run] { *run = [request] { return bake_files(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
