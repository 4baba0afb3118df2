#include "majorant/apps/jobs/volume_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace majorant {

std::string elements_in_words(const VolumeMesh& mesh) {
  std::string text;
  for (const CellBlock& block : mesh.blocks)
    if (dimension(block.type.shape) == mesh.dimension())
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", block.size(), describe(block.type));
  return text;
}

std::string name_of(const VolumeMesh& mesh, CellName name) {
  const CellBlock& block = mesh.blocks[to_size(name.block)];
  return fmt::format("{}", block.numbers[to_size(name.cell)]);
}

const char* status_of(const VolumeCheck& check) {
  if (check.invalid() > 0 || !check.sides_fit()) return "invalid";
  return check.undecided() > 0 ? "undecided" : "valid";
}

std::string faults_in_words(const VolumeMesh& mesh, const VolumeCheck& check) {
  std::vector<std::string> faults;
  const auto count = static_cast<Index>(check.cells.size());
  if (check.inverted() == count)
    faults.push_back(
        fmt::format("all {} elements are turned around, det J < 0 all over them; mesh optimize "
                    "turns them",
                    count));
  else if (check.invalid() > 0)
    faults.push_back(fmt::format(
        "{} of {} elements have det J <= 0 somewhere{}", check.invalid(), count,
        check.inverted() > 0 ? fmt::format(", {} of them everywhere", check.inverted()) : ""));
  if (check.undecided() > 0)
    faults.push_back(fmt::format("{} of {} elements are not decided", check.undecided(), count));
  if (!check.disagreements.empty()) {
    const Disagreement& first = check.disagreements.front();
    faults.push_back(
        fmt::format("{} shared side{} not the same in both elements, first of {} and {}",
                    check.disagreements.size(), check.disagreements.size() == 1 ? " is" : "s are",
                    name_of(mesh, first.first), name_of(mesh, first.second)));
  }
  if (!check.crowded.empty())
    faults.push_back(fmt::format(
        "{} side{} more than two elements, first of {}", check.crowded.size(),
        check.crowded.size() == 1 ? " has" : "s have", name_of(mesh, check.crowded.front())));
  if (!check.repeated.empty()) {
    const Disagreement& first = check.repeated.front();
    faults.push_back(fmt::format("{} element{} listed twice, first {}, which is {}",
                                 check.repeated.size(),
                                 check.repeated.size() == 1 ? " is" : "s are",
                                 name_of(mesh, first.second), name_of(mesh, first.first)));
  }
  if (!check.overlapping.empty()) {
    const Disagreement& first = check.overlapping.front();
    faults.push_back(
        fmt::format("{} shared side{} both elements on one side, which overlap, first {} and {}",
                    check.overlapping.size(), check.overlapping.size() == 1 ? " has" : "s have",
                    name_of(mesh, first.first), name_of(mesh, first.second)));
  }
  return fmt::format("{}", fmt::join(faults, "; "));
}

std::string periodic_in_words(const VolumeCheck& check) {
  if (check.periodic_sides == 0) return "";
  return fmt::format("; {} shared side{} the same up to a translation (a periodic mesh)",
                     check.periodic_sides, check.periodic_sides == 1 ? " is" : "s are");
}

Extremes extremes_of(const VolumeCheck& check) {
  Extremes all;
  for (const CheckedCell& cell : check.cells) {
    all.low = std::min(all.low, cell.range.low);
    all.high = std::min(all.high, cell.range.high);
    all.largest = std::max(all.largest, cell.range.largest);
  }
  return all;
}

std::string element_in_words(const VolumeMesh& mesh, const CheckedCell& cell) {
  const CellBlock& block = mesh.blocks[to_size(cell.name.block)];
  const Vector3 place = place_of(mesh, cell);
  return fmt::format(
      "element {} ({}, region {}): min det J in [{:.6g}, {:.6g}] at ({:.6g}, {:.6g}, {:.6g}), "
      "scaled Jacobian {:.4g}{}",
      name_of(mesh, cell.name), plural_of(block.type.shape), block.regions[to_size(cell.name.cell)],
      cell.range.low, cell.range.high, place.x(), place.y(), place.z(), cell.scaled_jacobian,
      cell.range.positive == ProofStatus::Undecided ? ", undecided" : "");
}

std::string bad_elements_in_words(const VolumeMesh& mesh, const VolumeCheck& check, int listed) {
  std::string text;
  for (const CheckedCell* cell : check.worst(to_size(listed))) {
    if (cell->range.positive == ProofStatus::Proven) break;
    text += fmt::format("  {}\n", element_in_words(mesh, *cell));
  }
  return text;
}

