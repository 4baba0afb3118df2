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
#include "majorant/framework/stopwatch.h"
#include "majorant/io/files/available_memory.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/internal/aligned_map.h"
#include "majorant/quads/internal/arc_numbers.h"
#include "majorant/quads/internal/border.h"
#include "majorant/quads/internal/extraction.h"
#include "majorant/quads/internal/integer_grid_map.h"
#include "majorant/quads/internal/smoothing.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {
namespace {

bool has_any(const std::vector<char>& flags) {
  return std::count(flags.begin(), flags.end(), 0) < static_cast<std::ptrdiff_t>(flags.size());
}

double asked_of(const SurfaceMesh& mesh, const QuadMeshOptions& options) {
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

// Returns whether so many quads fit into the memory that is available.
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

// work(), its time added to `sum`.
template <class Work>
auto timed(double& sum, const Work& work) {
  const AddedSeconds time(sum);
  return work();
}

// Quads, not smoothed and not judged any further where they make no surface.
struct JudgedQuads {
  PolygonMesh quads;
  std::vector<Index> patch_of;
  std::vector<std::array<Index, 2>> feature_edges;
  QuadCheck check;
  Index patches = 0;
  QuadPlacing placed = QuadPlacing::Rectangles;
  int degree = 1;
};

// features: of `mesh`. Corners of the border are those of the lattice.
JudgedQuads smoothed_quads(const SurfaceMesh& mesh, const std::vector<char>& features,
                           const SeamlessLattice& lattice, const TMesh& t_mesh,
                           const std::vector<Index>& edges, const RunRecord& record,
                           QuadSeconds& seconds) {
  const StopCheck& stop = record.start_stop();
  ExtractedQuads extracted =
      timed(seconds.place, [&] { return ExtractedQuads(lattice, t_mesh, edges); });
  PolygonMesh quads = timed(seconds.place, [&] { return extracted.polygons(); });
  QuadCheck check = timed(seconds.check, [&] { return check_quads(quads, nullptr, {}, stop); });
  HeldVertices held = timed(seconds.place, [&] { return extracted.held_vertices(); });
  if (check.is_surface) {
    record.announce(fmt::format("smoothing {} quads", check.count));
    timed(seconds.smooth, [&] { smooth_quads(quads, lattice.surface(), held, stop); });
    record.begin(Activity::Proving);
    check = timed(seconds.check, [&] {
      return check_quads(quads, &mesh, features, record.telling(stop), lattice.border_turn());
    });
  }
  return {std::move(quads), extracted.patches(), std::move(held.feature_edges), std::move(check),
          static_cast<Index>(t_mesh.patches.size())};
}

// work(), or what it says where it finds that it is not possible.
template <class Work>
std::optional<std::string> why_infeasible(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Infeasible) throw;
    return error.what();
  }
  return std::nullopt;
}

// Quads of one T-mesh, of whatever numbers, placed in one of the two ways.
class QuadPlacer {
 public:
  // All of them outlive this. features: of `mesh`.
  QuadPlacer(const SurfaceMesh& mesh, const std::vector<char>& features, const RoomySurface& roomy,
             const BezierMap& map, const SeamlessLattice& lattice, const TMesh& t_mesh,
             const QuadMeshOptions& options, const RunRecord& record, QuadSeconds& seconds)
      : mesh_(mesh),
        features_(features),
        roomy_(roomy),
        map_(map),
        lattice_(lattice),
        t_mesh_(t_mesh),
        options_(options),
        record_(record),
        seconds_(seconds) {}

