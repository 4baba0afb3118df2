#include "majorant/apps/jobs/quad_job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "majorant/apps/jobs/input_points.h"
#include "majorant/apps/jobs/quad_report.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/stopwatch.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/formats.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/read_vertex_lists.h"
#include "majorant/io/written_mark.h"
#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"
#include "majorant/parametrization/seams/edge_flags.h"

namespace majorant {
namespace {

constexpr int kOnBorder = -1;  // marks vertices on the border, which have no number of quads

// Returns quads and irregular vertices as cells.
VolumeMesh cells_of(const PolygonMesh& quads, const std::vector<Index>& patch_of) {
  VolumeMesh mesh;
  mesh.points.resize(static_cast<Index>(quads.positions.size()), 3);
  std::vector<int> around(quads.positions.size(), 0);
  CellBlock faces, irregular;
  faces.type.shape = CellShape::Quad;
  faces.nodes.resize(static_cast<Index>(quads.polygons.size()), 4);
  for (std::size_t v = 0; v < around.size(); ++v)
    mesh.points.row(static_cast<Index>(v)) = quads.positions[v];
  for (std::size_t q = 0; q < quads.polygons.size(); ++q) {
    for (std::size_t k = 0; k < 4; ++k) {
      faces.nodes(static_cast<Index>(q), static_cast<Index>(k)) = quads.polygons[q][k];
      ++around[quads.polygons[q][k]];
    }
    faces.numbers.push_back(static_cast<std::int64_t>(q));
    faces.regions.push_back(patch_of.empty() ? 0 : patch_of[q]);
  }
  const auto from = [&](Index h) { return faces.nodes(h / 4, h % 4); };
  const auto ends = [&](Index h) { return std::pair(from(h), from(HalfEdgesOf<4>::next(h))); };
  const PairOrder edges = order_of_edges(static_cast<Index>(around.size()), 4 * faces.size(), ends);
  edges.for_each_run([&](std::span<const PairOrder::Entry> sides) {
    if (sides.size() > 1) return;
    const auto [a, b] = ends(sides[0].number);
    around[a] = around[b] = kOnBorder;
  });
  for (std::size_t v = 0; v < around.size(); ++v) {
    if (around[v] == 4 || around[v] < 1) continue;
    irregular.numbers.push_back(static_cast<std::int64_t>(v));
    irregular.regions.push_back(around[v]);
  }
  irregular.nodes.resize(static_cast<Index>(irregular.numbers.size()), 1);
  for (std::size_t i = 0; i < irregular.numbers.size(); ++i)
    irregular.nodes(static_cast<Index>(i), 0) = static_cast<Index>(irregular.numbers[i]);
  mesh.blocks = {std::move(faces)};
  if (irregular.size() > 0) mesh.blocks.push_back(std::move(irregular));
  return mesh;
}

PolygonMesh quads_of(const std::string& path, const VolumeMesh& mesh) {
  PolygonMesh quads;
  quads.file = path;
  for (const auto& p : mesh.points.rowwise()) quads.positions.emplace_back(p);
  for (const CellBlock& block : mesh.blocks) {
    if (block.type.shape == CellShape::Point) continue;
    if (block.type.shape != CellShape::Quad || block.type.degree != 1)
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}: {}, no straight quads", path, describe(block.type)));
    for (const auto& nodes : block.nodes.rowwise())
      quads.polygons.push_back(std::vector<Index>(nodes.begin(), nodes.end()));
  }
  return quads;
}

// Returns the cones of a piece from cones at vertices of the input.
std::vector<Cone> cones_on(const SurfaceMesh& piece, const std::vector<Cone>& cones,
                           const std::vector<Index>& names) {
  std::vector<Cone> found;
  for (const Cone& cone : cones)
    if (const Index v = piece.find_input_vertex(names[cone.vertex]); v >= 0)
      found.push_back({v, cone.quarter_turns});
  return found;
}

// Returns 3 #F flags of a piece from flags of the whole surface.
std::vector<char> features_on(const SurfacePiece& piece, const std::vector<char>& all) {
  std::vector<char> found;
  for (const Index f : piece.face)
    for (Index k = 0; k < 3; ++k) found.push_back(all[3 * f + k]);
  return found;
}

std::optional<double> number_in(const std::string& text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || after != end) return std::nullopt;
  return number;
}

void append_mesh(const PolygonMesh& part, PolygonMesh& all) {
  const auto first = static_cast<Index>(all.positions.size());
  all.positions.insert(all.positions.end(), part.positions.begin(), part.positions.end());
  for (const auto polygon : part.polygons) {
    all.polygons.push_back(polygon);
    for (Index& v : all.polygons.back()) v += first;
  }
}

