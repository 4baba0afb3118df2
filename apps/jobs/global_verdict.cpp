#include "majorant/apps/jobs/global_verdict.h"

#include <fmt/format.h>

#include <array>

namespace majorant {
namespace {

std::string near(const Vector2& uv) { return fmt::format("near ({:.6g}, {:.6g})", uv.x(), uv.y()); }

std::string what_is_open(const GlobalInjectivity& proof) {
  std::string text = "whether it overlaps itself is not decided";
  if (!proof.reason.empty()) text += ": " + proof.reason;
  if (!proof.contacts.empty())
    text += (proof.reason.empty() ? ": " : ", ") + std::string("its boundary may meet itself ") +
            near(proof.contacts.front().where);
  return text;
}

std::string local_words(const MapMeasures& measures) {
  if (measures.locally_injective) return "locally injective";
  return measures.sigma_min < 0 ? "not locally injective" : "not proven to be locally injective";
}

// local: the proof that the map is injective at every point.
std::string overlap_words(const GlobalInjectivity& proof, ImageOf image, const std::string& local) {
  if (proof.result == ProofStatus::Proven) return "no overlaps";
  const bool violated = proof.result == ProofStatus::Violated;
  const std::string found = violated ? meeting_words(proof) : what_is_open(proof);
  if (image == ImageOf::Charts) return "each chart without overlaps, the layout " + found;
  if (image == ImageOf::CutAtSeams)
    return local + ", cut open along its seams it " + found +
           (violated ? ", as maps with cones may" : "");
  return local + ", " + found;
}

}  // namespace

ImageOf image_of(const BezierMap& map) {
  return map.seams().trivial() ? ImageOf::Surface : ImageOf::CutAtSeams;
}

std::string overlap_words(const GlobalInjectivity& proof, ImageOf image) {
  return overlap_words(proof, image, "locally injective");
}

Json overlap_section(const GlobalInjectivity& proof, ImageOf image, const MapMeasures& measures) {
  if (proof.result == ProofStatus::Violated)
    return {{"globally_injective", false},
            {"overlaps", overlap_words(proof, image, local_words(measures))}};
  if (!measures.locally_injective)
    return {{"globally_injective", nullptr},
            {"overlaps", "not decided: the map is " + local_words(measures)}};
  Json injective;  // null: not decided
  if (proof.result == ProofStatus::Proven) injective = true;
  return {{"globally_injective", injective}, {"overlaps", overlap_words(proof, image)}};
}

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
                        {"certain", c.apart == ProofStatus::Violated}});
  Json covered_twice;
  if (proof.covered_twice) covered_twice = {proof.covered_twice->x(), proof.covered_twice->y()};
  measures_section.update(overlap_section(proof, image_of(map), measures));
  measures_section["boundary"] = {
      {"pairs_tested", proof.pairs_tested},
      {"pairs_left", proof.pairs_left},
      {"subdivisions", proof.subdivisions},
      {"reason", proof.reason},
      {"covered_twice", covered_twice},
      {"contacts", contacts},
      {"contacts_complete", proof.pairs_left == 0 && proof.contacts.size() < kMaxContacts}};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
