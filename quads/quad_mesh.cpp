#include "majorant/quads/quad_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/files/available_memory.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/internal/border.h"
#include "majorant/quads/internal/feature_choices.h"
#include "majorant/quads/internal/infeasibility.h"
#include "majorant/quads/internal/placed_quads.h"
#include "majorant/quads/internal/quad_attempts.h"
#include "majorant/quads/internal/quantization_search.h"
#include "majorant/quads/internal/timed.h"
#include "majorant/quads/internal/traced_map.h"

namespace majorant {
namespace {

double requested_count(const SurfaceMesh& mesh, const QuadMeshOptions& options) {
  if (options.edge_length) return mesh.area() / *options.edge_length / *options.edge_length;
  return static_cast<double>(options.count.value_or(std::max(mesh.face_count() / 2, 1)));
}

void require_usable_size(const QuadMeshOptions& options) {
  if (options.count && options.edge_length)
    throw InvalidArgument("quad_mesh: both a count and an edge length");
  if (options.count && *options.count < 1)
    throw InvalidArgument(fmt::format("quad_mesh: {} quads", *options.count));
  if (options.edge_length && !(*options.edge_length > 0 && std::isfinite(*options.edge_length)))
    throw InvalidArgument(fmt::format("quad_mesh: edges of length {}", *options.edge_length));
}

double bytes_of(double quads) { return quads * static_cast<double>(kBytesOfQuad); }

// Returns whether so many quads fit into the available memory.
bool fits_into_memory(double quads) {
  const std::optional<std::size_t> available = available_memory();
  return !available || bytes_of(quads) <= static_cast<double>(*available);
}

void require_usable(const SurfaceMesh& mesh, const QuadMeshOptions& options) {
  require_usable_size(options);
  if (mesh.topology().components != 1)
    throw InvalidArgument("quad_mesh: the surface has several components");
  if (mesh.topology().boundary_loops > 0 && options.map.cones)
    throw Error(ErrorKind::Unsupported,
                message_prefix(mesh) +
                    "the surface has a border, where cones are those of the field that follows it; "
                    "leave them out");
  if (options.first_degree < 1 || options.last_degree < options.first_degree ||
      options.last_degree > BezierTriangleSpace::kMaxDegree)
    throw InvalidArgument(fmt::format("quad_mesh: degrees {} to {} are not some of 1..{}",
                                      options.first_degree, options.last_degree,
                                      BezierTriangleSpace::kMaxDegree));
  if (!(options.border_turn > 0 && options.border_turn <= 180))
    throw InvalidArgument(
        fmt::format("quad_mesh: a border turn of {} degrees", options.border_turn));
  if (options.features && !options.features->empty() &&
      options.features->size() != to_size(mesh.half_edge_count()))
    throw InvalidArgument("quad_mesh: features must have 3 #F entries");
  if (options.features && options.map.cones && has_any(*options.features))
    throw Error(ErrorKind::Unsupported,
                message_prefix(mesh) +
                    "there are features, where cones are those of the field that "
                    "follows them; leave one of both out");
  require_memory_for_quads(mesh, options);
}

// The attempts with one choice of features: quads of different quantizations of one traced map.
class QuadAttempts {
 public:
  // The arguments must outlive this.
  QuadAttempts(const SurfaceMesh& mesh, const std::vector<char>& features, double max_count,
               const QuadMeshOptions& options, RunRecord& record, QuadSeconds& seconds)
      : mesh_(mesh),
        max_count_(max_count),
        options_(options),
        record_(record),
        seconds_(seconds),
        requested_(requested_count(mesh, options)),
        traced_(traced_map(mesh, features, options, record, seconds)),
        placer_(mesh, features, *traced_, options, record, seconds) {}

  // Returns the first of these quads with a close count, else those with the closest one. Throws
  // Error(Infeasible) if there are none.
  QuadMesh first_of(const std::vector<QuadAttempt>& attempts) {
    std::optional<QuadMesh> best;
    std::optional<std::string> first_failure;
    std::string remedy = "ask for more of them";
    int count = 0;
    for (const QuadAttempt& attempt : attempts) {
      if (!is_worth_trying(attempt, best)) continue;
      if (++count > 1) record_.begin_pass();
      record_.begin(Activity::Solving);
      std::optional<std::string> failure = infeasibility([&] {
        if (auto made = quads_of(attempt, best)) best = std::move(made);
      });
      if (!first_failure) first_failure = std::move(failure);
      if (!best || attempt.purpose != AttemptPurpose::Suggested) continue;
      best.reset();
      remedy = fmt::format("ask for {:.4g} times as many, {} for {}", attempt.factor,
                           std::lround(attempt.factor * requested_), std::lround(requested_));
      break;
    }
    if (best) return *std::move(best);
    throw Error(ErrorKind::Infeasible,
                fmt::format("{}no valid quads were made: {}; {}", message_prefix(mesh_),
                            first_failure.value_or(""), remedy));
  }

