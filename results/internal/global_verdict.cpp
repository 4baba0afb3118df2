#include "majorant/results/internal/global_verdict.h"

#include <array>

namespace majorant {

void add_global_injectivity(Json& measures_section, const BezierMap& map,
                            const MapMeasures& measures, const GlobalInjectivity& proof) {
  const SurfaceMesh& mesh = map.mesh();
  const auto edge = [&](Index h) {
    return std::array{mesh.input_vertex(mesh.from_vertex(h)), mesh.input_vertex(mesh.to_vertex(h))};
  };
  Json contacts = Json::array();
  for (const BoundaryContact& c : proof.contacts)
    contacts.push_back({{"edges", {edge(c.half_edge_a), edge(c.half_edge_b)}},
                        {"uv", {c.where.x(), c.where.y()}},
                        {"certain", c.kind == Contact::Certain}});
  const bool locally = measures.min_det.size() > 0 && measures.min_det.minCoeff() > 0;
  Json injective;  // null: not decided
  if (proof.result == Injectivity::Violated) injective = false;
  if (proof.result == Injectivity::Proven && locally) injective = true;
  measures_section["globally_injective"] = injective;
  measures_section["boundary"] = {{"pairs_tested", proof.pairs_tested},
                                  {"pairs_left", proof.pairs_left},
                                  {"subdivisions", proof.subdivisions},
                                  {"reason", proof.reason},
                                  {"contacts", contacts}};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