namespace {

Json element_section(const VolumeMesh& mesh, const CheckedCell& cell) {
  const CellBlock& block = mesh.blocks[to_size(cell.name.block)];
  const Vector3 place = place_of(mesh, cell);
  const char* const answer = cell.range.positive == ProofStatus::Proven     ? "valid"
                             : cell.range.positive == ProofStatus::Violated ? "invalid"
                                                                            : "undecided";
  return {{"element", block.numbers[to_size(cell.name.cell)]},
          {"type", std::string(plural_of(block.type.shape))},
          {"region", block.regions[to_size(cell.name.cell)]},
          {"verdict", answer},
          {"min_det", {cell.range.low, cell.range.high}},
          {"max_det", {cell.range.largest_low, cell.range.largest}},
          {"scaled_jacobian", cell.scaled_jacobian},
          {"at", {place.x(), place.y(), place.z()}}};
}

}  // namespace

Json mesh_section(const VolumeMesh& mesh, const VolumeCheck& check, int listed) {
  std::map<std::string, Index> elements;
  std::set<int> orders;
  for (const CellBlock& block : mesh.blocks) {
    elements[std::string(plural_of(block.type.shape))] += block.size();
    if (dimension(block.type.shape) == mesh.dimension()) orders.insert(block.type.degree);
  }
  Json worst = Json::array();
  for (const CheckedCell* cell : check.worst(to_size(listed)))
    worst.push_back(element_section(mesh, *cell));
  const auto number = [&](CellName name) {
    return mesh.blocks[to_size(name.block)].numbers[to_size(name.cell)];
  };
  const auto pairs = [&](const std::vector<Disagreement>& of) {
    Json list = Json::array();
    for (const Disagreement& d : of) {
      if (list.size() == to_size(listed)) break;
      list.push_back({number(d.first), number(d.second)});
    }
    return list;
  };
  const Extremes all = extremes_of(check);
  return {{"elements", elements},
          {"orders", orders},
          {"checked", check.cells.size()},
          {"valid", check.count(ProofStatus::Proven)},
          {"invalid", check.invalid()},
          {"undecided", check.undecided()},
          {"inverted", check.inverted()},
          {"disagreeing_sides", check.disagreements.size()},
          {"crowded_sides", check.crowded.size()},
          {"overlapping_sides", check.overlapping.size()},
          {"repeated_elements", check.repeated.size()},
          {"periodic_sides", check.periodic_sides},
          {"boundary_sides", check.boundary_sides},
          {"min_det", {all.low, all.high}},
          {"max_det", all.largest},
          {"min_scaled_jacobian", check.least_scaled_jacobian()},
          {"mean_scaled_jacobian", check.mean_scaled_jacobian()},
          {"worst", worst},
          {"disagreements", pairs(check.disagreements)},
          {"overlapping", pairs(check.overlapping)},
          {"repeated", pairs(check.repeated)}};
}

RunReport volume_check_report(const VolumeMesh& mesh, const VolumeCheck& check, int listed) {
  const std::string faults = faults_in_words(mesh, check);
  return {.command = "mesh check",
          .status = status_of(check),
          .message = faults.empty() ? "det J > 0 all over" : faults,
          .input = {{"file", mesh.file}, {"points", mesh.points.rows()}},
          .result = {{"mesh", mesh_section(mesh, check, listed)}}};
}

RunReport optimized_mesh_report(const VolumeMesh& mesh, const VolumeResult& result,
                                const RunRecord& record, int listed) {
  Json section = mesh_section(mesh, result.after, listed);
  section["moved_nodes"] = result.moved_nodes;
  section["largest_displacement"] = result.largest_displacement;
  section["held_sides"] = result.held_sides;
  section["curved_sides"] = result.curved_sides;
  section["impossible"] = Json::array();
  for (const CellName& name : result.impossible)
    section["impossible"].push_back(mesh.blocks[to_size(name.block)].numbers[to_size(name.cell)]);
  RunReport report{.command = "mesh optimize",
                   .status = std::string(status_name(result.status)),
                   .message = result.message,
                   .input = {{"file", mesh.file},
                             {"points", mesh.points.rows()},
                             {"invalid", result.before.invalid()},
                             {"undecided", result.before.undecided()},
                             {"min_scaled_jacobian", result.before.least_scaled_jacobian()},
                             {"mean_scaled_jacobian", result.before.mean_scaled_jacobian()}},
                   .result = {{"variables", result.unknowns},
                              {"value", result.value},
                              {"initial_value", result.initial_value},
                              {"untangling_iterations", result.untangling_iterations},
                              {"mesh", section}},
                   .seconds = {{"total", record.seconds()}}};
  report.more["iterations"] = iterations_section(record.trace());
  return report;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
