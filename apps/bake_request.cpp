#include "apps/bake_request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/arguments/suggestion.h"
#include "apps/outputs.h"
#include "majorant/apps/jobs/model_texture.h"
#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/pictures/images/image_file.h"

namespace majorant::app {
namespace {

constexpr int kSmallestImage = 1;
constexpr const char* kColor = "color";

std::string shown_extensions() { return fmt::format("{}", fmt::join(writable_images(), " ")); }

// Sets the size of the image. Throws Error(Usage) for malformed sizes.
void choose_size(const std::string& text, BakeOptions& options) {
  const auto size = size_in(text, kSmallestImage, kLargestImage);
  if (!size)
    throw Error(ErrorKind::Usage, fmt::format("--size: '{}' is not a size; give one or two numbers "
                                              "of pixels, {} to {}: 2048, or 2048,1024",
                                              text, kSmallestImage, kLargestImage));
  options.width = (*size)[0];
  options.height = (*size)[1];
}

}  // namespace

bool BakeRequest::names_file() const {
  if (is_of_model()) return false;
  return !image.empty() || std::find(kBakeAttributes.begin(), kBakeAttributes.end(), attribute) ==
                               kBakeAttributes.end();
}

void BakeRequest::add_to(CLI::App& verb) {
  add_options(
      verb, OptionGroup::Files,
      {{"new",
        &surface,
        "surface with the layout to bake into, in [0, 1]^2; " + result_help(),
        {.required = true}},
       {"output", &positional_output, "output file, same as -o"},
       {"-o,--output",
        &outputs,
        fmt::format("output: {}; OUT.npy.json is written beside OUT.npy", shown_extensions()),
        {.type = "FILE"}},
       {"--from",
        &from,
        "surface that carries the data; may be NEW",
        {.type = "OLD", .required = true}},
       {"--image",
        &image,
        fmt::format("image to bake, in the texture coordinates of OLD: {}. Without --image and "
                    "--attribute: the textures of OLD (.obj, .glb), or the colours of its vertices "
                    "if it has no texture",
                    fmt::join(readable_images(), " ")),
        {.type = "FILE"}},
       {"--attribute",
        &attribute,
        "data of OLD to bake: color (of vertices), position, normal (object space), face (number "
        "from 0), distortion, or the rows of FILE.npy, one for each face, vertex or corner of a "
        "face",
        {.type = "color|position|normal|face|distortion|FILE",
         .check = word_or_file({kBakeAttributes.begin(), kBakeAttributes.end()})}}});
  add_options(
      verb, OptionGroup::Pictures,
      {{"--size",
        &size,
        "pixels per side, or width and height (those of --image, else 1024)",
        {.type = "N|W,H"}},
       {"--method",
        &method,
        "how points of both surfaces correspond: same: by the numbers of equal faces; nearest: "
        "nearest points; auto: same where possible (auto)",
        {.check = one_of({"auto", "same", "nearest"})}},
       {"--distance",
        &distance,
        "largest distance of a nearest point, in model units (2 % of the diagonal of OLD); texels "
        "beyond it are counted as misses and filled from their neighbours; --strict refuses them",
        {.type = "X", .check = non_negative_number()}},
       {"--padding",
        &padding,
        fmt::format("pixels around charts that are filled with the nearest texel of the chart ({}; "
                    "for .npy 0)",
                    BakeOptions().padding),
        {.check = whole_number(0, kLargestImage)}},
       {"--samples", &samples, "samples per side of a texel (1)", {.check = whole_number(1, 64)}},
       {"--filter",
        &filter,
        "interpolation between the pixels of --image (bilinear)",
        {.check = one_of({"nearest", "bilinear"})}},
       {"--depth",
        &depth,
        "PNG: bits per channel (those of --image, else 16)",
        {.check = CLI::IsMember({8, 16})}},
       {"--linear", &linear,
        "the values of --image or of vertex colours are plain numbers, not sRGB, and are averaged "
        "as they are"}});
  add_options(verb, OptionGroup::Solver,
              {{"--time-limit",
                &time_limit,
                "time limit in seconds; no image is written beyond it",
                {.check = non_negative_number()}}});
  common.add_to(verb);
}

void BakeRequest::require_usable() {
  if (!positional_output.empty()) outputs.push_back(positional_output);
  require_some_output(outputs, writable_images());
  if (outputs.size() > 1)
    throw Error(
        ErrorKind::Usage,
        "-o: a run writes one image; leave out the others, and write a report with --report");
  const bool names_both = !image.empty() && !attribute.empty();
  if (names_both || (is_of_model() && !may_have_texture(from) && format_of(from) != ".ply"))
    throw Error(ErrorKind::Usage,
                "say what to bake: --image FILE, or --attribute color, position, normal, face, "
                "distortion or FILE.npy; the textures of an OBJ or GLB that is OLD, or the colours "
                "of its vertices, are baked without either");
  if (attribute.find("tangent") != std::string::npos)
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("--attribute {}: tangent-space normal maps are not baked: they depend on "
                    "the tangents of the program that shows them; --attribute normal is in "
                    "object space",
                    attribute));
  const std::string format = extension(output());
  const bool is_png = format == ".png";
  if (is_png && !attribute.empty() && attribute != "normal" && attribute != kColor &&
      (!names_file() || std::filesystem::exists(attribute)))
    throw Error(ErrorKind::Usage,
                fmt::format("--attribute {}: a PNG cannot hold these numbers; write -o OUT.npy{}",
                            attribute, writable_images().size() > 2 ? " or OUT.exr" : ""));
  if (depth && !is_png)
    throw Error(
        ErrorKind::Usage,
        fmt::format("--depth applies to .png, and {} holds floats; leave it out", output()));
  BakeOptions options;
  if (!size.empty()) choose_size(size, options);
}

