#include "distributed/checkpoint.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "distributed/internal/collect.h"
#include "distributed/internal/part_data.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/stopwatch.h"
#include "majorant/parametrization/maps/quadrature_ladder.h"

namespace majorant {
namespace {

// Of a face, its first nodes: a triangle's.
constexpr Index kCorners = 3;

Json to_json(const PartState& state) {
  Json remedies = Json::array();
  for (const RemedyUse& use : state.solver.remedies)
    remedies.push_back({{"runs", use.runs}, {"gained", use.gained}});
  Json initial;  // null: not finite
  if (std::isfinite(state.initial_value)) initial = state.initial_value;
  return {{"entering", state.entering},
          {"initial_value", initial},
          {"softened", state.solver.softened},
          {"stalls", state.solver.stalls},
          {"refinements", state.solver.refinements},
          {"barrier_followed", state.solver.barrier_followed},
          {"depth", state.solver.depth},
          {"remedies", remedies}};
}

// Of all but the points and the levels.
PartState from_json(const HeaderReader& told) {
  constexpr int kMany = std::numeric_limits<int>::max();
  const auto count = [&](const HeaderReader& in, const char* key, int most) {
    return static_cast<int>(in.integer(key, 0, most));
  };
  PartState state;
  state.entering = told.flag("entering");
  state.initial_value = told.at("initial_value").is_null() ? std::numeric_limits<double>::infinity()
                                                           : told.finite("initial_value");
  state.solver.softened = told.flag("softened");
  state.solver.stalls = count(told, "stalls", kMany);
  state.solver.refinements = count(told, "refinements", kMany);
  state.solver.barrier_followed = told.flag("barrier_followed");
  state.solver.depth = count(told, "depth", LocalInjectivity::kMaxDepth);
  const HeaderReader remedies = told["remedies"];
  for (std::size_t k = 0; k < state.solver.remedies.size(); ++k)
    state.solver.remedies[k] = {count(remedies[k], "runs", kMany), remedies[k].finite("gained")};
  return state;
}

// Of every face the numbers of its control points but the corners'.
Index others_of(int degree) { return 2 * ((degree + 1) * (degree + 2) / 2 - kCorners); }

// Calls visit(place in the numbers of the faces, node) for these points.
template <class Visit>
void for_each_other(const BezierTriangleSpace& space, const Visit& visit) {
  Index place = 0;
  for (Index f = 0; f < space.element_count(); ++f)
    for (Index k = kCorners; k < space.cells().cols(); ++k, place += 2)
      visit(place, space.cells()(f, k));
}

}  // namespace

CheckpointWriter::CheckpointWriter(std::string path, std::shared_ptr<const MeshPart> part,
                                   const Vec& start, Json about)
    : path_(std::move(path)),
      part_(std::move(part)),
      start_(whole_of_vertices(*part_, start, 2)),
      about_(std::move(about)) {}

void CheckpointWriter::write(const PartState& state, double seconds_of_run) {
  const AddedSeconds time(seconds_);
  const MeshPart& part = *part_;
  const Index width = others_of(state.space->degree());
  Vec others(width * part.mesh->face_count()), levels = Vec::Zero(part.mesh->face_count());
  for_each_other(*state.space, [&](Index place, Index node) {
    others.segment<2>(place) = state.x.segment<2>(2 * node);
  });
  for (std::size_t f = 0; f < state.solver.levels.size(); ++f)
    levels[static_cast<Index>(f)] = state.solver.levels[f];
  CheckpointFile file;
  file.vertex_points = whole_of_vertices(part, state.x.head(2 * part.mesh->vertex_count()), 2);
  file.other_points = whole_of_faces(part, others, width);
  levels = whole_of_faces(part, levels, 1);
  if (part.ranks().rank() > 0) return;
  file.levels.assign(levels.begin(), levels.end());
  file.header = about_;
  file.header["vertices"] = part.whole.vertices;
  file.header["faces"] = part.whole.faces;
  file.header["degree"] = state.space->degree();
  file.header["ranks"] = part.ranks().count();
  file.header["iterations"] = about_.value("iterations", std::int64_t{0}) + state.iterations;
  file.header["seconds"] = about_.value("seconds", 0.0) + seconds_of_run;
  file.header["state"] = to_json(state);
  file.start = start_;
  try {
    write_checkpoint_file(path_, file);
    ++written_;
    failure_.clear();
  } catch (const Error& e) {
    failure_ = e.what();
  }
}

std::string fingerprint(const SurfaceMesh& mesh) {
  const Points3& positions = mesh.positions();
  const Cells& faces = mesh.faces();
  std::uint64_t hash = hashed(
      std::as_bytes(std::span(positions.data(), static_cast<std::size_t>(positions.size()))));
  hash =
      hashed(std::as_bytes(std::span(faces.data(), static_cast<std::size_t>(faces.size()))), hash);
  return fmt::format("{:016x}", hash);
}

void require_state(const std::string& path, const CheckpointFile& file, int quadrature_points) {
  const HeaderReader header(path, file.header);
  from_json(header["state"]);
  const int degree = file.header.at("degree");
  const int top = optimizer_ladder(degree, quadrature_points).top();
  for (const std::uint8_t level : file.levels)
    if (level > top)
      refuse_checkpoint(
          path, fmt::format("it has faces at level {} of {} of the quadrature", level, top));
}

PartState state_of(const MeshPart& part, const CheckpointFile& file) {
  const Ranks& ranks = part.ranks();
  const Json header =
      Json::parse(broadcast(ranks, ranks.rank() == 0 ? file.header.dump() : std::string()));
  PartState state = from_json(HeaderReader("checkpoint", header)["state"]);
  const int degree = header.at("degree");
  state.space = std::make_shared<const BezierTriangleSpace>(part.mesh->faces(),
                                                            part.mesh->vertex_count(), degree);
  state.x.resize(2 * state.space->node_count());
  state.x.head(2 * part.mesh->vertex_count()) = of_vertices(part, file.vertex_points, 2);
  const Vec others = of_faces(part, file.other_points, others_of(degree));
  for_each_other(*state.space, [&](Index place, Index node) {
    state.x.segment<2>(2 * node) = others.segment<2>(place);
  });
  const Vec levels = of_faces(part,
                              Eigen::Map<const Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 1>>(
                                  file.levels.data(), static_cast<Index>(file.levels.size()))
                                  .cast<double>(),
                              1);
  for (const double level : levels) state.solver.levels.push_back(static_cast<RuleId>(level));
  return state;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
