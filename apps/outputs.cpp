#include "apps/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <new>
#include <optional>

#include "apps/arguments/suggestion.h"
#include "apps/streams.h"
#include "majorant/framework/error.h"
#include "majorant/io/write_obj.h"
#include "majorant/io/write_ply.h"

namespace majorant::app {
namespace {

constexpr const char* kAutomatic = "auto";
constexpr const char* kLagrange = "lagrange";
constexpr const char* kSurface = "surface";

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

void require_no_input(const NamedFile& output, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs)
    if (!input.empty() && output.identity && identify_file(input) == output.identity)
      throw Error(ErrorKind::Usage,
                  fmt::format("{} is read by this run ({}); give --force to replace it",
                              output.path, input));
}

}  // namespace

std::string extension(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

void require_writable(const CommonOptions& common, const std::vector<OutputNames>& outputs,
                      const std::vector<std::string>& inputs) {
  std::vector<OutputNames> all = outputs;
  if (common.report != kStandardOutput) all.push_back({{common.report}, {".json"}});
  std::vector<NamedFile> taken;
  for (const OutputNames& names : all)
    for (const std::string& path : names.paths) {
      if (path.empty()) continue;
      require_extension(path, names.extensions);
      require_writable_file(path);
      const NamedFile file{path, identify_file(path)};
      require_other_file(file, taken);
      if (!common.force) require_no_input(file, inputs);
      taken.push_back(file);
    }
}

void WrittenFiles::write(const std::string& path, const std::function<void()>& write) {
  Entry entry{path, "", kSuccess};
  try {
    write();
  } catch (const Error& e) {
    entry.failure = e.what();
    entry.code = e.kind() == ErrorKind::Invalid ? kInvalid : kUsage;
  } catch (const std::bad_alloc&) {
    entry.failure = fmt::format("cannot write {}: out of memory", path);
    entry.code = kUsage;
  }
  entries_.push_back(std::move(entry));
}

bool WrittenFiles::has(const std::string& path) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry& e) { return e.path == path && e.code == kSuccess; });
}

Json WrittenFiles::to_json() const {
  Json list = Json::array();
  for (const Entry& e : entries_)
    list.push_back({{"file", e.path}, {"written", e.code == kSuccess}, {"message", e.failure}});
  return list;
}

int WrittenFiles::conclude(int code) const {
  std::vector<std::string> failures, written;
  ExitCode worst = kSuccess;
  for (const Entry& e : entries_) {
    (e.code == kSuccess ? written : failures).push_back(e.code == kSuccess ? e.path : e.failure);
    worst = std::max(worst, e.code);
  }
  if (failures.empty()) return code;
  say("majorant: {}; {}\n", fmt::join(failures, "; "),
      written.empty() ? "nothing was written"
                      : fmt::format("written: {}", fmt::join(written, ", ")));
  return code == kSuccess || code == kLimit ? worst : code;
}

void FormatOptions::add_to(CLI::App& verb) {
  verb.add_option("--refine", tessellation.refine,
                  "pieces per edge in OBJ and PLY output, at least (default 1: cells stay one "
                  "triangle where that is valid)")
      ->check(CLI::Range(1, 20));
  verb.add_option_function<std::string>(
          "--vtu",
          [this](const std::string& cells) {
            vtu = cells == kLagrange ? VtuCells::Lagrange : VtuCells::Bezier;
          },
          "curved cells of VTU output: bezier, lossless, or lagrange, which more programs know")
      ->check(one_of({"bezier", kLagrange}));
  verb.add_option_function<std::string>(
          "--msh",
          [this](const std::string& content) {
            msh = content == kSurface ? MshContent::Surface : MshContent::Image;
          },
          "gmsh output: image, the mesh in the plane, or surface, with u and v as views of it")
      ->check(one_of({"image", kSurface}));
  verb.add_option_function<std::string>(
          "--grid", [this](const std::string& spacing) { svg.grid = parse_spacing(spacing); },
          "SVG: draw lines of constant u and v this far apart in uv (alone: a 32nd of the layout)")
      ->type_name("SPACING")
      ->default_str(kAutomatic)  // what it is without a value
      ->expected(0, 1);
}

bool is_straight_map_data(const std::string& path) {
  return extension(path) == ".obj" || extension(path) == ".ply";
}

bool is_map_data(const std::string& path) {
  return is_straight_map_data(path) || extension(path) == ".vtu" || extension(path) == ".msh";
}

void write_map(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const FormatOptions& options, const FileVerification& verify) {
  const std::string e = extension(path);
  if (e == ".vtu") write_vtu(path, map, options.vtu, verify);
  if (e == ".msh") write_msh(path, map, options.msh, verify);
  if (e == ".obj") write_obj(path, map, input, options.tessellation, verify);
  if (e == ".ply") write_ply(path, map, input, options.tessellation, verify);
  if (e == ".svg") write_svg(path, map, options.svg);
}

}  // namespace majorant::app
