#include "majorant/apps/jobs/check_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "majorant/apps/jobs/global_verdict.h"
#include "majorant/apps/jobs/internal/check_claims.h"
#include "majorant/apps/jobs/write_map.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/error.h"
#include "majorant/io/io.h"
#include "majorant/io/layout_scale.h"
#include "majorant/io/mesh_objects.h"
#include "majorant/maps/energy_text.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/mesh/refusal.h"

namespace majorant {
namespace {

EnergySum energy_of(const Claims& claims, Findings& findings) {
  std::optional<EnergySum> energy = find_energy_sum(claimed_energy(claims));
  if (energy) return *std::move(energy);
  findings.add_violation(
      fmt::format("majorant_claims: no energy is called '{}'", claimed_energy(claims)));
  return {{symmetric_dirichlet(), 1.0}};
}

// Measures in a file define a scale, as claims do.
bool says_nothing_of_scale(const MapFile& file) {
  return has_assumed_scale(file) && file.distortion.size() == 0 && file.min_det.size() == 0 &&
         file.face_distortion.rows() == 0;
}

// Means over the faces that have an area.
class OtherFaces {
 public:
  explicit OtherFaces(const SurfaceMesh& mesh) : weight_(rest_shapes(mesh).measure) {
    for (const RestTriangle& rest : mesh.rest_triangles()) weight_[rest.face] = 0;
  }
  double mean(const Vec& face_value) const { return weight_.dot(face_value) / weight_.sum(); }

