#include "apps/global_verdict.h"

#include <fmt/format.h>

#include <array>
#include <chrono>

namespace majorant::app {
namespace {

using Edge = std::array<Index, 2>;  // vertices of the input

// "boundary edges (12, 13) and (40, 41) meet near (0.25, 1.5)".
std::string in_words(const BoundaryContact& contact, const Edge& a, const Edge& b) {
  const bool certain = contact.kind == Contact::Certain;
  const std::string place =
      fmt::format("near ({:.9g}, {:.9g})", contact.where.x(), contact.where.y());
  if (contact.half_edge_a == contact.half_edge_b)
    return fmt::format("boundary edge ({}, {}) {} itself {}", a[0], a[1],
                       certain ? "meets" : "may meet", place);
  return fmt::format("boundary edges ({}, {}) and ({}, {}) {} {}", a[0], a[1], b[0], b[1],
                     certain ? "meet" : "may meet", place);
}

}  // namespace

void GlobalVerdict::add_to(Json& measures_section) const {
  measures_section["globally_injective"] = injective;
  measures_section["boundary"] = boundary;
}

CornerNames vertices_of(const BezierMap& map) {
  return [&mesh = map.mesh()](Index face, Index corner) {
    return mesh.input_vertex(mesh.faces()(face, corner));
  };
}

CornerNames vertices_of(const MapFile& file) {
  return [&file](Index face, Index corner) {
    const Index point = file.cells(face, corner);
    const bool known = file.input_vertex.size() > point && file.input_vertex[point] >= 0;
    return known ? file.input_vertex[point] : point;
  };
}

GlobalVerdict judge_global_injectivity(const BezierMap& map, const MapMeasures& measures,
                                       const CornerNames& input_vertex) {
  const auto start = std::chrono::steady_clock::now();
  const GlobalInjectivity proof = check_boundary(map);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto edge = [&](Index half_edge) {
    const Index face = half_edge / 3, corner = half_edge % 3;
    return Edge{input_vertex(face, corner), input_vertex(face, (corner + 1) % 3)};
  };
  std::string reason = proof.reason;
  Json contacts = Json::array();
  for (const BoundaryContact& c : proof.contacts) {
    const Edge a = edge(c.half_edge_a), b = edge(c.half_edge_b);
    if (contacts.empty()) reason = in_words(c, a, b);
    contacts.push_back({{"edges", {a, b}},
                        {"uv", {c.where.x(), c.where.y()}},
                        {"certain", c.kind == Contact::Certain}});
  }
  GlobalVerdict verdict;
  verdict.boundary = {
      {"pairs_tested", proof.pairs_tested}, {"contacts", contacts}, {"seconds", seconds}};
  if (proof.result == Injectivity::Violated) {
    verdict.injective = false;
    verdict.finding = "the map is not globally injective: " + reason;
    return verdict;
  }
  const bool locally = measures.min_det.size() > 0 && measures.min_det.minCoeff() > 0;
  if (proof.result == Injectivity::Proven && locally) {
    verdict.injective = true;
    return verdict;
  }
  verdict.finding = "global injectivity could not be decided: " +
                    (locally ? reason : "det J is not proven positive on every face");
  return verdict;
}

}  // namespace majorant::app