 private:
  double deviation(long count) const {
    return std::abs(static_cast<double>(count) / requested_ - 1);
  }

  bool is_worth_trying(const QuadAttempt& attempt, const std::optional<QuadMesh>& best) const {
    const double count = attempt.factor * requested_;
    if (attempt.purpose == AttemptPurpose::Growing && !fits_into_memory(count)) return false;
    if (!best) return true;
    if (options_.edge_length) return false;
    if (attempt.purpose == AttemptPurpose::Growing) return count < best->check.count;
    return attempt.purpose == AttemptPurpose::Close && deviation(best->check.count) > kCountClose &&
           best->least_count != best->check.count;
  }

  template <class Find>
  std::vector<Index> quantization(const std::string& goal, ArcLengths lengths, const Find& find) {
    return timed(seconds_.quantize, [&] {
      record_.announce("whole numbers for " + goal);
      QuantizationSearch search(traced_->lattice, traced_->t_mesh, lengths, record_.start_stop());
      std::vector<Index> edges = find(search);
      record_.announce(fmt::format("{} quads", quad_count(traced_->t_mesh, edges)));
      return edges;
    });
  }

  std::vector<Index> quantization_of(const QuadAttempt& attempt) {
    const double count = attempt.factor * requested_;
    return quantization(fmt::format("{} quads", std::lround(count)), attempt.lengths,
                        [&](QuantizationSearch& search) {
                          return options_.edge_length
                                     ? search.at(*options_.edge_length / traced_->lattice.unit() /
                                                 std::sqrt(attempt.factor))
                                     : search.for_count(count);
                        });
  }

  // Returns nothing if the quads would be no closer to the requested count than the best ones.
  // Throws Error(Infeasible) if they are too many or not valid.
  std::optional<QuadMesh> quads_of(const QuadAttempt& attempt,
                                   const std::optional<QuadMesh>& best) {
    const std::vector<Index> edges = quantization_of(attempt);
    const long count = quad_count(traced_->t_mesh, edges);
    if (static_cast<double>(count) > max_count_)
      throw Error(ErrorKind::Infeasible,
                  fmt::format("{}{} quads at least", message_prefix(mesh_), count));
    if (best && deviation(count) >= deviation(best->check.count)) return std::nullopt;
    const auto [known, is_new] = failures_.try_emplace(edges);
    if (!is_new) throw Error(ErrorKind::Infeasible, known->second);
    // If the count is far off, better angles are not worth the time of higher degrees.
    const int degree = deviation(count) <= kCountClose || options_.edge_length
                           ? options_.last_degree
                           : options_.first_degree;
    std::optional<PlacedQuads> placed;
    if (std::optional<std::string> failure =
            infeasibility([&] { placed = placer_.place(edges, degree); })) {
      known->second = *std::move(failure);
      throw Error(ErrorKind::Infeasible, known->second);
    }
    return finished(*std::move(placed));
  }

  QuadMesh finished(PlacedQuads placed) {
    QuadMesh result;
    result.status = traced_->aligned.status;
    for (const TNode& node : traced_->t_mesh.nodes)
      result.cones += node.is_cone() && node.side != Side::Border;
    result.requested = std::lround(requested_);
    result.quads = std::move(placed.quads);
    result.patch_of = std::move(placed.patch_of);
    result.feature_edges = std::move(placed.feature_edges);
    result.check = std::move(placed.check);
    result.patches = placed.patches;
    result.placed = placed.placed;
    result.degree = placed.degree;
    if (static_cast<double>(result.check.count) <= (1 + kCountClose) * requested_) return result;
    const std::vector<Index> fewest =
        quantization("as few quads as possible", ArcLengths::NonNegative,
                     [](QuantizationSearch& search) { return search.fewest(); });
    result.least_count = std::min(quad_count(traced_->t_mesh, fewest), long{result.check.count});
    return result;
  }

