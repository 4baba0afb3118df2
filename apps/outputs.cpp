#include "apps/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "majorant/framework/error.h"
#include "majorant/io/vtu.h"
#include "majorant/io/write_obj.h"

namespace majorant::app {
namespace {

constexpr const char* kAutomatic = "auto";

// A positive number, 0 for kAutomatic.
double parse_spacing(const std::string& text) {
  if (text == kAutomatic) return 0;
  double spacing = 0;
  if (!CLI::detail::lexical_cast(text, spacing) || !(spacing > 0) || !std::isfinite(spacing))
    throw CLI::ValidationError(
        "--grid",
        fmt::format("'{}' is no positive number; write --grid auto before a file name", text));
  return spacing;
}

}  // namespace

std::string extension(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

void require_writable(const std::vector<std::string>& paths,
                      const std::vector<std::string>& allowed) {
  for (const std::string& path : paths) {
    const std::string e = extension(path);
    if (std::find(allowed.begin(), allowed.end(), e) == allowed.end())
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: cannot write files of type '{}'; use one of {}", path, e,
                              fmt::join(allowed, " ")));
    const auto directory = std::filesystem::path(path).parent_path();
    if (!directory.empty() && !std::filesystem::is_directory(directory))
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: the directory does not exist; create it", path));
  }
}

void FormatOptions::add_to(CLI::App& verb) {
  verb.add_option("--refine", tessellation.refine,
                  "pieces per edge in OBJ output, at least (default 1: cells stay one triangle "
                  "where that is valid)")
      ->check(CLI::Range(1, 20));
  verb.add_option_function<std::string>(
          "--grid", [this](const std::string& spacing) { svg.grid = parse_spacing(spacing); },
          "SVG: draw lines of constant u and v this far apart in uv (alone: a 32nd of the layout)")
      ->type_name("SPACING")
      ->default_str(kAutomatic)  // what it is without a value
      ->expected(0, 1);
}

void write_map(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const FormatOptions& options) {
  const std::string e = extension(path);
  if (e == ".vtu") write_vtu(path, map);
  if (e == ".obj") write_obj(path, map, input, options.tessellation);
  if (e == ".svg") write_svg(path, map, options.svg);
}

}  // namespace majorant::app
