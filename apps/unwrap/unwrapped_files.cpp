#include "apps/unwrap/unwrapped_files.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include "apps/or_interrupted.h"
#include "apps/page_content.h"
#include "apps/seam_request.h"
#include "majorant/apps/jobs/global_verdict.h"
#include "majorant/apps/jobs/obj_layout.h"
#include "majorant/certify/map_proof.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files/standard_stream.h"
#include "majorant/io/gltf_layout.h"
#include "majorant/io/io.h"
#include "majorant/io/mesh_objects.h"

namespace majorant::app {
namespace {

// Returns the mesh that an OBJ of this name is written from.
PolygonMesh marked_polygons(const UnwrapRun& run, const std::string& path, const MapFile& file) {
  PolygonMesh mesh = *run.job.polygons;
  if (run.is_baked(path)) mesh = with_material_file(std::move(mesh), path);
  std::vector<int> chart = chart_of_polygons(file, mesh);
  if (run.request.unwrap.layout.udim > 0) {
    std::vector<int> tile = chart;
    for (int& number : tile)
      if (number >= 0) number = run.job.atlas.packing->tiles[to_size(number)];
    mesh = with_tile_materials(std::move(mesh), tile);
  }
  return run.request.unwrap.layout.groups ? with_chart_groups(std::move(mesh), chart) : mesh;
}

// Writes a file of the layout; glTF in the set of --uv-set. Returns the words of write_map().
std::string write_layout(const UnwrapVerb& request, const std::string& path, const MapFile& file,
                         const PolygonMesh& polygons, const MapFormats& formats,
                         const FileVerification& verify) {
  if (!is_gltf(path)) return write_map(path, file, &polygons, formats, verify);
  write_gltf(path, file, &polygons, formats.tessellation, verify,
             to_size(request.unwrap.uv_set.value_or(0)));
  return {};
}

// Returns the parts of the input that an OBJ loses because tiles have their own materials.
std::vector<std::string> replaced(const UnwrapRun& run) {
  const std::vector<std::string> materials = material_of_polygons(*run.job.polygons);
  const bool has_some = std::any_of(materials.begin(), materials.end(),
                                    [](const std::string& name) { return !name.empty(); });
  if (run.request.unwrap.layout.udim == 0 || !has_some) return {};
  return {"materials, since every tile has one"};
}

// Returns the page of a layout. Charts with targets stay where these put them.
MapPage page_of(const UnwrapRun& run, std::size_t split_faces) {
  MapPage page;
  page.title = page_title(run.request.map.input);
  RunReport report = atlas_report(run.job);
  report.result["split_faces"] = split_faces;
  page.facts = page_facts(report, run.request.map.inputs());
  page.points = pulled_points(run.job.options.chart.map.handles, *run.job.surface.mesh);
  for (const Chart& chart : run.job.atlas.charts)
    for (const Pin& pin : chart.pins)
      page.points.push_back({chart.map->mesh().input_vertex(pin.vertex),
                             chart.map->control_points().segment<2>(2 * pin.vertex),
                             PagePoint::Hold::Pin});
  return page;
}

// Writes the files of one layout.
class LayoutFiles {
 public:
  explicit LayoutFiles(const UnwrapRun& run)
      : run_(run), file_(atlas_file(run.job, &table_)), formats_(run.request.outputs.formats) {
    if (run.job.atlas.packing) formats_.tessellation.overlap = Overlap::Excluded;
    split_ = split_faces(run.request.outputs.files, file_, run.job.polygons.get(), formats_);
    if (has_page(run.request.outputs.files)) formats_.page = page_of(run, split_.size());
  }

  // Returns the faces of the input that OBJ and PLY hold as triangles.
  const std::vector<Index>& split() const { return split_; }