  const SurfaceMesh& mesh_;
  const double max_count_;
  const QuadMeshOptions& options_;
  RunRecord& record_;
  QuadSeconds& seconds_;
  const double requested_;
  const std::unique_ptr<const TracedMap> traced_;
  const QuadPlacer placer_;
  std::map<std::vector<Index>, std::string> failures_;  // messages by quantization
};

// Returns whether there are too many quads because fewer are impossible. Features are not given up
// for a few quads more, such as one more row on a cube.
bool has_too_many(const QuadMesh& made) {
  constexpr long kFew = 4;
  return made.least_count && made.check.count > made.requested + kFew;
}

bool is_accepted(const FeatureChoice& choice, const QuadMesh& made) {
  return choice.acceptance != ChoiceAcceptance::WithinCount || !has_too_many(made);
}

std::vector<char> requested_features(const SurfaceMesh& mesh, const QuadMeshOptions& options) {
  if (options.features) return *options.features;
  return options.map.cones ? std::vector<char>() : sharp_edges(mesh, kCornerTurn);
}

void add_relaxed(const SurfaceMesh& mesh, const std::vector<char>& features, QuadMesh& made) {
  const FeatureLines lines = feature_lines(mesh, features);
  made.feature_lines = static_cast<Index>(lines.lines.size());
  for (const FeatureLine& line : lines.lines)
    if (!made.features[line.half_edges.front()])
      made.relaxed.push_back(
          {mesh.from_vertex(line.half_edges.front()), mesh.to_vertex(line.half_edges.back())});
}

}  // namespace

void require_memory_for_quads(const SurfaceMesh& mesh, const QuadMeshOptions& options) {
  require_usable_size(options);
  const double requested = requested_count(mesh, options);
  if (requested > kMaxQuads)
    throw Error(ErrorKind::Unsupported, fmt::format("{}{:.3g} quads are too many; {} at most",
                                                    message_prefix(mesh), requested, kMaxQuads));
  if (fits_into_memory(requested)) return;
  constexpr double kGigabyte = 1e9;
  const auto available = static_cast<double>(available_memory().value_or(0));
  throw Error(ErrorKind::Unsupported,
              fmt::format("{}{:.0f} quads need about {:.1f} GB of memory, {:.1f} GB are available; "
                          "ask for {:.0f} at most",
                          message_prefix(mesh), requested, bytes_of(requested) / kGigabyte,
                          available / kGigabyte, available / static_cast<double>(kBytesOfQuad)));
}

bool has_ragged_border(const SurfaceMesh& mesh) {
  constexpr std::ptrdiff_t kFewest = 32;
  constexpr double kShare = 0.25;
  const std::vector<char> is_border = mesh.boundary_flags(), is_corner = border_corners(mesh);
  const auto corners = std::count(is_corner.begin(), is_corner.end(), 1);
  const auto vertices = std::count(is_border.begin(), is_border.end(), 1);
  return corners >= kFewest && static_cast<double>(corners) >= kShare * vertices;
}

QuadMesh quad_mesh(const SurfaceMesh& mesh, const QuadMeshOptions& options, RunRecord& record) {
  require_usable(mesh, options);
  const ThreadCount threads(options.threads);
  const std::vector<char> features = requested_features(mesh, options);
  const FeatureSource source = options.features ? FeatureSource::Given : FeatureSource::Detected;
  QuadSeconds seconds;
  std::optional<QuadMesh> made;
  std::string conflict;
  std::optional<std::string> failure_without_features;
  for (FeatureChoice& choice :
       feature_choices(mesh, features, source, requested_count(mesh, options))) {
    const bool is_fallback = choice.acceptance == ChoiceAcceptance::Fallback;
    if (is_fallback && made) break;
    const bool has_features = has_any(choice.features);
    // If the last choices fail, the quads of earlier ones are kept, even if they are too many.
    const std::optional<std::string> failure = infeasibility([&] {
      QuadMesh next = QuadAttempts(mesh, has_features ? choice.features : std::vector<char>(),
                                   choice.max_count, options, record, seconds)
                          .first_of(choice.attempts);
      next.features = std::move(choice.features);
      next.shortest_feature = choice.shortest;
      made = std::move(next);
    });
    if (!failure && is_accepted(choice, *made)) break;
    if (!has_features && !is_fallback) failure_without_features = failure;
    if (!has_features || is_fallback || !conflict.empty()) continue;
    const std::string prefix = message_prefix(mesh);
    conflict = failure ? failure->substr(failure->starts_with(prefix) ? prefix.size() : 0)
                       : fmt::format("{} quads", made->check.count);
  }
  if (!made) throw Error(ErrorKind::Infeasible, failure_without_features.value_or(""));
  add_relaxed(mesh, features, *made);
  made->conflict = std::move(conflict);
  made->seconds = seconds;
  return *std::move(made);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