  // Throws Error(Infeasible) where none are valid. degree: the highest of the integer-grid map
  // where the rectangles' quads are valid.
  JudgedQuads place(const std::vector<Index>& edges, int degree) const {
    std::optional<JudgedQuads> best;
    std::optional<std::string> why;
    const auto consider = [&](const auto& make) {
      std::optional<JudgedQuads> made;
      std::optional<std::string> failed = why_infeasible([&] { made = make(); });
      if (made && !made->check.is_valid()) failed = made->check.defects.front();
      if (failed) {
        if (!why) why = std::move(failed);
      } else if ((!best || made->check.angle_deviation < best->check.angle_deviation)) {
        best = std::move(made);
      }
    };
    if (options_.placing != QuadPlacing::IntegerGrid)
      consider([&] {
        return smoothed_quads(mesh_, features_, lattice_, t_mesh_, edges, record_, seconds_);
      });
    if (options_.placing != QuadPlacing::Rectangles)
      consider([&] { return on_integer_grid(edges, best ? degree : options_.last_degree); });
    if (!best) throw Error(ErrorKind::Infeasible, why.value_or(""));
    return *std::move(best);
  }

 private:
  JudgedQuads on_integer_grid(const std::vector<Index>& edges, int last_degree) const {
    std::optional<AddedSeconds> time(std::in_place, seconds_.place);
    const StopCheck& stop = record_.start_stop();
    const long count = quad_count(t_mesh_, edges);
    const double area =
        static_cast<double>(lattice_.twice_area()) / 2 * lattice_.unit() * lattice_.unit();
    // Of few digits, so that its multiples are exact.
    const double length = std::sqrt(area / static_cast<double>(count));
    const double step = std::ldexp(1.0, std::ilogb(length) - 20);
    const GridTranslations grid(map_, lattice_, t_mesh_, edges, step * std::round(length / step));
    const std::optional<BezierMap> whole =
        integer_grid_map(map_, lattice_, grid, {options_.first_degree, last_degree}, stop);
    if (!whole)
      throw Error(ErrorKind::Infeasible,
                  fmt::format("no integer-grid map of degree {} to {} was reached",
                              options_.first_degree, last_degree));
    const IntegerGrid found(roomy_, *whole, grid.edge_length(), stop);
    if (quad_count(found.t_mesh(), found.edges()) != count)
      throw Error(ErrorKind::Infeasible, "the integer-grid map has another number of quads");
    time.reset();
    JudgedQuads made = smoothed_quads(mesh_, features_, found.lattice(), found.t_mesh(),
                                      found.edges(), record_, seconds_);
    made.placed = QuadPlacing::IntegerGrid;
    made.degree = whole->degree();
    return made;
  }

  const SurfaceMesh& mesh_;
  const std::vector<char>& features_;
  const RoomySurface& roomy_;
  const BezierMap& map_;
  const SeamlessLattice& lattice_;
  const TMesh& t_mesh_;
  const QuadMeshOptions& options_;
  const RunRecord& record_;
  QuadSeconds& seconds_;
};

// A surface with room for the lines of quads, its map, and the rectangles that this falls into.
struct TracedMap {
  RoomySurface roomy;
  AlignedMap aligned;
  SeamlessLattice lattice;
  TMesh t_mesh;

  TracedMap(RoomySurface surface, const SeamlessOptions& map_options, RunRecord& record,
            QuadSeconds& seconds)
      : roomy(std::move(surface)),
        aligned(timed(seconds.map,
                      [&] {
                        return roomy.border_turn > kCornerTurn
                                   ? aligned_map(with_smooth_border(roomy), map_options, record)
                                   : aligned_map(roomy, map_options, record);
                      })),
        lattice(roomy.mesh, aligned.map, roomy.is_feature, roomy.border_turn),
        t_mesh(
            timed(seconds.quantize, [&] { return trace_t_mesh(lattice, record.start_stop()); })) {}
};

// features: of `mesh`. A surface of few faces that has no map, because these are too large for the
// cones of a field, gets smaller ones. Throws Error(Infeasible) where there is no map then either.
std::unique_ptr<const TracedMap> traced_map(const SurfaceMesh& mesh,
                                            const std::vector<char>& features,
                                            const QuadMeshOptions& options, RunRecord& record,
                                            QuadSeconds& seconds) {
  // Chosen: a map of so many faces takes seconds.
  constexpr int kMostHalvings = 2;
  constexpr Index kMostFaces = 10'000;
  SeamlessOptions map_options = options.map;
  map_options.threads = options.threads;
  RoomySurface roomy = with_room(mesh, features);
  roomy.border_turn = options.border_turn;
  for (int halvings = 0;; ++halvings) {
    record.begin(Activity::Starting);
    const bool is_last = halvings == kMostHalvings || 4 * roomy.mesh.face_count() > kMostFaces;
    try {
      return std::make_unique<const TracedMap>(roomy, map_options, record, seconds);
    } catch (const Error& error) {
      const bool has_no_map =
          error.kind() == ErrorKind::Infeasible || error.kind() == ErrorKind::Invalid;
      if (is_last || !has_no_map) throw;
    }
    record.announce("halving all edges, which are too long for a map");
    record.begin_pass();
    roomy = halved(roomy);
  }
}