  void write_table(const std::string& path) const { write_distortion(path, file_, table_); }
  void write(const std::string& path) const {
    const LayoutRequest& layout = run_.request.unwrap.layout;
    const bool is_obj = has_material_files(path);
    const bool is_baked = run_.is_baked(path);
    const bool is_marked = is_obj && (is_baked || layout.udim > 0 || layout.groups);
    PolygonMesh marked;
    if (is_marked) marked = marked_polygons(run_, path, file_);
    const FileVerification verify =
        proof_of_file(path, proof_request(run_.job, path), file_, formats_);
    const PolygonMesh& polygons = is_marked ? marked : *run_.job.polygons;
    std::string note;
    if (is_baked)
      or_interrupted("baking the texture of " + path, [&] {
        write_textured(path, {file_, polygons, formats_, verify}, *run_.job.polygons, *run_.texture,
                       run_.request.unwrap.image_side(), run_.job.record.stop());
      });
    else
      note = write_layout(run_.request, path, file_, polygons, formats_, verify);
    if (run_.request.common.quiet) return;
    std::vector<std::string> left = left_out(path, file_, formats_, run_.job.polygons.get());
    if (is_obj)
      for (std::string& what : replaced(run_)) left.push_back(std::move(what));
    say_left_out(path, left);
    if (!note.empty()) say("{}: {}\n", path, note);
  }

 private:
  const UnwrapRun& run_;
  FaceDistortion table_;
  MapFile file_;
  FormatOptions formats_;
  std::vector<Index> split_;
};

std::string chart_name(const AtlasJob& job, std::size_t k) {
  const Chart& chart = job.atlas.charts[k];
  return fmt::format("{}: chart {} (face {} and {} more)", job.polygons->file, k + 1,
                     job.surface.mesh->input_face(chart.faces.front()) + 1, chart.faces.size() - 1);
}

// Returns lines about charts that did not converge, named by their first faces, and about charts
// that stretch too much.
std::vector<std::string> lines_of_charts(const AtlasJob& job) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < job.atlas.charts.size(); ++k) {
    const Chart& chart = job.atlas.charts[k];
    if (chart.status != Status::Converged)
      lines.push_back(fmt::format("majorant: {}: {}{}", chart_name(job, k),
                                  status_name(chart.status),
                                  chart.message.empty() ? "" : ": " + chart.message));
    if (const std::string why = why_stretched(job.options, chart); !why.empty())
      lines.push_back(fmt::format("majorant: {}: stretch {:.4f}, more than --max-stretch {:g}: {}",
                                  chart_name(job, k), chart.stretch.l2,
                                  job.options.cuts.max_stretch, why));
  }
  return lines;
}

// Returns why charts were not divided further; `nothing` if dividing would not have helped.
std::string_view why_undivided(Status division, std::string_view nothing) {
  switch (division) {
    case Status::TimeLimit:
      return "the time limit was reached";
    case Status::Interrupted:
      return "interrupted";
    case Status::MaxIterations:
      return "no more layouts are tried";
    default:
      return nothing;
  }
}

// An object that takes more than this part of the square is named in a remark.
constexpr double kNearlyAll = 0.8;