// made: the quads of that piece.
void add_features(const QuadMesh& made, const SurfacePiece& piece, QuadJob& job) {
  job.feature_lines += made.feature_lines;
  for (const LineEnds& line : made.relaxed)
    job.relaxed.push_back({piece.mesh->input_vertex(line.from), piece.mesh->input_vertex(line.to)});
  if (!made.relaxed.empty())
    job.shortest_feature = std::max(job.shortest_feature, made.shortest_feature);
  if (!made.conflict.empty()) job.conflicts.push_back(made.conflict);
  if (made.features.empty()) return;
  job.features.resize(to_size(job.surface.mesh->half_edge_count()), 0);
  for (std::size_t f = 0; f < piece.face.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      job.features[3 * to_size(piece.face[f]) + k] = made.features[3 * f + k];
}

std::string relaxed_features(const QuadJob& job) {
  std::vector<std::string> ends;
  for (const auto& [from, to] : job.relaxed) {
    if (ends.size() == kNamedPlaces) break;
    ends.push_back(fmt::format("{} to {}", from + 1, to + 1));
  }
  return fmt::format(
      "{}: {} of {} feature lines relaxed, quads cross them: those shorter than "
      "{:.3g}{} (vertices {}{})",
      job.polygons.file, job.relaxed.size(), job.feature_lines, 2 * job.shortest_feature,
      job.conflicts.empty() ? ", two edges of so many quads"
                            : fmt::format("; with more of them: {}", job.conflicts.front()),
      fmt::join(ends, ", "), job.relaxed.size() > kNamedPlaces ? ", ..." : "");
}

void add_seconds(const QuadSeconds& of_component, QuadSeconds& all) {
  all.map += of_component.map;
  all.quantize += of_component.quantize;
  all.place += of_component.place;
  all.smooth += of_component.smooth;
  all.check += of_component.check;
}

}  // namespace

RepairedSurface surface_for_quads(const PolygonMesh& input, const StopCheck& stop) {
  return repair(input,
                {.welding = Welding::EqualPlaces,
                 .crowded_edges = CrowdedEdges::Paired,
                 .short_edges = ShortEdges::Collapsed},
                stop);
}

void QuadJob::open(PolygonMesh input) {
  record.announce("building the surface");
  surface = surface_for_quads(input, record.start_stop());
  polygons = std::move(input);
}

// Makes the quads of component `number`. Error messages name the component if there are several.
QuadMesh QuadJob::quads_of(const SurfacePiece& piece, std::size_t number, std::size_t components,
                           const QuadMeshOptions& of_piece) {
  if (components == 1) return quad_mesh(*piece.mesh, of_piece, record);
  try {
    return quad_mesh(*piece.mesh, of_piece, record);
  } catch (const Refusal&) {
    throw;
  } catch (const Error& error) {
    const std::string prefix = message_prefix(*piece.mesh), text = error.what();
    const std::string share =
        options.count ? fmt::format("{} of the {} quads, ", *of_piece.count, *options.count) : "";
    throw Error(error.kind(),
                fmt::format("{}component {} of {} ({}{} triangles, one at vertex {}): {}", prefix,
                            number + 1, components, share, piece.mesh->face_count(),
                            user_vertex(*piece.mesh, piece.mesh->faces()(0, 0)),
                            text.substr(text.starts_with(prefix) ? prefix.size() : 0)));
  }
}

void QuadJob::solve(const std::string& source) {
  const SurfaceMesh& mesh = *surface.mesh;
  require_memory_for_quads(mesh, options);  // for all components
  if (options.map.cones)
    for (const Cone& cone : *options.map.cones)
      used_vertex(source, mesh, surface.welded[cone.vertex]);
  const std::vector<SurfacePiece> pieces = mesh.split(record.start_stop());
  long least = 0;
  for (const SurfacePiece& piece : pieces) {
    if (&piece != &pieces.front()) record.begin_pass();
    QuadMeshOptions of_piece = options;
    if (options.count)
      of_piece.count = std::max(
          1L, std::lround(static_cast<double>(*options.count) * piece.mesh->area() / mesh.area()));
    if (options.map.cones)
      of_piece.map.cones = cones_on(*piece.mesh, *options.map.cones, surface.welded);
    if (options.features && !options.features->empty())
      of_piece.features = features_on(piece, *options.features);
    const QuadMesh made =
        quads_of(piece, static_cast<std::size_t>(&piece - pieces.data()), pieces.size(), of_piece);
    const auto first = static_cast<Index>(quads.positions.size());
    for (const auto& [a, b] : made.feature_edges) feature_edges.push_back({first + a, first + b});
    append_mesh(made.quads, quads);
    for (const Index patch : made.patch_of) patch_of.push_back(patches + patch);
    add_features(made, piece, *this);
    requested_count += made.requested;
    patches += made.patches;
    degree = std::max(degree, made.degree);
    add_seconds(made.seconds, seconds);
    least += made.least_count.value_or(made.check.count);
    if (made.status != Status::Converged) status = made.status;
  }
  record.begin(Activity::Proving);
  {
    const AddedSeconds time(seconds.check);
    check = check_quads(quads, &mesh, features, record.telling(record.start_stop()),
                        options.border_turn);
  }
  if (!check.is_valid())
    throw Error(ErrorKind::Infeasible,
                fmt::format("{}: its components do not make valid quads together: {}",
                            polygons.file, check.defects.front()));
  const auto request = static_cast<double>(requested_count);
  if (static_cast<double>(check.count) > (1 + kCountClose) * request) least_count = least;
  if (!options.edge_length && std::abs(check.count - request) > kCountClose * request)
    warnings.push_back(
        fmt::format("{}: {} quads, {} requested: no valid mesh within {:.0f} % of that was found{}",
                    polygons.file, check.count, requested_count, 100 * kCountClose,
                    has_ragged_border(mesh) && options.border_turn <= kCornerTurn
                        ? "; without corners of its ragged border there may be one"
                        : ""));
  if (!relaxed.empty()) warnings.push_back(relaxed_features(*this));
}