// Returns whether more quads than asked were made because there are none with fewer. A few are
// nothing that features are given up for: on a cube one more row is.
bool has_too_many(const QuadMesh& made) {
  constexpr long kFew = 4;
  return made.least_count && made.check.count > made.asked + kFew;
}

// What is done where there are no valid quads of about the number asked for.
struct OtherCounts {
  double most = std::numeric_limits<double>::infinity();  // more than so many are not placed
  bool is_asked_tried = true;                             // about the number asked for
  bool may_be_more = true;                                // up to a few times as many are tried
  // How many would do is searched for, far beyond: not, to be told, or to be taken.
  enum class FarMore { No, Told, Taken } far_more = FarMore::Told;
};

// Returns the quads of a surface with these features (3 #F, or empty: none). Throws
// Error(Infeasible) where there are none, or none with so few quads.
QuadMesh quads_with(const SurfaceMesh& mesh, const std::vector<char>& features,
                    const QuadMeshOptions& options, const OtherCounts& others, RunRecord& record,
                    QuadSeconds& seconds) {
  const StopCheck& stop = record.start_stop();
  QuadMesh result;
  const std::unique_ptr<const TracedMap> traced =
      traced_map(mesh, features, options, record, seconds);
  const RoomySurface& roomy = traced->roomy;
  const BezierMap& map = traced->aligned.map;
  const SeamlessLattice& lattice = traced->lattice;
  const TMesh& t_mesh = traced->t_mesh;
  result.status = traced->aligned.status;
  for (const TNode& node : t_mesh.nodes)
    result.cones += node.is_cone() && node.side != Side::Border;
  const double asked = asked_of(mesh, options);
  result.asked = std::lround(asked);
  const QuadPlacer placer(mesh, features, roomy, map, lattice, t_mesh, options, record, seconds);
  // Arcs without edges leave the best angles; other numbers of quads are other meshes, of which one
  // may be valid, or have the count that was asked for, where the first is not, or has not.
  using Arcs = ArcNumbers::Arcs;
  constexpr std::pair<Arcs, double> kAttempts[] = {{Arcs::Joined, 1},    {Arcs::Joined, 1.02},
                                                   {Arcs::Joined, 0.98}, {Arcs::Joined, 1.04},
                                                   {Arcs::Separate, 1},  {Arcs::Separate, 1.03}};
  std::optional<std::string> why;
  std::map<std::vector<Index>, std::string> failures;  // by numbers: why they make no valid quads
  double least_off = std::numeric_limits<double>::infinity();
  const auto numbers_for = [&](const std::string& what, Arcs arcs, const auto& find) {
    const AddedSeconds of_numbers(seconds.quantize);
    record.announce("whole numbers for " + what);
    ArcNumbers numbers(lattice, t_mesh, arcs, stop);
    std::vector<Index> edges = find(numbers);
    record.announce(fmt::format("{} quads", quad_count(t_mesh, edges)));
    return edges;
  };
  int attempts = 0;
  const auto attempt = [&](Arcs arcs, double part) {
    const std::vector<Index> edges = numbers_for(
        fmt::format("{} quads", std::lround(part * asked)), arcs, [&](ArcNumbers& numbers) {
          return options.edge_length
                     ? numbers.at(*options.edge_length / lattice.unit() / std::sqrt(part))
                     : numbers.for_count(part * asked);
        });
    const long count = quad_count(t_mesh, edges);
    if (static_cast<double>(count) > others.most)
      throw Error(ErrorKind::Infeasible,
                  fmt::format("{}{} quads at least", message_prefix(mesh), count));
    const double off = std::abs(static_cast<double>(count) / asked - 1);
    if (result.check.count > 0 && off >= least_off) return;
    const auto [known, is_new] = failures.try_emplace(edges);
    if (!is_new) throw Error(ErrorKind::Infeasible, known->second);
    std::optional<JudgedQuads> placed;
    // Where the count is far off, better angles are not worth the time that higher degrees take.
    const int degree =
        off <= kCountClose || options.edge_length ? options.last_degree : options.first_degree;
    if (std::optional<std::string> failed =
            why_infeasible([&] { placed = placer.place(edges, degree); })) {
      known->second = *std::move(failed);
      throw Error(ErrorKind::Infeasible, known->second);
    }
    JudgedQuads made = *std::move(placed);
    least_off = off;
    result.quads = std::move(made.quads);
    result.patch_of = std::move(made.patch_of);
    result.feature_edges = std::move(made.feature_edges);
    result.check = std::move(made.check);
    result.patches = made.patches;
    result.placed = made.placed;
    result.degree = made.degree;
    result.least_count.reset();
    if (static_cast<double>(result.check.count) <= (1 + kCountClose) * asked) return;
    const long least =
        quad_count(t_mesh, numbers_for("as few quads as possible", Arcs::Joined,
                                       [](ArcNumbers& numbers) { return numbers.fewest(); }));
    result.least_count = std::min(least, long{result.check.count});
  };
  const auto attempt_for = [&](Arcs arcs, double part) {
    if (++attempts > 1) record.begin_pass();
    record.begin(Activity::Solving);
    const std::optional<std::string> failed = why_infeasible([&] { attempt(arcs, part); });
    if (!why) why = failed;
    return result.check.count > 0;
  };
  for (const auto& [arcs, part] : kAttempts)
    // Where as few as possible were made there is nothing closer.
    if (!others.is_asked_tried ||
        (attempt_for(arcs, part) && (options.edge_length || least_off <= kCountClose ||
                                     result.least_count == result.check.count)))
      break;
  // More, where so few turn thin limbs over; chosen.
  constexpr double kGrowth = 1.5, kMostTimes = 4, kFew = 200;
  const double most = std::max(kMostTimes, kFew / std::max(asked, 1.0));
  const auto is_closer = [&](double part) {
    const auto count = static_cast<double>(result.check.count);
    return count == 0 || (!options.edge_length && part * asked < count);
  };
  for (double part = kGrowth;
       others.may_be_more && is_closer(part) && part <= most && fits_into_memory(part * asked);
       part *= kGrowth)
    attempt_for(Arcs::Joined, part);
  if (result.check.count > 0) return result;
  // How many would do.
  constexpr double kMostTried = 64, kMostQuadsTried = 20'000;  // which take seconds
  std::string remedy = "ask for more of them";
  using FarMore = OtherCounts::FarMore;
  for (double part = 2 * most; others.far_more != FarMore::No && part <= kMostTried * most;
       part *= 2) {
    if (part * asked > kMostQuadsTried) break;
    if (!attempt_for(Arcs::Joined, part)) continue;
    if (others.far_more == FarMore::Taken) return result;
    remedy = fmt::format("ask for {:.4g} times as many, {} for {}", part, std::lround(part * asked),
                         result.asked);
    break;
  }
  throw Error(ErrorKind::Infeasible, fmt::format("{}no valid quads were made: {}; {}",
                                                 message_prefix(mesh), why.value_or(""), remedy));
}

