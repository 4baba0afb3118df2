#include "majorant/certify/map_proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "majorant/certify/boundary_loops.h"
#include "majorant/certify/cut_map.h"
#include "majorant/certify/internal/glued_map.h"
#include "majorant/certify/internal/match_tolerance.h"
#include "majorant/certify/internal/repaired_match.h"
#include "majorant/certify/internal/surface_match.h"
#include "majorant/constraints/sector_angle.h"
#include "majorant/elements/bernstein.h"
#include "majorant/elements/element_space.h"
#include "majorant/elements/exact_determinant.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/rounding.h"
#include "majorant/framework/side_task.h"
#include "majorant/mesh/plane_side.h"
#include "majorant/mesh/refusal.h"

namespace majorant {
namespace {

// Angle sums are whole multiples of a quarter turn by continuity; their rounding is some 1e-14.
// Quarter turns. Between their rounding and a quarter turn.
constexpr double kWholeTurnTolerance = 1e-6;
constexpr Index kCellsPerPoll = 256;
// Shares that are done once the cells are judged, and what is between them.
constexpr double kPositiveShare = 0.5, kCutShare = 0.9;

bool allows_seams(CutRule rule) { return rule == CutRule::Seams || rule == CutRule::SeamsOrFree; }
bool allows_any(CutRule rule) { return rule == CutRule::Free || rule == CutRule::SeamsOrFree; }

Finding stopped_finding() { return {ProofStatus::Undecided, "stopped before it was decided"}; }

// ---- What the digits of a file, which are not exactly its doubles (MapFile::uv_rounding), leave
// of what is known of det J on a cell ----

Vector2 uv_at(const MapFile& file, Index cell, int k) { return file.uv.row(file.cells(cell, k)); }

// The largest derivatives of the map from corner 0 towards corners 1 and 2: control points of them
// are n times differences of neighbours.
Vector2 reach_of(const MapFile& file, Index cell) {
  const TriangleIndices& ix = TriangleIndices::of_degree(file.degree);
  Vector2 largest = Vector2::Zero();
  for (int l = 0; l < ix.count(); ++l) {
    const auto [i, j, k] = ix.multi(l);
    if (i == 0) continue;
    const Vector2 from = uv_at(file, cell, l);
    const Vector2 first = uv_at(file, cell, ix.local(i - 1, j + 1, k)) - from;
    const Vector2 second = uv_at(file, cell, ix.local(i - 1, j, k + 1)) - from;
    largest = largest.cwiseMax(Vector2(first.lpNorm<1>(), second.lpNorm<1>()));
  }
  return file.degree * largest;
}

// A bound on the difference of det J between the map that the digits make and that of the doubles,
// anywhere on the cell; 0 where they are the same.
double rounding_of_determinant(const MapFile& file, Index cell) {
  if (file.uv_rounding.rows() == 0) return 0;
  // A control point off by r in every coordinate moves a derivative of degree n by 2 n r.
  const double off =
      2 * file.degree * file.uv_rounding(file.cells.row(cell), Eigen::all).maxCoeff();
  return 1.01 * (off * reach_of(file, cell).sum() + 2 * off * off);
}

// The determinant at a point of a cell; error: how far it may be from that of the digits, rounding
// here included.
struct Determinant {
  double value = 0, error = 0;
};

Determinant determinant(const MapFile& file, Index cell, const Barycentric& at) {
  const Eigen::MatrixX2d gradients = bernstein_gradients(file.degree, at);
  Vector2 first = Vector2::Zero(), second = first;  // derivatives as in reach_of()
  for (int l = 0; l < gradients.rows(); ++l) {
    const Vector2 p = uv_at(file, cell, l) - uv_at(file, cell, 0);  // differences keep their digits
    first += (gradients(l, 1) - gradients(l, 0)) * p;
    second -= gradients(l, 0) * p;
  }
  // The rounding is that of the product alone at degree 1, where gradients are -1, 0, 1; else of
  // all terms of a sum.
  const double operations = file.degree == 1 ? 4 : 32.0 * static_cast<double>(gradients.rows());
  return {cross(first, second),
          rounding_of_determinant(file, cell) +
              operations * 2 * kUnitRoundoff<double> * reach_of(file, cell).prod()};
}

// The answer for the digits, from the exact one for the doubles: the same, or Undecided.
DeterminantRange beyond_rounding(const MapFile& file, Index cell, const DeterminantRange& exact) {
  if (rounding_of_determinant(file, cell) == 0) return exact;
  const bool is_certified = exact.positive == ProofStatus::Proven;
  if (is_certified && file.degree > 1) return {};  // at degree 1 it is the same everywhere
  const Determinant det =
      determinant(file, cell,
                  is_certified ? Barycentric::Constant(1.0 / 3)
                               : Barycentric(exact.at[0], exact.at[1], exact.at[2]));
  const bool holds = is_certified ? det.value > det.error : det.value < -det.error;
  return holds ? exact : DeterminantRange{};
}

// Edges of the input whose two sides may have other uv, told by their vertices.
class AllowedEdges {
 public:
  // Allows each edge as often as it is listed, in any order of its vertices; none given: all.
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