RunReport quad_report(const QuadJob& job) {
  Json section =
      quads_section(job.quads, job.check, QuadsComparedWith::Surface, QuadsFeatures::Requested);
  section["requested"] = job.requested_count;
  section["least_count"] = job.least_count ? Json(*job.least_count) : Json();
  section["patches"] = job.patches;
  section["features"] = {{"requested", job.feature_lines},
                         {"covered", job.feature_lines - job.relaxed.size()},
                         {"relaxed", job.relaxed.size()}};
  section["degree"] = job.degree;
  Json input = input_section(job.polygons, *job.surface.mesh);
  for (const Repair& repair : job.surface.repairs) input["repairs"].push_back(describe(repair));
  std::vector<std::string> warnings = job.polygons.warnings;
  warnings.insert(warnings.end(), job.warnings.begin(), job.warnings.end());
  return {.command = "quads",
          .status = std::string(status_name(job.status)),
          .message = describe(job.check, QuadsComparedWith::Surface),
          .input = input,
          .options = job.options_json,
          .result = {{"quads", section}},
          .warnings = warnings,
          .seconds = {{"read", job.read_seconds},
                      {"map", job.seconds.map},
                      {"quantize", job.seconds.quantize},
                      {"place", job.seconds.place},
                      {"smooth", job.seconds.smooth},
                      {"check", job.seconds.check}}};
}

QuadPicture picture_of(const QuadJob& job, const std::string& title) {
  return {title, job.quads, job.patch_of, job.feature_edges};
}

void write_quads(const std::string& path, const PolygonMesh& quads, const SurfaceMesh& surface,
                 const std::vector<char>& features, const std::vector<Index>& patch_of,
                 double border_turn) {
  const auto judge = [&](const PolygonMesh& written) {
    const QuadCheck check = check_quads(written, &surface, features, {}, border_turn);
    if (!check.is_valid())
      throw Error(ErrorKind::Invalid, fmt::format("{}: {}", path, fmt::join(check.defects, "; ")));
  };
  if (!is_for(FormatUse::WriteQuads, path))
    throw Error(ErrorKind::Usage,
                fmt::format("{}: meshes of quads are written as {}", path,
                            fmt::join(extensions_for(FormatUse::WriteQuads), ", ")));
  const Format& format = *find_format(format_of(path));
  if (format.polygons_text == nullptr) {
    write_volume_mesh(path, cells_of(quads, patch_of), {}, nullptr,
                      [&](const VolumeMesh& written) { judge(quads_of(path, written)); });
    return;
  }
  write_file_atomically(path, format.polygons_text(quads),
                        [&](const std::string& temporary) { judge(read_mesh(temporary)); });
}

bool has_quads_as_cells(const std::string& path) {
  return is_for(FormatUse::WriteQuads, path) &&
         find_format(format_of(path))->polygons_text == nullptr;
}

PolygonMesh read_quads(const std::string& path, const StopCheck& stop, Strictness strictness) {
  if (has_quads_as_cells(path)) return quads_of(path, read_volume_mesh(path, stop));
  return read_mesh(path, stop, strictness);
}

std::string feature_file(const std::string& words) {
  return words == "none" || number_in(words) ? "" : words;
}

std::vector<char> features_of(const std::string& words, const PolygonMesh& polygons,
                              const RepairedSurface& surface, const StopCheck& stop) {
  constexpr double kMaximum = 180;
  if (words == "none") return {};
  if (const std::optional<double> degrees = number_in(words)) {
    if (!(*degrees > 0 && *degrees <= kMaximum))
      throw Error(
          ErrorKind::Usage,
          fmt::format("features of {} degrees: they are above 0, to {:.0f}", words, kMaximum));
    return sharp_edges(*surface.mesh, *degrees);
  }
  return features_of(read_seams(words, static_cast<Index>(polygons.positions.size()), stop), words,
                     surface);
}

std::vector<char> features_of(const std::vector<std::array<Index, 2>>& edges,
                              const std::string& source, const RepairedSurface& surface) {
  std::vector<std::array<Index, 2>> names;
  for (const auto& [a, b] : edges) names.push_back({surface.welded[a], surface.welded[b]});
  return flags_of_edges(*surface.mesh, names, source);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
