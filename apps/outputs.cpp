#include "apps/outputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "apps/arguments/number_check.h"
#include "apps/arguments/suggestion.h"
#include "apps/failure.h"
#include "apps/or_interrupted.h"
#include "apps/refusal_message.h"
#include "apps/streams.h"
#include "apps/within_memory.h"
#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files_read_by.h"
#include "majorant/io/written_mark.h"
#include "majorant/pictures/images/png_file.h"

namespace majorant::app {
namespace {

using Picture = Format::Picture;

constexpr const char* kAutomatic = "auto";
constexpr const char* kLagrange = "lagrange";
constexpr const char* kSurface = "surface";
constexpr int kMaxSquares = PngOptions::kLargest;  // squares of a checkerboard; narrower ones
                                                   // would be less than a pixel wide

// Parses a positive number; 0 for kAutomatic.
double parse_spacing(const std::string& text) {
  if (text == kAutomatic) return 0;
  const std::optional<double> spacing = number_in(text);
  if (!spacing || !(*spacing > 0) || !std::isfinite(*spacing))
    throw CLI::ValidationError(
        "--grid",
        fmt::format("'{}' is not a positive number; write --grid auto before a file name", text));
  return *spacing;
}

// Parses "A,B".
ColorRange parse_range(const std::string& text) {
  const std::vector<double> ends = numbers_in(text);
  if (ends.size() != 2 || !(ends[0] < ends[1]))
    throw CLI::ValidationError(
        "--color-range",
        fmt::format("'{}' is not a range; give two numbers, the smaller one first: 4,10", text));
  return {ends[0], ends[1]};
}

Vector3 parse_view(const std::string& text) {
  const auto view = direction_in(text);
  if (!view)
    throw CLI::ValidationError(
        "--view", fmt::format("'{}' is not a direction; give three numbers towards the viewer, not "
                              "all 0: 1,0.5,2, or write --view auto before a file name",
                              text));
  return {(*view)[0], (*view)[1], (*view)[2]};
}

SheetSize parse_size(const std::string& text) {
  const auto size = size_in(text, PngOptions::kSmallest, PngOptions::kLargest);
  if (!size)
    throw CLI::ValidationError("--size",
                               fmt::format("'{}' is not a size; give one or two numbers of pixels, "
                                           "{} to {}: 1000 (a square) or 1000,800",
                                           text, PngOptions::kSmallest, PngOptions::kLargest));
  return {(*size)[0], (*size)[1]};
}

Quantity parse_quantity(const std::string& name) {
  const auto found = std::find_if(kQuantities.begin(), kQuantities.end(),
                                  [&](Quantity q) { return quantity_name(q) == name; });
  return *found;  // the check of the option ensures that it exists
}

std::vector<std::string> quantity_names() {
  std::vector<std::string> names;
  for (const Quantity q : kQuantities) names.emplace_back(quantity_name(q));
  return names;
}

void require_extension(const std::string& path, const std::vector<std::string>& allowed) {
  const std::string e = extension(path);
  if (e.empty())
    throw Error(
        ErrorKind::Usage,
        fmt::format("{}: the name has no extension, which says what to write; use one of {}", path,
                    fmt::join(allowed, " ")));
  if (std::find(allowed.begin(), allowed.end(), e) == allowed.end())
    throw Error(ErrorKind::Usage, fmt::format("{}: cannot write files of type '{}'; use one of {}",
                                              path, e, fmt::join(allowed, " ")));
}

// Returns the extensions of map or picture formats that an option applies to.
std::vector<std::string> written_where(bool (*is_concerned)(const Format&)) {
  std::vector<std::string> out;
  for (const Format& format : formats())
    if (serves(format, FormatUse::WriteMap) && is_concerned(format))
      out.push_back(format.extension);
  return out;
}
std::vector<std::string> shown_as(const std::vector<Picture>& pictures) {
  std::vector<std::string> out;
  for (const Format& format : formats())
    if (std::find(pictures.begin(), pictures.end(), format.picture) != pictures.end())
      out.push_back(format.extension);
  return out;
}

// Formats a size: "512 bytes", "12.3 kB".
std::string bytes_text(std::uintmax_t bytes) {
  constexpr std::array<const char*, 4> kUnits{"kB", "MB", "GB", "TB"};
  if (bytes < 1000) return fmt::format("{} bytes", bytes);
  double size = static_cast<double>(bytes) / 1000;
  std::size_t unit = 0;
  for (; size >= 999.5 && unit + 1 < kUnits.size(); ++unit) size /= 1000;
  return fmt::format("{:.3g} {}", size, kUnits[unit]);
}

struct NamedFile {
  std::string path;
  std::optional<FileIdentity> identity;
};

void require_other_file(const NamedFile& output, const std::vector<NamedFile>& taken) {
  for (const NamedFile& other : taken)
    if (other.path == output.path || (other.identity && other.identity == output.identity))
      throw Error(ErrorKind::Usage,
                  fmt::format("{} and {} are the same file; give each output its own name",
                              other.path, output.path));
}

// A file that a run reads: `path`, either the input `reader` itself or a file that it names.
struct ReadFile {
  FileIdentity identity;
  std::string path, reader;
};

// Returns the existing inputs and the files that they name.
std::vector<ReadFile> files_read(const std::vector<std::string>& inputs, const StopCheck& stop) {
  std::vector<ReadFile> files;
  const auto add = [&](const std::string& path, const std::string& reader) {
    if (const std::optional<FileIdentity> identity = identify_file(path))
      files.push_back({*identity, path, reader});
  };
  for (const std::string& input : inputs) {
    if (input.empty()) continue;
    add(input, input);
    try {
      const auto search = [&] { return files_read_by(input, stop); };
      for (const std::string& file : within_memory(input, search)) add(file, input);
    } catch (const Error&) {  // the file exceeds the memory; its reader reports that with figures
    }
  }
  return files;
}

void require_not_read(const NamedFile& output, const std::vector<ReadFile>& read) {
  if (!output.identity) return;
  for (const ReadFile& file : read)
    if (file.identity == *output.identity)
      throw Error(
          ErrorKind::Usage,
          fmt::format("{} is read by this run ({}); give --force to replace it", output.path,
                      file.path == file.reader
                          ? file.path
                          : fmt::format("{} names {}", file.reader, file.path)));
}

// Refuses to replace a mesh that majorant did not write. Pipes and empty files have nothing to
// lose.
void require_own_mesh(const std::string& path) {
  std::error_code unknown;
  if (!takes_mark(path) || !std::filesystem::is_regular_file(path, unknown)) return;
  if (std::filesystem::file_size(path, unknown) == 0 || has_mark(path)) return;
  throw Error(ErrorKind::Usage, fmt::format("{}: this file exists, and majorant did not write it; "
                                            "take another name, or give --force to replace it",
                                            path));
}

}  // namespace

std::vector<std::string> map_extensions(const std::vector<std::string>& also) {
  std::vector<std::string> all = extensions_for(FormatUse::WriteMap);
  for (std::string& picture : extensions_for(FormatUse::Show)) all.push_back(std::move(picture));
  all.insert(all.end(), also.begin(), also.end());
  return all;
}

std::string output_help(const std::vector<std::string>& extensions) {
  return fmt::format("output: {}, repeatable", fmt::join(extensions, " "));
}

std::string surface_help() {
  return fmt::format("mesh: {}, also .gz", fmt::join(extensions_for(FormatUse::ReadSurface), " "));
}

std::string result_help() {
  return fmt::format("{}, or {} with texture coordinates",
                     fmt::join(extensions_for(FormatUse::ReadMap), ", "),
                     in_words(extensions_for(FormatUse::ReadTexcoords), "or"));
}

std::string cells_help() {
  std::vector<std::string> list;
  for (const std::string& extension : extensions_for(FormatUse::ReadCells)) {
    const std::string& kinds = find_format(extension)->kinds;
    list.push_back(kinds.empty() ? extension : fmt::format("{} ({})", extension, kinds));
  }
  return fmt::format("{}", fmt::join(list, ", "));
}

OptionRow distortion_option(std::string* path) {
  return {"--distortion",
          path,
          "write a table of the stretch, area and angle distortion of each face to FILE.csv",
          {.type = "FILE"}};
}

void require_some_output(const std::vector<std::string>& outputs,
                         const std::vector<std::string>& extensions) {
  if (outputs.empty())
    throw Error(ErrorKind::Usage, fmt::format("no output file; add -o OUT, its name ending in {}",
                                              fmt::join(extensions, " ")));
}

void require_writable(const CommonOptions& common, const std::vector<OutputNames>& outputs,
                      const std::vector<std::string>& inputs, const StopCheck& stop) {
  std::vector<OutputNames> all = outputs;
  if (common.report != kStandardOutput) all.push_back({{common.report}, {".json"}});
  std::vector<NamedFile> taken;
  const std::vector<ReadFile> read =
      common.force ? std::vector<ReadFile>() : files_read(inputs, stop);
  for (const OutputNames& names : all)
    for (const std::string& path : names.paths) {
      if (path.empty()) continue;
      require_writable_file(path);  // a directory is refused, whatever its extension
      require_extension(path, names.extensions);
      const NamedFile file{path, identify_file(path)};
      require_other_file(file, taken);
      require_not_read(file, read);
      taken.push_back(file);
    }
  if (common.force) return;
  for (const NamedFile& file : taken) require_own_mesh(file.path);
}

void WrittenFiles::write(const std::string& path, const std::function<void()>& write) {
  Entry entry{path, "", kSuccess};
  try {
    write();
  } catch (const Error& e) {
    entry.failure = command_message(e);
    entry.code = e.kind() == ErrorKind::Invalid ? kInvalid : kUsage;
  } catch (const std::bad_alloc&) {
    entry.failure = fmt::format("cannot write {}: out of memory", path);
    entry.code = kUsage;
  } catch (const Stopped& stopped) {
    entry.failure = fmt::format("cannot write {}: {}", path, stopped.what());
    entry.code = kInvalid;
  } catch (const std::exception&) {
    entry.failure =
        fmt::format("cannot write {}: {}", path, failure_of(std::current_exception()).line);
    entry.code = kInternal;
  }
  entries_.push_back(std::move(entry));
}

void WrittenFiles::add(const std::string& path) { entries_.push_back({path, "", kSuccess}); }

bool WrittenFiles::has(const std::string& path) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry& e) { return e.path == path && e.code == kSuccess; });
}