  // The first edge that was not taken as often as it is listed.
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

// Asks one question after the other; later ones build on earlier answers. Those that do not are
// asked at the same time.
class MapProof::Judge {
 public:
  // stacks: of the cells, mirrored charts turned back; null: no chart lies on another.
  Judge(MapProof& proof, const MapFile& file, const std::string& name, const ProofRequest& request,
        const StackedCharts* stacks)
      : proof_(proof), file_(file), name_(name), request_(request), stacks_(stacks) {}

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
    try {
      judge_positivity();
    } catch (const Stopped&) {  // inside of a cell
      if (proof_.positive.answer == ProofStatus::NotAsked) proof_.positive = stopped_finding();
    }
    judge_flatness();
  }

  // The map that is cut along its borders; none where that cannot be.
  void open() {
    try {
      proof_.map_ = cut_->map_cut_along(borders());
    } catch (const Error& e) {  // an edge is open whose ends are not
      if (proof_.continuous.answer == ProofStatus::Proven)
        proof_.continuous = {ProofStatus::Undecided, problem_of(e)};
      if (request_.overlap == ProofRequest::Overlap::Forbidden)
        proof_.injective = {ProofStatus::Undecided, problem_of(e)};
    }
  }

  // The cells are no surface: of one that was given, they are not its faces.
  void give_up(const std::string& reason) {
    const bool is_given = request_.surface != nullptr;
    if (is_given) proof_.surface = {ProofStatus::Violated, reason};
    proof_.continuous = {ProofStatus::Undecided,
                         is_given ? "the cells are not the surface's" : reason};
    proof_.angles = proof_.continuous;
    if (request_.overlap == ProofRequest::Overlap::Forbidden) proof_.injective = proof_.continuous;
  }

  Vector2 corner(Index cell, int k) const { return file_.uv.row(file_.cells(cell, k)); }