std::vector<char> asked_features(const SurfaceMesh& mesh, const QuadMeshOptions& options) {
  if (options.features) return *options.features;
  return options.map.cones ? std::vector<char>() : sharp_edges(mesh, kCornerTurn);
}

}  // namespace

void require_memory_for_quads(const SurfaceMesh& mesh, const QuadMeshOptions& options) {
  require_usable_size(options);
  const double asked = asked_of(mesh, options);
  if (asked > kMostQuads)
    throw Error(ErrorKind::Unsupported, fmt::format("{}{:.3g} quads are too many; {} at most",
                                                    message_prefix(mesh), asked, kMostQuads));
  if (fits_into_memory(asked)) return;
  constexpr double kGigabyte = 1e9;
  const auto available = static_cast<double>(available_memory().value_or(0));
  throw Error(ErrorKind::Unsupported,
              fmt::format("{}{:.0f} quads need about {:.1f} GB of memory, {:.1f} GB are available; "
                          "ask for {:.0f} at most",
                          message_prefix(mesh), asked, bytes_of(asked) / kGigabyte,
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
  QuadSeconds seconds;
  const std::vector<char> asked = asked_features(mesh, options);
  const auto made_with = [&](const std::vector<char>& features, const OtherCounts& others) {
    QuadMesh made = quads_with(mesh, has_any(features) ? features : std::vector<char>(), options,
                               others, record, seconds);
    made.seconds = seconds;
    return made;
  };
  if (!has_any(asked)) return made_with({}, {});
  const double length = std::sqrt(mesh.area() / std::max(asked_of(mesh, options), 1.0));
  std::optional<QuadMesh> made;
  std::vector<char> tried;
  double shortest = length;
  std::string conflict;
  // Short sides of steps and teeth are kept where that makes about as many quads as asked; many
  // times as many are not even placed, unless that takes no time.
  constexpr double kMostTimesSharp = 2, kSoonPlaced = 1000;
  const double most_sharp = std::max(kMostTimesSharp * asked_of(mesh, options), kSoonPlaced);
  using FarMore = OtherCounts::FarMore;
  const auto make_with = [&](const std::vector<char>& features, const OtherCounts& others) {
    QuadMesh next = made_with(features, others);
    next.features = features;
    next.shortest_feature = shortest;
    made = std::move(next);
  };
  for (ShortLines short_lines = ShortLines::SharpKept;; shortest *= 2) {
    const std::vector<char> features = without_short_lines(mesh, asked, shortest, short_lines);
    const bool has_sharp = short_lines == ShortLines::SharpKept;
    if (has_sharp) {
      short_lines = ShortLines::Dropped;
      shortest /= 2;
    }
    if (features == tried) continue;
    tried = features;
    const bool is_last = !has_any(features);
    // With features that were not given many more are not taken at first.
    OtherCounts others{.may_be_more = is_last || options.features, .far_more = FarMore::No};
    if (has_sharp) others.most = most_sharp;
    const auto make = [&] { make_with(features, others); };
    if (is_last && !made) {
      const std::optional<std::string> failed = why_infeasible(make);
      if (!failed) break;
      // Few quads that lie across teeth are turned over; more that follow the teeth's sides are
      // not.
      shortest = length;
      const std::vector<char> sharp =
          without_short_lines(mesh, asked, length, ShortLines::SharpKept);
      if (has_any(sharp) && !why_infeasible([&] { make_with(sharp, {.far_more = FarMore::No}); }))
        break;
      if (why_infeasible([&] {
            make_with(features,
                      {.is_asked_tried = false, .may_be_more = false, .far_more = FarMore::Taken});
          }))
        throw Error(ErrorKind::Infeasible, *failed);
      break;
    }
    // Where none are made in the end, those of before stay, too many or not.
    const std::optional<std::string> failed = why_infeasible(make);
    if (is_last || (!failed && ((options.features && !has_sharp) || !has_too_many(*made)))) break;
    if (!conflict.empty()) continue;
    const std::string prefix = message_prefix(mesh);
    conflict = failed ? failed->substr(failed->starts_with(prefix) ? prefix.size() : 0)
                      : fmt::format("{} quads", made->check.count);
  }
  const FeatureLines lines = feature_lines(mesh, asked);
  made->feature_lines = static_cast<Index>(lines.lines.size());
  for (const FeatureLine& line : lines.lines)
    if (!made->features[line.half_edges.front()])
      made->relaxed.push_back(
          {mesh.from_vertex(line.half_edges.front()), mesh.to_vertex(line.half_edges.back())});
  made->conflict = std::move(conflict);
  made->seconds = seconds;
  return *std::move(made);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