// Returns advice about an object that leaves almost no room for the others; empty if there is none.
std::string remark_on_sizes(const AtlasJob& job) {
  if (!job.atlas.packing || job.options.face_scale.size() > 0) return {};
  const MeshObjects objects = objects_of(*job.polygons);
  if (objects.count() < 2) return {};
  const SurfaceMesh& mesh = *job.surface.mesh;
  std::vector<double> area(to_size(objects.count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](Index k) -> Vector3 {
      return mesh.positions().row(mesh.faces()(f, k)).transpose();
    };
    area[to_size(objects.of_polygon[to_size(mesh.input_face(f))])] +=
        (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  const auto largest = std::max_element(area.begin(), area.end());
  const double share = *largest / std::accumulate(area.begin(), area.end(), 0.0);
  if (!(share > kNearlyAll)) return {};
  const auto number = to_size(static_cast<Index>(largest - area.begin()));
  const std::string& name = objects.names[number];
  return fmt::format(
      "{}: {} takes {:.0f} % of the layout's area; --objects separate gives each object a square, "
      "--texel-density FILE each material its size",
      job.polygons->file,
      name.empty() ? fmt::format("object {}", number + 1) : fmt::format("object '{}'", name),
      100 * share);
}

// Returns a remark on charts that exceed the stretch limit but may not be cut, and on what forbids
// that; empty if there are none. Islands that are kept have the stretch that the file gives them.
std::string remark_on_stretch(const AtlasJob& job) {
  const UnwrapOptions& options = job.options;
  const bool is_one = options.limit == StretchLimit::Reported;
  if (options.islands == Islands::Kept || (!is_one && chooses_cuts(options.cuts.method))) return {};
  Index count = 0;
  double most = 0;
  for (const Chart& chart : job.atlas.charts) {
    if (!exceeds_stretch(options, chart)) continue;
    ++count;
    most = std::max(most, chart.stretch.l2);
  }
  if (count == 0) return {};
  return fmt::format("{}: {} more than {:g}, up to {:.4f}: {} forbids cutting", job.polygons->file,
                     count == 1 ? "1 chart stretches" : fmt::format("{} charts stretch", count),
                     options.cuts.max_stretch, most, is_one ? "--charts one" : "--seams");
}

// Returns remarks about repairs, and about requests that the layout does not meet.
std::vector<std::string> remarks(const AtlasJob& job) {
  std::vector<std::string> lines;
  const std::string& input = job.polygons->file;
  for (const Repair& r : job.surface.repairs)
    lines.push_back(fmt::format("{}: {}", input, describe(r)));
  const Atlas& atlas = job.atlas;
  const UnwrapOptions& options = job.options;
  const auto count = static_cast<Index>(atlas.charts.size());
  if (options.least_charts > 0 && count != options.least_charts)
    lines.push_back(
        fmt::format("{}: {} charts, not --charts {}: {}", input, count, options.least_charts,
                    count > options.least_charts
                        ? "fewer would stretch more than --max-stretch, or join pieces"
                        : why_undivided(atlas.division, "none can be divided further")));
  if (options.least_fill && atlas.packing && atlas.packing->fill < *options.least_fill)
    lines.push_back(fmt::format("{}: fill {:.3f}, not --fill {:g}: {}", input, atlas.packing->fill,
                                *options.least_fill,
                                why_undivided(atlas.division, "dividing charts gains no more")));
  if (std::string stretch = remark_on_stretch(job); !stretch.empty())
    lines.push_back(std::move(stretch));
  if (std::string sizes = remark_on_sizes(job); !sizes.empty()) lines.push_back(std::move(sizes));
  return lines;
}

std::vector<std::string> summary_of(const UnwrapRun& run, const WrittenFiles& written,
                                    double seconds) {
  const Atlas& atlas = run.job.atlas;
  const MapRequest& map = run.request.map;
  const std::string fill = atlas.packing ? fmt::format(", fill {:.2f}", atlas.packing->fill) : "";
  const auto stacked = std::count_if(atlas.charts.begin(), atlas.charts.end(),
                                     [](const Chart& chart) { return chart.place.has_value(); });
  const std::string on_others = stacked > 0 ? fmt::format(" ({} on others)", stacked) : "";
  std::vector<std::string> list{fmt::format(
      "{}: {}, {} chart{}{}, {} {:.6f}, seam length {:.4g} ({:.3g} sqrt(area)), mean stretch "
      "{:.4f}{}, degree {}, {}, {:.2f} s",
      map.input, status_name(atlas.status()), atlas.charts.size(),
      atlas.charts.size() == 1 ? "" : "s", on_others, map.energy, atlas.value(),
      seam_length(run.job), seam_length(run.job) / std::sqrt(run.job.surface.mesh->area()),
      atlas.stretch().l2, fill, map.degree, overlap_words(run.job.boundary, ImageOf::Charts),
      seconds)};
  const bool is_stacked = run.job.options.stacking != Stacking::None;
  for (const std::string& path : run.request.outputs.files)
    if (is_map_data(path) && written.has(path) && !is_standard_output(path))
      list.push_back(
          fmt::format("proof: majorant check {}{}{}", path, atlas.packing ? " --certify" : "",
                      is_stacked && !written_format(path)->has_claims ? " --stacked" : ""));
  return list;
}

// Writes the files of several objects, side by side.
class ObjectFiles {
 public:
  ObjectFiles(const ObjectsRun& run, std::vector<ObjectLayout> layouts)
      : run_(run), file_(map_of_objects(std::move(layouts))) {
    has_lines_ = run.request.unwrap.layout.groups || run.polygons.gltf;
    if (has_lines_) lines_ = with_lines();
    split_ =
        split_faces(run.request.outputs.files, file_, &run.polygons, run.request.outputs.formats);
  }

  // Returns the faces of the input that OBJ and PLY hold as triangles.
  const std::vector<Index>& split() const { return split_; }

  void write(const std::string& path) const {
    const bool is_marked = has_lines_ && has_material_files(path);
    const FormatOptions& formats = run_.request.outputs.formats;
    write_layout(run_.request, path, file_, is_marked ? lines_ : run_.polygons, formats,
                 proof_of_objects(path, run_.polygons));
    if (!run_.request.common.quiet)
      say_left_out(path, left_out(path, file_, formats, &run_.polygons));
  }

 private:
  // Returns the mesh for an .obj.
  PolygonMesh with_lines() const {
    PolygonMesh mesh = run_.polygons;
    if (mesh.gltf) mesh = with_object_names(std::move(mesh), objects_of(run_.polygons));
    if (run_.request.unwrap.layout.groups)
      mesh = with_chart_groups(std::move(mesh), chart_of_polygons(file_, run_.polygons));
    return mesh;
  }

  const ObjectsRun& run_;
  MapFile file_;
  bool has_lines_ = false;
  PolygonMesh lines_;
  std::vector<Index> split_;
};

}  // namespace

Made made_of(const UnwrapRun& run, const Run& clock, bool is_reported) {
  const Atlas& atlas = run.job.atlas;
  Made made{
      .report = {.status = std::string(status_name(atlas.status())), .message = atlas.message()}};
  made.faults = lines_of_charts(run.job);
  if (is_reported) made.report = atlas_report(run.job);
  if (atlas.status() == Status::Failed) return made;
  const auto files = std::make_shared<LayoutFiles>(run);
  if (const std::string& path = run.request.outputs.distortion; !path.empty())
    made.files.push_back({path, [=] { files->write_table(path); }});
  for (const std::string& path : run.request.outputs.files) {
    if (extension(path) == ".json") continue;
    made.files.push_back({path, [=] { files->write(path); }});
    if (run.is_baked(path)) {
      std::vector<std::string>& beside = made.files.back().beside;
      beside = files_beside(path);
      for (std::string& file : layer_files(path, *run.texture)) beside.push_back(std::move(file));
    }
  }
  made.remarks = remarks(run.job);
  if (is_reported) made.report.result["split_faces"] = files->split().size();
  if (!files->split().empty())
    made.remarks.push_back(
        fmt::format("{}: {}", run.request.map.input, split_in_words(files->split())));
  for (std::string& line : untextured_in_words(run.request.map.input, atlas.cuts))
    made.remarks.push_back(std::move(line));
  made.summary = [&](const WrittenFiles& written) {
    return summary_of(run, written, clock.seconds());
  };
  return made;
}

void ObjectsRun::add_lines(const AtlasJob& job, const std::string& file) {
  const auto append = [](std::vector<std::string>& list, const std::vector<std::string>& more) {
    list.insert(list.end(), more.begin(), more.end());
  };
  append(faults, lines_of_charts(job));
  const Status status = job.atlas.status();
  if (status == Status::Failed) return;  // no layout to sum up
  append(lines, remarks(job));
  lines.push_back(fmt::format(
      "{}: {}, {}, {} {:.6f}, mean stretch {:.4f}, fill {:.2f}, {}", file, status_name(status),
      count_text(static_cast<Index>(job.atlas.charts.size()), "chart"), request.map.energy,
      job.atlas.value(), job.atlas.stretch().l2, job.atlas.packing->fill,
      overlap_words(job.boundary, ImageOf::Charts)));
}

Made made_of(const ObjectsRun& run, UnwrappedObjects objects) {
  Made made{.report = objects_report(objects, run.polygons)};
  made.faults = run.faults;
  if (objects.status == Status::Failed) return made;
  const auto files = std::make_shared<ObjectFiles>(run, std::move(objects.layouts));
  for (const std::string& path : run.request.outputs.files)
    if (extension(path) != ".json") made.files.push_back({path, [=] { files->write(path); }});
  if (!files->split().empty())
    made.remarks.push_back(
        fmt::format("{}: {}", run.request.map.input, split_in_words(files->split())));
  made.summary = [&](const WrittenFiles& written) {
    std::vector<std::string> list = run.lines;
    for (const std::string& path : run.request.outputs.files)
      if (is_map_data(path) && written.has(path) && !is_standard_output(path))
        list.push_back(fmt::format("proof: majorant check {} --certify --objects separate", path));
    return list;
  };
  return made;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