  void judge_positivity() {
    NodeNumbering numbering;
    numbering.cells = file_.cells;
    numbering.node_count = static_cast<Index>(file_.points.rows());
    const BezierTriangleSpace space(std::move(numbering), file_.degree);
    const Eigen::Map<const Vec> x(file_.uv.data(), file_.uv.size());
    const auto cells = static_cast<Index>(file_.cells.rows());
    std::vector<char> is_proven(to_size(cells), 0);  // in floating point
    std::atomic<std::size_t> done = 0;
    const StopCheck told = request_.stop.between(0, kPositiveShare);
    parallel_tasks((cells + kCellsPerPoll - 1) / kCellsPerPoll, [&](Index task, int) {
      if (is_stopped()) return;
      const Index last = std::min(cells, (task + 1) * kCellsPerPoll);
      for (Index c = task * kCellsPerPoll; c < last; ++c) {
        const PositivityProof proof = space.certify(c, x, ProofDepth::kFinal);
        is_proven[c] = proof.result == ProofStatus::Proven &&
                       proof.lower_bound > rounding_of_determinant(file_, c);
      }
      told.advance(done += to_size(kCellsPerPoll), to_size(cells));
    });
    std::string worst;
    bool is_violated = false;
    for (Index c = 0; c < cells; ++c) {
      if (c % kCellsPerPoll == 0 && is_stopped()) {
        if (!is_violated) proof_.positive = stopped_finding();
        if (!is_violated) return;
        break;
      }
      if (is_proven[c]) continue;
      const DeterminantRange exact = beyond_rounding(
          file_, c,
          exact_determinant_of_triangle(file_.uv(file_.cells.row(c), Eigen::all), request_.stop));
      if (exact.positive == ProofStatus::Proven) continue;
      proof_.not_positive.push_back(c);
      if (is_violated) continue;
      if (exact.positive == ProofStatus::Violated) {
        is_violated = true;
        worst = fmt::format("cell {}: det J <= 0 at barycentric ({:.6g}, {:.6g}, {:.6g})", c,
                            exact.at[0], exact.at[1], exact.at[2]);
      } else if (worst.empty()) {
        worst = fmt::format("cell {}: det J is not proven positive, nor is it refuted", c);
      }
    }
    if (proof_.not_positive.empty() && !file_.folded.empty()) {
      proof_.positive = {ProofStatus::Violated,
                         fmt::format("face {} folds where programs cut it, from its first corner{}",
                                     file_.folded.front(),
                                     file_.folded.size() > 1
                                         ? fmt::format(" ({} faces in all)", file_.folded.size())
                                         : "")};
      return;
    }
    const std::size_t bad = proof_.not_positive.size();
    if (bad > 1) worst += fmt::format(" ({} cells in all)", bad);
    proof_.positive = bad == 0      ? Finding{ProofStatus::Proven,
                                         count_text(static_cast<Index>(file_.cells.rows()), "cell")}
                      : is_violated ? Finding{ProofStatus::Violated, worst}
                                    : Finding{ProofStatus::Undecided, worst};
  }

  // Else the file shows another surface than the one between its corners.
  void judge_flatness() {
    const TriangleIndices& ix = TriangleIndices::of_degree(file_.degree);
    Eigen::AlignedBox3d box;
    for (const Index p : file_.cells.reshaped()) box.extend(Vector3(file_.points.row(p)));
    double worst = 0;
    for (Index c = 0; c < file_.cells.rows(); ++c)
      for (int l = 3; l < ix.count(); ++l) {  // corners are where they are
        Eigen::RowVector3d flat = Eigen::RowVector3d::Zero();
        for (int k = 0; k < 3; ++k)
          flat += ix.multi(l)[k] / double(file_.degree) * file_.points.row(file_.cells(c, k));
        worst = std::max(worst, (flat - file_.points.row(file_.cells(c, l))).norm());
      }
    if (std::isfinite(worst) && worst <= match_tolerance(box))
      proof_.flat = {ProofStatus::Proven,
                     count_text(static_cast<Index>(file_.cells.rows()), "cell")};
    else
      proof_.flat = {
          ProofStatus::Violated,
          fmt::format("surface control points are off their flat triangles by {:g}", worst)};
  }

  void judge_surface() {
    if (!request_.surface) return;
    std::vector<Index> labels;
    const bool has_numbers = request_.labels == ProofRequest::FaceLabels::Compared;
    const SurfaceMesh& cells = cut_->surface();
    for (Index v = 0; v < cells.vertex_count() && has_numbers; ++v)
      if (to_size(cells.input_vertex(v)) >= request_.surface->positions.size()) {
        proof_.surface = {ProofStatus::Violated,
                          fmt::format("the surface has no vertex {}", cells.input_vertex(v))};
        return;
      }
    if (has_numbers && file_.input_face.size() > 0)
      labels.assign(file_.input_face.begin(), file_.input_face.end());
    const std::vector<char> unmapped = unmapped_polygons();
    const auto left = static_cast<Index>(std::count(unmapped.begin(), unmapped.end(), 1));
    if (request_.unmapped && left != *request_.unmapped) {
      proof_.surface = {ProofStatus::Violated,
                        fmt::format("{} without cells instead of {}", count_text(left, "face"),
                                    *request_.unmapped)};
      return;
    }
    SurfaceMatch match = match_with(*request_.surface, labels, unmapped);
    // A mesh of the plane that is all clockwise may be shown from above.
    if (!match.defect.empty())
      if (const auto turned = turned_counterclockwise(*request_.surface))
        if (SurfaceMatch other = match_with(*turned, labels, unmapped); other.defect.empty())
          match = std::move(other);
    if (!match.defect.empty()) {
      proof_.surface = {ProofStatus::Violated, match.defect};
      return;
    }
    proof_.surface = {ProofStatus::Proven, count_text(match.same + match.changed, "face")};
    proof_.other_triangles = match.changed;
    proof_.unmapped = left;
    if (match.changed > 0)
      proof_.surface.detail += fmt::format(", {} of them in other triangles", match.changed);
    if (left > 0) proof_.surface.detail += fmt::format(", {} more are not mapped", left);
  }