void WrittenFiles::say_sizes() const {
  std::vector<std::string> files;
  for (const Entry& e : entries_) {
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(e.path, unknown);
    if (e.code == kSuccess && e.path != kStandardOutput && !unknown)
      files.push_back(fmt::format("{} ({})", e.path, bytes_text(bytes)));
  }
  if (!files.empty()) say("wrote {}\n", fmt::join(files, ", "));
}

Json WrittenFiles::to_json() const {
  Json list = Json::array();
  for (const Entry& e : entries_)
    list.push_back({{"file", e.path}, {"written", e.code == kSuccess}, {"message", e.failure}});
  return list;
}

int WrittenFiles::conclude(int code, const std::string& speaker) const {
  std::vector<std::string> failures, written;
  ExitCode worst = kSuccess;
  for (const Entry& e : entries_) {
    (e.code == kSuccess ? written : failures).push_back(e.code == kSuccess ? e.path : e.failure);
    worst = std::max(worst, e.code);
  }
  if (failures.empty()) return code;
  say("{}: {}; {}\n", speaker, fmt::join(failures, "; "),
      written.empty() ? "nothing was written"
                      : fmt::format("written: {}", fmt::join(written, ", ")));
  return code == kSuccess || code == kLimit ? worst : code;
}

void FormatOptions::read_image(const StopCheck& stop) {
  if (image.empty()) return;
  png.image = or_interrupted("reading " + image, [&] { return read_whole_file(image, stop); });
  pixels_of_png(image, *png.image);
}