 private:
  Vec weight_;
};

// Returns the factor of uv at which the mean of symmetric Dirichlet is least. For the map scaled by
// t it is a t^2 + b / t^2. The values a + b at 1 and 4 a + b / 4 at 2 determine a and b; the
// minimum is at t^4 = b / a.
double best_scale(const MapFile& file, const BezierMap& map, const OtherFaces& others,
                  const StopCheck& stop) {
  const double first = layout_scale(file);
  if (stop() != Directive::Continue) return first;
  const EnergySum energy{{symmetric_dirichlet(), 1.0}};
  const RestShapes rest = rest_shapes(map.mesh());
  const auto mean = [&](double scale) {
    Vec of_faces;
    mean_density(map.with(map.shared_space(), scale * map.control_points()), rest, energy,
                 of_faces);
    return others.mean(of_faces);
  };
  const double once = mean(first), twice = mean(2 * first);
  const double a = (4 * twice - once) / 15;
  const double scale = first * std::pow((once - a) / a, 0.25);
  return scale > 0 && std::isfinite(scale) ? scale : first;
}

}  // namespace

std::string claimed_energy(const Claims& claims) {
  return claims.energy.value_or("symmetric-dirichlet");
}

CheckedEnergy measure_as_claimed(const MapFile& file, const BezierMap& map, const Claims& claims,
                                 const StopCheck& stop, Findings& findings, MapMeasures& measures) {
  const OtherFaces others(map.mesh());
  CheckedEnergy out;
  out.name = claimed_energy(claims);
  out.is_best_scale = says_nothing_of_scale(file);
  out.scale = out.is_best_scale ? best_scale(file, map, others, stop) : claimed_scale(claims);
  measures = measure_normalized(map, out.scale, energy_of(claims, findings), stop);
  out.without_area = static_cast<Index>(map.mesh().rest_triangles().size());
  if (out.without_area < map.mesh().face_count()) out.value = others.mean(measures.face_value);
  return out;
}

std::string describe(const CheckedEnergy& energy) {
  std::string text = energy.name;
  const std::string scale =
      energy.is_best_scale ? fmt::format(" at the best scale, uv times {:.6g}", energy.scale) : "";
  if (energy.without_area == 0) return fmt::format("{} {:.9g}{}", text, energy.value, scale);
  text += fmt::format(
      " infinite, since {} no area",
      energy.without_area == 1 ? "1 face has" : fmt::format("{} faces have", energy.without_area));
  if (std::isnan(energy.value)) return text;
  return text + fmt::format(" ({:.9g} over the others{})", energy.value, scale);
}

void add_energy(const CheckedEnergy& energy, Json& section) {
  section["layout_scale"] = 1 / energy.scale;
  section["scale_is_assumed"] = energy.is_best_scale;
  section["faces_without_area"] = energy.without_area;
  if (energy.without_area == 0) return;
  section["value"] = nullptr;  // infinite, like the largest density and stretch
  section["max_density"] = nullptr;
  section["sigma_max"] = nullptr;
  section["value_over_others"] = energy.value;
}

namespace {

// Returns whether nothing defines where a map is cut: files without claims, and atlases older than
// the claim `cuts`.
bool is_untold(const MapFile& file, const Claims& claims) {
  const bool says_nothing = !claims.version && !claims.seams;
  return !claims.cuts && (says_nothing || file.chart.size() > 0);
}

void ask_about_cuts(const MapFile& file, const CheckRequest& request, const Claims& claims,
                    ProofRequest& proof_request) {
  const bool is_seamless = request.seamless || claims.seams.value_or(false);
  const CutRule none = is_seamless ? CutRule::Seams : CutRule::Nothing;
  const CutRule free = is_seamless ? CutRule::SeamsOrFree : CutRule::Free;
  switch (request.cuts) {
    case CheckRequest::Cuts::Auto:
      proof_request.cuts = is_seamless || !(claims.cuts || is_untold(file, claims)) ? none : free;
      proof_request.cut_edges = claims.cuts;
      break;
    case CheckRequest::Cuts::None:
      proof_request.cuts = none;
      break;
    case CheckRequest::Cuts::Free:
      proof_request.cuts = free;
      break;
  }
}

ProofRequest questions(const MapFile& file, const CheckRequest& request, const Claims& claims,
                       const StopCheck& stop) {
  ProofRequest proof_request;
  proof_request.surface = request.surface;
  ask_about_cuts(file, request, claims, proof_request);
  const bool is_forbidden = request.certify || claims.bijective.value_or(false);
  proof_request.overlap =
      is_forbidden ? ProofRequest::Overlap::Forbidden : ProofRequest::Overlap::Reported;
  const Format* const format = written_format(request.name);
  if (format && format->has_claims) proof_request.labels = ProofRequest::FaceLabels::Compared;
  if (!file.is_complete) proof_request.coverage = ProofRequest::Coverage::Partial;
  if (request.stacked || claims.stacks) proof_request.stacks = ProofRequest::Stacks::Allowed;
  proof_request.layers = request.layers;
  proof_request.stop = stop;
  return proof_request;
}

MapProof proven(const MapFile& file, const CheckRequest& request, const Claims& claims,
                const RunRecord& record) {
  record.begin(Activity::Proving);
  return {file, request.name, questions(file, request, claims, record.telling(record.stop()))};
}

// Returns the distortion at the claimed scale, or at the best one.
Json measured_distortion(const MapFile& file) {
  const MapDistortion measured = measure_distortion(file);
  Json section = distortion_section({&measured}, layout_scale(file));
  section["scale_is_assumed"] = has_assumed_scale(file);
  return section;
}

// Returns whether the file holds an image of a map: a mesh in the plane that is the identity on
// itself.
bool is_image(const MapFile& file) {
  const auto corners = file.cells.leftCols(3).reshaped();
  return file.points(corners, 2).isZero(0) &&
         file.points(corners, Eigen::seqN(0, 2)) == file.uv(corners, Eigen::all);
}

void require_surface(const MapCheck& check, const MapFile& file, const CheckRequest& request) {
  const Format* const format = written_format(request.name);
  if (check.proof.surface.answer == ProofStatus::Violated && format && format->has_image_of_map &&
      is_image(file))
    throw Refusal(
        ErrorKind::Unsupported, request.name,
        fmt::format("{}: this is the image of a map, in the plane: there is no surface in "
                    "it to compare with {}; ",
                    request.name, request.surface->file),
        Hint::WriteSurface);
}

void add_proofs(MapCheck& check) {
  for (const auto& [question, finding] : check.proof.findings()) {
    if (finding->answer == ProofStatus::Violated)
      check.findings.add_violation(fmt::format("{}: {}", question, finding->detail));
    if (finding->answer == ProofStatus::Undecided)
      check.findings.add_open(
          fmt::format("{}: could not be decided: {}", question, finding->detail));
    check.report.result["proofs"][question] = {{"answer", name_of(finding->answer)},
                                               {"detail", finding->detail}};
  }
  const StackedCharts& stacks = check.proof.stacks;
  check.report.result["stacks"] = {
      {"stacks", stacks.stacks}, {"charts", stacks.stacked}, {"mirrored", stacks.mirrored}};
  const CutCount& cuts = check.proof.cuts;
  check.report.result["cuts"] = {{"seam_edges", cuts.seams},
                                 {"other_edges", cuts.others},
                                 {"length", cuts.length},
                                 {"charts", cuts.charts},
                                 {"told_from_tears", !check.has_untold_cuts}};
}

// Checks that the claimed charts, and no others, lie on each other, mirrored exactly if that is
// claimed.
void check_stacks(const MapFile& file, const StackedCharts& found, const Claims& claims,
                  Findings& findings) {
  std::map<Index, std::size_t> piece;  // by chart of the file
  for (Index c = 0; c < file.chart.size(); ++c) {
    const std::size_t of_cell = to_size(found.chart[to_size(c)]);
    if (piece.try_emplace(file.chart[c], of_cell).first->second != of_cell)
      return findings.add_violation(fmt::format("chart {} is in several pieces", file.chart[c]));
  }
  std::vector<char> is_claimed(found.stack.size(), 0);
  for (const ClaimedStack& stack : *claims.stacks) {
    std::optional<Index> place;
    for (const Index chart : stack.charts) {
      const auto known = piece.find(chart);
      if (known == piece.end())
        return findings.add_violation(fmt::format("there is no chart {}, of a stack", chart));
      const std::size_t k = known->second;
      if (found.stack[k] < 0 || found.stack[k] != place.value_or(found.stack[k]))
        return findings.add_violation(
            fmt::format("chart {} is claimed to lie on chart {}, and is not congruent to it, "
                        "corner by corner",
                        chart, stack.charts.front()));
      place = found.stack[k];
      is_claimed[k] = 1;
      const bool is_mirrored =
          std::find(stack.mirrored.begin(), stack.mirrored.end(), chart) != stack.mirrored.end();
      if (is_mirrored != (found.is_mirrored[k] != 0))
        return findings.add_violation(fmt::format(
            "chart {} is {}", chart,
            is_mirrored ? "claimed to be mirrored, and is not" : "mirrored, which is not claimed"));
    }
  }
  for (std::size_t k = 0; k < is_claimed.size(); ++k)
    if (found.stack[k] >= 0 && !is_claimed[k])
      return findings.add_violation("charts lie on each other that are not claimed to");
}

// Checks that the charts of the file are the continuous pieces: an edge that is not cut must not
// separate charts. An incomplete map may lack faces that connect a chart.
void check_charts(const MapFile& file, const std::string& name, Findings& findings) {
  std::map<Index, Index> piece_of, chart_of;  // by chart of the file; by piece
  const std::vector<Index> pieces = charts_of_cells(file, name);
  for (Index c = 0; c < file.chart.size(); ++c) {
    const Index piece = pieces[to_size(c)], chart = file.chart[c];
    if (const Index other = chart_of.try_emplace(piece, chart).first->second; other != chart)
      return findings.add_violation(
          fmt::format("cell {} is said to be of chart {}, and is of chart {}: no cut divides them",
                      c, chart, other));
    if (piece_of.try_emplace(chart, piece).first->second != piece && file.is_complete)
      return findings.add_violation(
          fmt::format("chart {} is in several pieces, one of them at cell {}", chart, c));
  }
}

// Checks that every chart belongs to one claimed object, and that the objects are those of the
// surface. An incomplete map may lack some.
void check_objects(const MapFile& file, const std::string& name,
                   const std::vector<ClaimedObject>& claimed, const PolygonMesh* surface,
                   Findings& findings) {
  const std::set<Index> charts(file.chart.begin(), file.chart.end());
  const auto count = std::max(std::int64_t{1}, static_cast<std::int64_t>(charts.size()));
  std::int64_t sum = 0;
  for (const ClaimedObject& object : claimed) sum += object.charts;
  if (!charts.empty() && (*charts.begin() != 0 || *charts.rbegin() + std::int64_t{1} != count)) {
    if (file.is_complete) findings.add_violation("charts are not numbered from 0 on");
    return;
  }
  if (sum != count)
    return findings.add_violation(
        fmt::format("objects are claimed to have {} charts, and there are {}", sum, count));
  if (surface == nullptr || file.input_face.size() == 0) return;
  const MeshObjects objects = objects_of(*surface);
  if (file.is_complete && claimed.size() != objects.names.size())
    return findings.add_violation(
        fmt::format("{} claimed, and the surface has {}",
                    count_text(static_cast<Index>(claimed.size()), "object"), objects.count()));
  const std::vector<Index> object = *claimed_object_of_cells(file, name);
  std::map<Index, Index> of_surface, of_claim;
  for (Index c = 0; c < file.cells.rows(); ++c) {
    const Index k = object[to_size(c)], o = objects.of_polygon[to_size(file.input_face[c])];
    const std::string& claimed_name = claimed[to_size(k)].name;
    if (claimed_name != objects.names[to_size(o)] ||
        of_surface.try_emplace(k, o).first->second != o ||
        of_claim.try_emplace(o, k).first->second != k)
      return findings.add_violation(
          fmt::format("cell {} is claimed to be of object '{}', and is of '{}' in the surface", c,
                      claimed_name, objects.names[to_size(o)]));
  }
}

// Checks that the file claims faces in other triangulations, and faces without cells, exactly if
// there are any. A polygon with more than three corners has no triangulation of its own.
void check_coverage(const PolygonMesh& surface, const MapProof& proof, const Claims& claims,
                    Findings& findings) {
  const bool has_own_triangles =
      std::all_of(surface.polygons.begin(), surface.polygons.end(),
                  [](const auto& polygon) { return polygon.size() == 3; });
  if (proof.other_triangles > 0)
    findings.require(claims.other_triangles.value_or(true),
                     "faces are in other triangles than the surface's, and none is claimed to be");
  else if (has_own_triangles)
    findings.require(!claims.other_triangles.value_or(false),
                     "faces are claimed to be in other triangles than the surface's, and none is");
  if (!claims.complete.value_or(true))
    findings.require(proof.unmapped > 0,
                     "the map is claimed to lack faces, and all of the surface's have cells");
}

// Checks the claims about charts, cuts, objects and triangles.
void check_parts(const MapFile& file, const CheckRequest& request, MapCheck& check) {
  Findings& findings = check.findings;
  const Claims& claims = check.claims;
  if (const auto& edge = check.proof.cuts.not_cut; edge && request.cuts == CheckRequest::Cuts::Auto)
    findings.add_violation(
        fmt::format("edge ({}, {}) is claimed to be cut, and is not", (*edge)[0], (*edge)[1]));
  const bool is_surface = request.surface && check.proof.surface.answer == ProofStatus::Proven;
  if (is_surface) check_coverage(*request.surface, check.proof, claims, findings);
  if (!check.proof.map()) return;
  if (file.chart.size() > 0) check_charts(file, request.name, findings);
  if (claims.objects)
    check_objects(file, request.name, *claims.objects, is_surface ? request.surface : nullptr,
                  findings);
}

// Returns the layer in which each face is tested for overlaps. Only the first chart of a stack is
// in its own layer.
std::vector<Index> layers_of(const CheckRequest& request, const StackedCharts& stacks) {
  if (!request.layers.empty() || stacks.stacks == 0) return request.layers;
  std::vector<Index> layers;
  for (const Index chart : stacks.chart)
    layers.push_back(stacks.is_first[to_size(chart)] ? -1 : chart);
  return layers;
}

void measure_overlap(MapCheck& check, const CheckRequest& request, const StopCheck& stop) {
  const MapProof& proof = check.proof;
  if (!proof.map() || !proof.global || proof.global->result != ProofStatus::Violated) return;
  if (image_of(*proof.map()) == ImageOf::CutAtSeams) return;
  try {
    check.overlap = overlap_extent(*proof.map(), layers_of(request, proof.stacks), stop);
  } catch (const Stopped&) {
    return;  // measures do not affect the verdict
  }
  if (check.overlap)
    check.report.result["overlap"] = {{"faces", check.overlap->faces},
                                      {"share", check.overlap->share}};
}

// Adds the measures of the map and of its claims.
void add_measures(MapCheck& check, const MapFile& file, const CheckRequest& request,
                  const StopCheck& stop) {
  if (!check.proof.map()) return;
  const BezierMap& map = *check.proof.map();
  check.measures.emplace();
  check.energy = measure_as_claimed(file, map, check.claims, stop, check.findings, *check.measures);
  Json result = measures_section(map, *check.measures, check.energy.name);
  add_energy(check.energy, result);
  if (check.proof.global) add_global_injectivity(result, map, *check.measures, *check.proof.global);
  if (!check.measures->cut_short && request.reported)
    result["distortion"] = measured_distortion(file);
  check.report.result.update(result);
  // the claims belong to another mesh
  if (check.proof.surface.answer == ProofStatus::Violated) return;
  check_claims({file, map, *check.measures, check.claims, request.surface, check.proof.cuts},
               check.findings);
}

}  // namespace

MapCheck::MapCheck(const MapFile& file, const CheckRequest& request, const RunRecord& record)
    : claims(parse_claims(file.claims, request.name)),
      report{.command = "check", .status = "undecided", .input = {{"file", request.name}}},
      proof(proven(file, request, claims, record)) {
  require_surface(*this, file, request);
  has_untold_cuts =
      proof.cuts.others > 0 && request.cuts == CheckRequest::Cuts::Auto && is_untold(file, claims);
  add_proofs(*this);
  record.begin(Activity::Measuring);
  if (proof.stacks.mirrored == 0) {
    add_measures(*this, file, request, record.telling(record.stop()));
  } else {
    add_measures(*this, turned_back(file, proof.stacks), request, record.telling(record.stop()));
  }
  measure_overlap(*this, request, record.stop());
  if (claims.stacks && proof.map()) check_stacks(file, proof.stacks, claims, findings);
  check_parts(file, request, *this);
  const std::vector<std::string>& list = findings.list();
  report.status = status();
  report.message = list.empty() ? "" : list.front();
  report.result["findings"] = list;
  std::vector<std::string> warnings = file.warnings;
  if (request.surface)
    warnings.insert(warnings.end(), request.surface->warnings.begin(),
                    request.surface->warnings.end());
  report.warnings = warnings;
}

std::string MapCheck::overlap_in_words() const {
  if (!overlap || overlap->faces == 0) return {};
  return fmt::format(", {} of {} faces lie on others, {:.3g} % of the layout", overlap->faces,
                     proof.map()->mesh().face_count(), 100 * overlap->share);
}

std::string_view MapCheck::status() const {
  if (findings.list().empty()) return "valid";
  return findings.violated() ? "invalid" : "undecided";
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