  SurfaceMatch match_with(const PolygonMesh& surface, const std::vector<Index>& labels,
                          const std::vector<char>& unmapped) const {
    SurfaceMatch match =
        match_surface(cut_->surface(), surface, labels, file_.points_rounding, unmapped);
    if (match.defect.empty()) return match;
    return match_repaired(cut_->surface(), surface, labels, request_.orientation,
                          file_.points_rounding, unmapped, polygons_of_file())
        .value_or(match);
  }

  // Returns the polygon of each cell where that is what the file has: labels of a .vtu name faces
  // of the surface, which are compared. None where all polygons are triangles.
  std::vector<Index> polygons_of_file() const {
    if (request_.labels == ProofRequest::FaceLabels::Compared) return {};
    std::vector<Index> polygon(file_.input_face.begin(), file_.input_face.end());
    const std::set<Index> different(polygon.begin(), polygon.end());
    return different.size() < polygon.size() ? polygon : std::vector<Index>();
  }

  // Returns flags by polygon of the surface, none where all are to have cells.
  std::vector<char> unmapped_polygons() const {
    if (request_.coverage == ProofRequest::Coverage::Whole) return {};
    const IndexLists& polygons = request_.surface->polygons;
    std::vector<char> flags(polygons.size(), 0);
    if (request_.labels == ProofRequest::FaceLabels::Compared) {
      std::fill(flags.begin(), flags.end(), 1);
      for (const Index face : file_.input_face)
        if (to_size(face) < flags.size()) flags[face] = 0;
      return flags;
    }
    std::map<std::vector<Index>, Index> left;  // by vertices, the smallest one first
    for (const auto& polygon : file_.unmapped) ++left[from_smallest(polygon)];
    for (std::size_t p = 0; p < flags.size() && !left.empty(); ++p)
      if (const auto entry = left.find(from_smallest(polygons[p])); entry != left.end()) {
        flags[p] = 1;
        if (--entry->second == 0) left.erase(entry);
      }
    return flags;
  }

  template <class Polygon>
  static std::vector<Index> from_smallest(const Polygon& polygon) {
    std::vector<Index> vertices(polygon.begin(), polygon.end());
    std::rotate(vertices.begin(), std::min_element(vertices.begin(), vertices.end()),
                vertices.end());
    return vertices;
  }