bool FormatOptions::turns_map(const std::vector<std::string>& files) const {
  return svg.alignment == Alignment::Always &&
         std::any_of(files.begin(), files.end(), [](const std::string& path) {
           return is_map_data(path) || is_shown_as(Picture::Page, path);
         });
}

void FormatOptions::add_to(CLI::App& verb) {
  add_options(
      verb, OptionGroup::Files,
      {{"--refine",
        &tessellation.refine,
        "OBJ, PLY, glTF: least number of pieces per edge (default 1: a cell stays one triangle "
        "where that is valid)",
        {.check = whole_number(1, 20)}},
       {"--vtu",
        [this](const std::string& cells) {
          vtu = cells == kLagrange ? VtuCells::Lagrange : VtuCells::Bezier;
        },
        "VTU: write curved cells as bezier (default, lossless) or lagrange (read by more programs)",
        {.check = one_of({"bezier", kLagrange})}},
       {"--msh",
        [this](const std::string& content) {
          msh = content == kSurface ? MshContent::Surface : MshContent::Image;
        },
        "gmsh: write the mesh in the plane (image, default), or the surface with u and v as views "
        "(surface)",
        {.check = one_of({"image", kSurface})}}});
  add_options(
      verb, OptionGroup::Pictures,
      {{"--grid",
        [this](const std::string& spacing) { svg.grid = png.grid = parse_spacing(spacing); },
        "SVG, PNG: draw lines of constant u and v, SPACING apart in uv; with --view on the surface "
        "(without SPACING: a round number, 16 to 40 lines along the layout)",
        {.type = "SPACING", .default_word = kAutomatic}}});
  add_pictures_to(verb);
  for (const auto& [name, extensions] :
       std::vector<std::pair<const char*, std::vector<std::string>>>{
           {"--refine", written_where([](const Format& f) { return !f.has_curves; })},
           {"--vtu", written_where([](const Format& f) { return f.has_claims; })},
           {"--msh", written_where([](const Format& f) { return f.has_image_of_map; })},
           {"--grid", shown_as({Picture::Drawing, Picture::Image})},
           {"--align", map_extensions()},
           {"--view", shown_as({Picture::Image})},
           {"--image", shown_as({Picture::Image})}})
    options_.push_back({verb.get_option(name), extensions});
}

