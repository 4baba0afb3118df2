#include "apps/mpi/parts_report.h"

#include <limits>

#include "apps/mpi/internal/collect.h"
#include "apps/mpi/processes.h"
#include "majorant/apps/jobs/global_verdict.h"

namespace majorant::app {
namespace {

Json boundary_section(const GlobalInjectivity& proof) {
  return {{"pairs_tested", proof.pairs_tested},
          {"pairs_left", proof.pairs_left},
          {"subdivisions", proof.subdivisions},
          {"reason", proof.reason},
          {"contacts", proof.contacts.size()}};
}

Json result_section(const PartsRun& run, GlobalIndex control_points, double least_det) {
  const ParametrizationResult& r = run.result;
  const MapMeasures& m = r.measures;
  Json section = measures_section({r.map->degree(), control_points}, m, least_det, run.job.energy);
  section.update(overlap_section(run.boundary, ImageOf::Surface, m));
  section.update({{"boundary", boundary_section(run.boundary)},
                  {"start", run.start},
                  {"variables", r.variables},
                  {"initial_value", r.initial_value},
                  {"value_quadrature", r.value_quadrature},
                  {"newton_decrement", r.newton_decrement},
                  {"handle_distance", r.handle_distance}});
  return section;
}

}  // namespace

RunReport parts_report(const PartsRun& run) {
  const MeshPart& part = run.part;
  const auto nodes = part.unknowns(run.result.map->space());
  double shared = 0;
  for (const auto& n : nodes->neighbours()) shared += static_cast<double>(n.owned.size() / 2);
  const Traffic sent = traffic();
  const Vec& min_det = run.result.measures.min_det;
  const double least_det = part.ranks().min(
      min_det.size() > 0 ? min_det.minCoeff() : std::numeric_limits<double>::infinity());
  const auto all = gathered(part.ranks(), {static_cast<double>(part.mesh->face_count()),
                                           static_cast<double>(nodes->owned_size() / 2), shared,
                                           static_cast<double>(peak_memory_bytes()), sent.messages,
                                           sent.bytes, sent.reductions});
  if (part.ranks().rank() > 0) return {};
  Json ranks = Json::array();
  for (const auto& r : all)
    ranks.push_back({{"faces", static_cast<long>(r[0])},
                     {"nodes", static_cast<long>(r[1])},
                     {"shared_nodes", static_cast<long>(r[2])},
                     {"peak_memory_bytes", static_cast<long>(r[3])},
                     {"messages", static_cast<long>(r[4])},
                     {"message_bytes", static_cast<long>(r[5])},
                     {"reductions", static_cast<long>(r[6])}});
  const ParametrizationResult& r = run.result;
  RunReport report{.command = std::string(task_name(run.job.task)),
                   .status = std::string(status_name(r.status)),
                   .message = r.message,
                   .input = {{"file", run.file},
                             {"vertices", part.whole.vertices},
                             {"edges", part.whole.edges},
                             {"faces", part.whole.faces}},
                   .options = run.job.options_json,
                   .result = result_section(run, nodes->global_size() / 2, least_det),
                   .seconds = {{"read", run.job.read_seconds},
                               {"divide", run.divide_seconds},
                               {"initialize", run.initialize_seconds},
                               {"optimize", r.optimize_seconds},
                               {"measure", r.measure_seconds}}};
  report.more = {{"iterations", iterations_section(run.job.record.trace())},
                 {"injectivity_tests", {{"depth", r.injectivity_tests}}},
                 {"remedies", remedies_section(r.remedies)},
                 {"linear_solver", run.job.linear_solver},
                 {"ranks", ranks},
                 {"checkpoint", run.checkpoint},
                 {"resumed", run.resumed},
                 {"vector_instructions", vector_instructions()}};
  return report;
}

std::string parts_claims(const PartsRun& run) {
  return json_text(without_folders({{"version", MAJORANT_VERSION},
                                    {"degree", run.result.map->degree()},
                                    {"energy", run.job.energy},
                                    {"value", run.result.measures.value},
                                    {"boundary", run.job.options_json["boundary"]},
                                    {"init", run.start},
                                    {"seams", false},
                                    {"bijective", false},
                                    {"cuts", Json::array()},
                                    {"options", run.job.options_json}}));
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