std::vector<std::string> BakeRequest::labels() const {
  if (extension(output()) != ".npy") return {};
  return {output() + ".json"};
}

void BakeRequest::apply(BakeJob& job) const {
  if (job.attribute.empty()) job.attribute = attribute;  // otherwise it was found in the model
  job.image_transfer = linear ? Transfer::Linear : Transfer::Srgb;
  job.filter = filter == "nearest" ? Filter::Nearest : Filter::Bilinear;
  job.method = method == "same"      ? BakeMethod::Same
               : method == "nearest" ? BakeMethod::Nearest
                                     : BakeMethod::Automatic;
  job.distance = distance;
  BakeOptions& options = job.options;
  if (!job.images.empty()) options.width = options.height = 0;
  for (const Raster& one : job.images) {
    options.width = std::max(options.width, one.width());
    options.height = std::max(options.height, one.height());
  }
  if (!size.empty()) choose_size(size, options);
  options.samples = samples;
  const std::string format = extension(output());
  options.padding = padding.value_or(format == ".npy" ? 0 : BakeOptions().padding);
  options.depth = PixelDepth::Float;
  options.transfer = Transfer::Linear;
  if (format != ".png") return;
  const bool has_image = !job.images.empty();
  const bool is_eight =
      has_image && std::all_of(job.images.begin(), job.images.end(),
                               [](const Raster& one) { return one.depth() == PixelDepth::Eight; });
  options.depth = depth.value_or(is_eight ? 8 : 16) == 8 ? PixelDepth::Eight : PixelDepth::Sixteen;
  const bool is_color = job.attribute == kColor;
  if (is_color && !depth) options.depth = PixelDepth::Eight;
  if (!has_image && !is_color) options.transfer = Transfer::Signed;
  if ((has_image || is_color) && !linear) options.transfer = Transfer::Srgb;
}

Json BakeRequest::to_json(const BakeJob& job) const {
  return {{"from", from},
          {"image", image},
          {"attribute", job.attribute},
          {"size", {job.options.width, job.options.height}},
          {"method", method},
          {"distance", distance ? Json(*distance) : Json()},
          {"padding", job.options.padding},
          {"samples", samples},
          {"filter", filter},
          {"linear", linear},
          {"strict", common.strict}};
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