std::string FormatOptions::first_given() const {
  for (const auto& [option, extensions] : options_)
    if (option->count() > 0) return option->get_name();
  return {};
}

void FormatOptions::require_effect(const std::vector<std::string>& files) const {
  for (const auto& [option, extensions] : options_) {
    const bool is_seen = std::any_of(files.begin(), files.end(), [&](const std::string& path) {
      return std::find(extensions.begin(), extensions.end(), extension(path)) != extensions.end();
    });
    if (option->count() > 0 && !is_seen)
      throw Error(ErrorKind::Usage,
                  fmt::format("{0} applies to {1}, and no output is one of them; add -o OUT{2}, or "
                              "leave out {0}{3}",
                              option->get_name(), fmt::join(extensions, " "), extensions.front(),
                              other_meaning(option->get_name())));
  }
}

// Sizes in pixels may be meant for textures.
std::string FormatOptions::other_meaning(const std::string& option) const {
  const bool is_texture = option == "--size" && verb_->get_option_no_throw("--resolution");
  return is_texture ? " (that of a texture for the layout is --resolution)" : "";
}

void FormatOptions::add_drawing_to(CLI::App& verb) {
  verb_ = &verb;
  add_options(
      verb, OptionGroup::Pictures,
      {{"--color-range",
        [this](const std::string& range) {
          svg.color_range = png.color_range = parse_range(range);
        },
        "pictures: colours run from value A to value B (default: the same range for every map, "
        "from isometry up)",
        {.type = "A,B"}},
       {"--color-by",
        [this](const std::string& name) { svg.quantity = png.quantity = parse_quantity(name); },
        "pictures: the quantity that colours show, at every pixel of a PNG",
        {.check = one_of(quantity_names())}},
       {"--size",
        [this](const std::string& text) {
          const SheetSize size = parse_size(text);
          png.width = size.width;
          png.height = size.height;
          svg.size = size;
        },
        "PNG: pixels per side, or width and height (1000,800); SVG: the same in px, while text "
        "keeps its size (700,525 fits a column of a paper; default: 1000 wide, as high as needed)",
        {.type = "N|W,H"}},
       {"--edges",
        [this](const std::string& answer) {
          svg.edges = png.edges = answer == "yes" ? CellEdges::Drawn : CellEdges::Left;
        },
        "SVG, PNG of layouts: draw all edges of triangles (yes), or the outline alone (no)",
        {.check = one_of({"yes", "no"})}},
       {"--legend",
        [this](const std::string& answer) {
          svg.legends = png.legends = answer == "yes" ? Legends::Drawn : Legends::Left;
        },
        "SVG, PNG: explain colours and marks below the drawing (yes), or draw the map alone (no)",
        {.check = one_of({"yes", "no"})}},
       {"--transparent",
        [this](const std::string&) { svg.paper = png.paper = Paper::None; },
        "SVG, PNG: leave out the white background",
        {.is_flag = true}}});
  for (const char* name : {"--color-range", "--color-by"})
    options_.push_back({verb.get_option(name), extensions_for(FormatUse::Show)});
  for (const char* name : {"--size", "--edges", "--legend", "--transparent"})
    options_.push_back({verb.get_option(name), shown_as({Picture::Drawing, Picture::Image})});
}