  void judge_cuts() {
    const SurfaceMesh& surface = cut_->surface();
    const double close = kSeamClose * cut_->diagonal();
    is_free_.assign(to_size(surface.half_edge_count()), 0);
    AllowedEdges allowed(request_.cut_edges), claimed(request_.cut_edges);
    std::vector<Index> tears;  // differ, and are no edges that may
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

  // Sum of the angles between the tangents of the map at the corners, by vertex of the surface.
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

  // Half-edges that differ, those between layers, and those between charts of stacks: the sides of
  // a fold may agree where one is turned back.
  std::vector<char> borders() const {
    std::vector<char> is_cut = cut_->cuts();
    const SurfaceMesh& surface = cut_->surface();
    for (Index h = 0; h < surface.half_edge_count(); ++h) {
      const Index other = surface.opposite(h);
      if (other < 0) continue;
      const Index cell = face_of(h), beyond = face_of(other);
      if (layer(cell) != layer(beyond) ||
          (stacks_ && stacks_->chart[cell] != stacks_->chart[beyond]))
        is_cut[h] = 1;
    }
    return is_cut;
  }

  Index layer(Index cell) const { return request_.layers.empty() ? 0 : request_.layers[cell]; }
  bool is_upper(Index cell) const {
    return stacks_ && !stacks_->is_first[to_size(stacks_->chart[cell])];
  }

  // Returns the layer of each cell; charts that lie on another one are each a group of their own.
  std::vector<Index> layer_groups() const {
    Index layers = 0;
    for (const Index number : request_.layers) layers = std::max(layers, number + 1);
    std::vector<Index> group;
    for (Index cell = 0; cell < file_.cells.rows(); ++cell)
      group.push_back(is_upper(cell) ? layers + 1 + stacks_->chart[cell] : layer(cell));
    return group;
  }

  // Returns the loops of each layer; of charts that lie on each other those of one alone.
  std::map<Index, BoundaryLoops> layers_of(const BoundaryLoops& all) const {
    std::map<Index, BoundaryLoops> layers;
    std::map<Index, Index> number;  // in its layer, of a chart
    for (const BoundaryLoop& loop : all.loops) {
      const Index cell = face_of(all.half_edge[loop.first]);
      if (is_upper(cell)) continue;
      BoundaryLoops& layer_loops = layers[layer(cell)];
      const auto [chart, is_new] = number.try_emplace(loop.chart, layer_loops.charts);
      layer_loops.charts += is_new;
      const auto first = static_cast<std::ptrdiff_t>(loop.first), last = std::ptrdiff_t{loop.last};
      layer_loops.add_loop(chart->second, {all.curves.begin() + first, all.curves.begin() + last},
                           {all.half_edge.begin() + first, all.half_edge.begin() + last});
    }
    return layers;
  }

  // That of the first layer that overlaps, else of the first that is not decided, with the work of
  // all.
  static GlobalInjectivity worst_of_layers(const std::map<Index, BoundaryLoops>& layers,
                                           const InjectivityOptions& options) {
    const auto rank = [](ProofStatus s) {
      return s == ProofStatus::Violated ? 2 : s == ProofStatus::Undecided ? 1 : 0;
    };
    GlobalInjectivity worst, work;
    worst.result = ProofStatus::Proven;
    for (const auto& [unused, loops] : layers) {
      GlobalInjectivity proof = check_layout(loops, options);
      work.pairs_tested += proof.pairs_tested;
      work.pairs_left += proof.pairs_left;
      work.subdivisions += proof.subdivisions;
      if (rank(proof.result) > rank(worst.result)) worst = std::move(proof);
    }
    worst.pairs_tested = work.pairs_tested;
    worst.pairs_left = work.pairs_left;
    worst.subdivisions = work.subdivisions;
    return worst;
  }

  void judge_overlaps(const BezierMap& plain) {
    if (request_.overlap == ProofRequest::Overlap::NotAsked) return;
    if (is_stopped()) {
      if (request_.overlap == ProofRequest::Overlap::Forbidden)
        proof_.injective = stopped_finding();
      return;
    }
    const InjectivityOptions options{.stopped = [this] { return is_stopped(); }};
    const bool is_layered = stacks_ || !request_.layers.empty();
    const auto check = [&](const BezierMap& map) {
      return is_layered ? worst_of_layers(layers_of(boundary_loops(map)), options)
                        : check_boundary(map, options);
    };
    proof_.global = check(plain);
    if (proof_.global->result != ProofStatus::Proven)
      if (const std::optional<BezierMap> one =
              glued(plain, is_layered ? layer_groups() : std::vector<Index>()))
        proof_.global = check(*one);
    if (request_.overlap == ProofRequest::Overlap::Reported) return;
    const SurfaceMesh& mesh = plain.mesh();  // faces are those of the glued one
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
  std::optional<CutMap> cut_;
  std::vector<char> is_free_;  // half-edges of the surface that are cut and no seam
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
  } catch (const Error&) {  // cells that cannot be put together: a finding
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
  for (const ProofStatus wanted : {ProofStatus::Violated, ProofStatus::Undecided})
    for (const auto& [question, finding] : findings())
      if (finding->answer == wanted) return fmt::format("{}: {}", question, finding->detail);
  return {};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
