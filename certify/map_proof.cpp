#include "majorant/certify/map_proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "majorant/certify/boundary_loops.h"
#include "majorant/certify/cut_map.h"
#include "majorant/certify/internal/cell_findings.h"
#include "majorant/certify/internal/chart_layers.h"
#include "majorant/certify/internal/shown_surface.h"
#include "majorant/constraints/sector_angle.h"
#include "majorant/elements/bernstein.h"
#include "majorant/elements/element_space.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/side_task.h"
#include "majorant/mesh/refusal.h"

namespace majorant {
namespace {

// In quarter turns. By continuity angle sums are whole multiples; their rounding error is about
// 1e-14.
constexpr double kWholeTurnTolerance = 1e-6;
constexpr Index kCellsPerPoll = 256;
// The progress reported once cells are judged, and once cuts are.
constexpr double kPositiveShare = 0.5, kCutShare = 0.9;

bool allows_seams(CutRule rule) { return rule == CutRule::Seams || rule == CutRule::SeamsOrFree; }
bool allows_any(CutRule rule) { return rule == CutRule::Free || rule == CutRule::SeamsOrFree; }

// Edges of the input, by their vertices, whose sides may have different uv.
class AllowedEdges {
 public:
  // Allows each edge as often as it is listed, in any order of its vertices. Without a list all
  // edges are allowed.
  explicit AllowedEdges(const std::optional<std::vector<std::array<Index, 2>>>& edges)
      : is_any_(!edges) {
    if (edges)
      for (const auto& edge : *edges) ++left_[sorted(edge)];
  }

  bool take(const std::array<Index, 2>& edge) {
    if (is_any_) return true;
    const auto entry = left_.find(sorted(edge));
    return entry != left_.end() && entry->second-- > 0;
  }

  // Returns the first edge that was taken less often than it is listed.
  std::optional<std::array<Index, 2>> left() const {
    for (const auto& [edge, count] : left_)
      if (count > 0) return edge;
    return {};
  }