void FormatOptions::add_pictures_to(CLI::App& verb) {
  add_drawing_to(verb);
  add_options(
      verb, OptionGroup::Pictures,
      {{"--align",
        [this](const std::string& answer) {
          svg.alignment = png.alignment = answer == "yes" ? Alignment::Always : Alignment::Never;
        },
        "turn the layout so that the longer side of its smallest bounding rectangle is horizontal, "
        "in data files, too (default: in pictures and pages alone, where nothing holds the layout)",
        {.type = "yes|no", .check = one_of({"yes", "no"}), .default_word = "yes"}},
       {"--view",
        [this](const std::string& view) {
          view_is_chosen = view == kAutomatic;
          if (!view_is_chosen) png.view = parse_view(view);
        },
        "PNG: show the surface from direction X,Y,Z, with a checkerboard (without a value: the "
        "view that a page opens with; default: show the layout)",
        {.type = "X,Y,Z", .default_word = kAutomatic}},
       {"--image",
        &image,
        "PNG: draw this .png on the surface or the layout",
        {.type = "FILE", .check = CLI::ExistingFile}},
       {"--squares",
        &png.squares,
        "PNG with --view: squares of the checkerboard along one side of the texture (default: "
        "round widths, about 16 to 40 along the layout)",
        {.type = "N",
         .check = whole_number(1, kMaxSquares),
         .needs = {"--view"},
         .excludes = {"--image", "--color-by", "--grid"}}}});
}

void say_left_out(const std::string& path, const std::vector<std::string>& what) {
  std::vector<std::string> parts = what;
  std::replace(parts.begin(), parts.end(), std::string("the surface"),
               std::string("the surface (--msh surface does)"));
  if (!parts.empty()) say("{}: does not hold {}\n", path, fmt::join(parts, ", "));
}

void write_json(const std::string& path, const Json& json) {
  const std::string text = json_text(json, 1) + "\n";
  if (path == kStandardOutput)
    print_text(text);
  else
    write_file_atomically(path, text);
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