 private:
  static std::array<Index, 2> sorted(const std::array<Index, 2>& edge) {
    return {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
  }

  bool is_any_;
  std::map<std::array<Index, 2>, Index> left_;
};

}  // namespace

std::string_view name_of(ProofStatus answer) {
  constexpr std::array<std::string_view, 4> kNames = {"proven", "violated", "undecided",
                                                      "not asked"};
  return kNames[static_cast<std::size_t>(answer)];
}

std::string count_text(Index count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string describe(const GlobalInjectivity& proof, const CornerNames& input_vertex) {
  if (proof.contacts.empty()) return proof.reason;
  const BoundaryContact& contact = proof.contacts.front();
  const auto edge = [&](Index h) {
    return fmt::format("({}, {})", input_vertex(face_of(h), corner_of(h)),
                       input_vertex(face_of(h), corner_of(next(h))));
  };
  const bool certain = contact.apart == ProofStatus::Violated;
  const std::string where =
      fmt::format("near ({:.9g}, {:.9g})", contact.where.x(), contact.where.y());
  const std::string before = proof.reason.empty() ? "" : proof.reason + "; ";
  if (contact.half_edge_a == contact.half_edge_b)
    return fmt::format("{}boundary edge {} {} itself {}", before, edge(contact.half_edge_a),
                       certain ? "meets" : "may meet", where);
  return fmt::format("{}boundary edges {} and {} {} {}", before, edge(contact.half_edge_a),
                     edge(contact.half_edge_b), certain ? "meet" : "may meet", where);
}

// Answers the questions in order, since later ones build on earlier answers. Independent questions
// are answered at the same time.
class MapProof::Judge {
 public:
  // stacks: of the cells, with mirrored charts turned back; null: no chart lies on another.
  Judge(MapProof& proof, const MapFile& file, const std::string& name, const ProofRequest& request,
        const StackedCharts* stacks)
      : proof_(proof),
        file_(file),
        name_(name),
        request_(request),
        stacks_(stacks),
        layers_{request.layers, stacks} {}

  void run() {
    std::string unfit;
    both([this] { judge_cells(); },
         [&] {
           try {
             cut_.emplace(file_, name_);
           } catch (const Error& e) {
             unfit = problem_of(e);
           }
         });
    if (!cut_) return give_up(unfit);
    request_.stop.advance(kPositiveShare);
    both([this] { judge_surface(); },
         [this] {
           judge_cuts();
           judge_angles();
           open();
         });
    request_.stop.advance(kCutShare);
    if (!proof_.map_) return;
    proof_.cuts.charts = proof_.map_->mesh().topology().components;
    judge_overlaps(*proof_.map_);
    find_seams();
  }

 private:
  bool is_stopped() const { return request_.stop() != Directive::Continue; }

  void judge_cells() {
    CellPositivity cells = cell_positivity(file_, request_.stop.between(0, kPositiveShare));
    proof_.positive = std::move(cells.finding);
    proof_.not_positive = std::move(cells.not_positive);
    proof_.flat = flatness_of(file_);
  }

  // Makes the map that is cut along its borders; none if that fails.
  void open() {
    try {
      proof_.map_ = cut_->map_cut_along(borders());
    } catch (const Error& e) {  // only an edge is open, its ends are not
      if (proof_.continuous.answer == ProofStatus::Proven)
        proof_.continuous = {ProofStatus::Undecided, problem_of(e)};
      if (request_.overlap == ProofRequest::Overlap::Forbidden)
        proof_.injective = {ProofStatus::Undecided, problem_of(e)};
    }
  }

  // Records that the cells form no surface, or are not faces of the given one.
  void give_up(const std::string& reason) {
    const bool is_given = request_.surface != nullptr;
    if (is_given) proof_.surface = {ProofStatus::Violated, reason};
    proof_.continuous = {ProofStatus::Undecided,
                         is_given ? "the cells are not the surface's" : reason};
    proof_.angles = proof_.continuous;
    if (request_.overlap == ProofRequest::Overlap::Forbidden) proof_.injective = proof_.continuous;
  }

  void judge_surface() {
    if (!request_.surface) return;
    ShownSurface shown = shown_surface(file_, cut_->surface(), request_);
    proof_.surface = std::move(shown.finding);
    proof_.other_triangles = shown.other_triangles;
    proof_.unmapped = shown.unmapped;
  }

  void judge_cuts() {
    const SurfaceMesh& surface = cut_->surface();
    const double close = kSeamClose * cut_->diagonal();
    is_free_.assign(to_size(surface.half_edge_count()), 0);
    AllowedEdges allowed(request_.cut_edges), claimed(request_.cut_edges);
    std::vector<Index> tears;  // edges that differ but must not
    Index first = -1;
    for (Index h = 0; h < surface.half_edge_count(); ++h) {
      if (surface.opposite(h) < h) continue;
      if (cut_->differs(h) || cut_->is_unshared(h)) claimed.take(cut_->input_edge(h));
      if (!cut_->differs(h)) continue;
      proof_.cuts.length += surface.edge_length(h);
      const bool is_allowed = allowed.take(cut_->input_edge(h));
      if (is_allowed && allows_seams(request_.cuts) && cut_->fit(h).mismatch <= close) {
        ++proof_.cuts.seams;
        continue;
      }
      ++proof_.cuts.others;
      is_free_[h] = is_free_[surface.opposite(h)] = 1;
      if (first < 0) first = h;
      if (!is_allowed) tears.push_back(h);
    }
    proof_.cuts.not_cut = claimed.left();
    if (!tears.empty()) {
      proof_.continuous = {
          ProofStatus::Violated,
          fmt::format("the map is not continuous: the sides of {} differ where it is not said to "
                      "be cut, first of {}",
                      count_text(static_cast<Index>(tears.size()), "inner edge"),
                      cut_->place(tears.front()))};
      return;
    }
    if (first < 0 || allows_any(request_.cuts)) {
      proof_.continuous = {ProofStatus::Proven, count_of_cuts()};
      return;
    }
    proof_.continuous = {
        ProofStatus::Violated,
        allows_seams(request_.cuts)
            ? fmt::format(
                  "the map is not seamless: the sides of {} differ by more than a quarter turn "
                  "and a translation, those of {} by {:.3g}",
                  count_text(proof_.cuts.others, "inner edge"), cut_->place(first),
                  cut_->fit(first).mismatch)
            : fmt::format("the map is not continuous: the sides of {} differ, first of {}",
                          count_text(proof_.cuts.others, "inner edge"), cut_->place(first))};
  }

  std::string count_of_cuts() const {
    const CutCount& cuts = proof_.cuts;
    if (!allows_seams(request_.cuts) && cuts.others == 0) return "no cuts";
    std::string text;
    if (allows_seams(request_.cuts)) text = count_text(cuts.seams, "seam edge");
    if (allows_any(request_.cuts) && cuts.others > 0)
      text += (text.empty() ? "" : ", ") + count_text(cuts.others, "cut edge");
    return text;
  }

  // Returns the angle sums, between tangents of the map at the corners, by vertex of the surface.
  Vec angle_sums() const {
    const SurfaceMesh& surface = cut_->surface();
    const TriangleIndices& ix = TriangleIndices::of_degree(file_.degree);
    Vec angle(3 * file_.cells.rows());
    parallel_for(static_cast<Index>(file_.cells.rows()), kCellsPerPoll, [&](Index c) {
      const auto point = [&](int local) { return Vector2(file_.uv.row(file_.cells(c, local))); };
      for (int k = 0; k < 3; ++k) {
        const auto [right, left] = ix.beside_corner(k);
        angle[3 * c + k] = sector_angle(point(right) - point(k), point(left) - point(k));
      }
    });
    Vec sum = Vec::Zero(surface.vertex_count());
    for (Index h = 0; h < surface.half_edge_count(); ++h) sum[surface.from_vertex(h)] += angle[h];
    return sum;
  }

  void judge_angles() {
    if (proof_.positive.answer != ProofStatus::Proven) {
      proof_.angles = {ProofStatus::Undecided, "not all cells are positive"};
      return;
    }
    const SurfaceMesh& surface = cut_->surface();
    const Vec sum = angle_sums();
    std::vector<char> is_inner(to_size(surface.vertex_count()), 1), is_on_seam(is_inner.size(), 0);
    for (Index h = 0; h < surface.half_edge_count(); ++h)
      for (const Index v : {surface.from_vertex(h), surface.to_vertex(h)}) {
        if (surface.opposite(h) < 0 || is_free_[h]) is_inner[v] = 0;
        if (cut_->differs(h)) is_on_seam[v] = 1;
      }
    Index inner = 0;
    for (Index v = 0; v < surface.vertex_count(); ++v) {
      if (!is_inner[v]) continue;
      ++inner;
      const double quarters = 2 * sum[v] / std::numbers::pi;
      const auto nearest = static_cast<int>(std::lround(quarters));
      const bool may_be_cone = allows_seams(request_.cuts);
      if (!(std::abs(quarters - nearest) <= kWholeTurnTolerance) || nearest < 1 ||
          (nearest != 4 && !may_be_cone)) {
        proof_.angles = {ProofStatus::Violated,
                         fmt::format("the angles around vertex {} sum up to {:.9g} degrees: the "
                                     "map covers its neighbourhood more than once",
                                     surface.input_vertex(v), 90 * quarters)};
        if (may_be_cone)
          proof_.angles.detail =
              fmt::format("the angles around vertex {} sum up to {:.9g} degrees, no multiple of 90",
                          surface.input_vertex(v), 90 * quarters);
        return;
      }
      if (nearest != 4) proof_.cones.push_back({surface.input_vertex(v), nearest});
    }
    proof_.angles = {ProofStatus::Proven, fmt::format("{} inner vertices", inner)};
    if (allows_seams(request_.cuts))
      proof_.angles.detail += ", " + count_text(static_cast<Index>(proof_.cones.size()), "cone");
  }

  // Returns the half-edges that differ, and those between layers or between charts of stacks. The
  // sides of a fold may agree if one of them is turned back.
  std::vector<char> borders() const {
    std::vector<char> is_cut = cut_->cuts();
    const SurfaceMesh& surface = cut_->surface();
    for (Index h = 0; h < surface.half_edge_count(); ++h) {
      const Index other = surface.opposite(h);
      if (other < 0) continue;
      const Index cell = face_of(h), beyond = face_of(other);
      if (layers_.layer(cell) != layers_.layer(beyond) ||
          (stacks_ && stacks_->chart[cell] != stacks_->chart[beyond]))
        is_cut[h] = 1;
    }
    return is_cut;
  }

  void judge_overlaps(const BezierMap& plain) {
    if (request_.overlap == ProofRequest::Overlap::NotRequested) return;
    if (is_stopped()) {
      if (request_.overlap == ProofRequest::Overlap::Forbidden)
        proof_.injective = stopped_finding();
      return;
    }
    proof_.global = overlaps_of(plain, layers_, [this] { return is_stopped(); });
    if (request_.overlap == ProofRequest::Overlap::Reported) return;
    const SurfaceMesh& mesh = plain.mesh();  // its faces are those of the glued map
    const std::string reason = describe(*proof_.global, [&](Index face, Index corner) {
      return mesh.input_vertex(mesh.faces()(face, corner));
    });
    if (proof_.global->result == ProofStatus::Violated)
      proof_.injective = {ProofStatus::Violated, "the map is not globally injective: " + reason};
    else if (proof_.positive.answer != ProofStatus::Proven)
      proof_.injective = {ProofStatus::Undecided, "not all cells are positive"};
    else if (proof_.global->result == ProofStatus::Undecided)
      proof_.injective = {ProofStatus::Undecided, reason};
    else
      proof_.injective = {ProofStatus::Proven, count_text(proof_.cuts.charts, "chart")};
  }

  void find_seams() {
    if (!allows_seams(request_.cuts) || proof_.cuts.others > 0) return;
    try {
      BezierMap seamless = cut_->map_with_seams();
      if (!seamless.seams().trivial()) proof_.map_ = std::move(seamless);
    } catch (const Error& e) {
      proof_.continuous = {ProofStatus::Undecided, problem_of(e)};
    }
  }

  MapProof& proof_;
  const MapFile& file_;
  const std::string& name_;
  const ProofRequest& request_;
  const StackedCharts* const stacks_;
  const ChartLayers layers_;
  std::optional<CutMap> cut_;
  std::vector<char> is_free_;  // half-edges of the surface that are cut but no seam
};

MapProof::MapProof(const MapFile& file, const std::string& name, const ProofRequest& request) {
  if (file.degree > BezierTriangleSpace::kMaxDegree)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: cells of degree {}; only 1 to {} can be judged", name, file.degree,
                            BezierTriangleSpace::kMaxDegree));
  if (request.surface && !knows_vertices(file)) {
    MapFile numbered = file;
    numbered.input_vertex = number_by_place(file.points, *request.surface);
    judge(numbered, name, request);
  } else {
    judge(file, name, request);
  }
}

void MapProof::judge(const MapFile& file, const std::string& name, const ProofRequest& request) {
  try {
    if (request.stacks == ProofRequest::Stacks::Allowed && request.layers.empty())
      stacks = find_stacks(file, name);
  } catch (const Error&) {  // the cells form no surface, which is a finding
  }
  if (stacks.stacks == 0) return Judge(*this, file, name, request, nullptr).run();
  Judge(*this, turned_back(file, stacks), name, request, &stacks).run();
}

ProofStatus MapProof::verdict() const {
  ProofStatus verdict = ProofStatus::Proven;
  for (const auto& [ignored, finding] : findings()) {
    if (finding->answer == ProofStatus::Violated) return ProofStatus::Violated;
    if (finding->answer == ProofStatus::Undecided) verdict = ProofStatus::Undecided;
  }
  return verdict;
}

std::vector<std::pair<std::string_view, const Finding*>> MapProof::findings() const {
  return {{"surface", &surface},       {"flat", &flat},     {"positive", &positive},
          {"continuous", &continuous}, {"angles", &angles}, {"injective", &injective}};
}

std::string MapProof::first_defect() const {
  for (const ProofStatus status : {ProofStatus::Violated, ProofStatus::Undecided})
    for (const auto& [question, finding] : findings())
      if (finding->answer == status) return fmt::format("{}: {}", question, finding->detail);
  return {};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
