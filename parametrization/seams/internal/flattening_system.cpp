#include "majorant/parametrization/seams/internal/flattening_system.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/geometry.h"

namespace majorant {
namespace {

// Upper bound on cotangents, and the least area of a vertex relative to the mean. Needles beyond
// these bounds count as lines.
constexpr double kMaxCotangent = 1e3;
constexpr double kMinVertexAreaRatio = 1e-6;

std::size_t longest_loop(const SurfaceMesh& mesh, const std::vector<std::vector<Index>>& loops) {
  std::size_t longest = 0;
  double most = -1;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    double length = 0;
    for (const Index h : loops[l]) length += mesh.edge_length(h);
    if (length > most) most = length, longest = l;
  }
  return longest;
}

// Returns the loop that contains the half-edge, or else its first vertex.
std::size_t loop_through(const SurfaceMesh& mesh, const std::vector<std::vector<Index>>& loops,
                         Index half_edge) {
  std::size_t through_vertex = 0;
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (const Index h : loops[l]) {
      if (h == half_edge) return l;
      if (mesh.from_vertex(h) == mesh.from_vertex(half_edge)) through_vertex = l;
    }
  return through_vertex;
}

}  // namespace

FlatteningSystem::FlatteningSystem(const SurfaceMesh& mesh, Index outer) : mesh_(mesh) {
  measure();
  number_unknowns(outer);
}

void FlatteningSystem::measure() {
  sine_.resize(mesh_.face_count());
  cotangent_.resize(mesh_.half_edge_count());
  defect_ = Vec::Constant(mesh_.vertex_count(), 2 * std::numbers::pi);
  for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
    const CornerAngle angle = corner_angle(mesh_, h);
    defect_[mesh_.from_vertex(h)] -= angle.radians();
    if (corner_of(h) == 0) sine_[face_of(h)] = angle.sine;
    cotangent_[next(h)] = angle.sine * kMaxCotangent > std::abs(angle.cosine)
                              ? angle.cosine / angle.sine
                              : std::copysign(kMaxCotangent, angle.cosine);
  }
}

void FlatteningSystem::number_unknowns(Index outer) {
  unknown_.assign(to_size(mesh_.vertex_count()), -1);
  const std::vector<std::vector<Index>> loops = border_loops<3>(mesh_.opposites());
  const std::size_t left_out = outer >= 0          ? loop_through(mesh_, loops, outer)
                               : genus(mesh_) == 0 ? longest_loop(mesh_, loops)
                                                   : loops.size();
  std::vector<double> load;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    double turning = 2 * std::numbers::pi;  // a hole turns the other way
    for (const Index h : loops[l]) {
      const Index v = mesh_.from_vertex(h);
      defect_[v] -= std::numbers::pi;  // a boundary is straight at pi
      turning += defect_[v];
      if (l != left_out) unknown_[v] = static_cast<Index>(load.size());
    }
    if (l != left_out) load.push_back(turning);
  }
  const std::vector<char> is_boundary = mesh_.boundary_flags();
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    if (is_boundary[v]) continue;
    unknown_[v] = static_cast<Index>(load.size());
    load.push_back(defect_[v]);
  }
  load_ = Eigen::Map<const Vec>(load.data(), static_cast<Index>(load.size()));
}

std::optional<FlatteningSystem::Boundary> FlatteningSystem::boundary(
    const std::vector<char>& is_cut, Index outer) const {
  std::vector<Index> opposite = mesh_.opposites();
  for (std::size_t h = 0; h < opposite.size(); ++h)
    if (is_cut[h]) opposite[h] = -1;
  Boundary boundary{border_loops<3>(opposite), std::vector<char>(to_size(mesh_.vertex_count()), 0)};
  const auto& loops = boundary.loops;
  if (loops.empty()) return boundary;
  boundary.outer = outer >= 0 ? loop_through(mesh_, loops, outer) : longest_loop(mesh_, loops);
  for (const Index h : loops[boundary.outer]) boundary.is_held[mesh_.from_vertex(h)] = 1;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const auto is_known = [&](Index h) {
      return mesh_.opposite(h) < 0 && unknown_[mesh_.from_vertex(h)] >= 0;
    };
    if (l != boundary.outer && !std::ranges::all_of(loops[l], is_known)) return std::nullopt;
  }
  return boundary;
}

FlatteningSystem::Laplacian FlatteningSystem::laplacian(const Boundary& boundary) const {
  // Rows belong to corners: a vertex on the outer loop has one for each fan of faces between cuts.
  std::vector<Index> row(to_size(mesh_.half_edge_count()));
  for (Index h = 0; h < mesh_.half_edge_count(); ++h) row[h] = mesh_.from_vertex(h);
  Index rows = mesh_.vertex_count();
  if (!boundary.loops.empty()) {
    std::vector<char> ends_fan(row.size(), 0);
    const std::vector<Index>& outer = boundary.loops[boundary.outer];
    for (const Index h : outer) ends_fan[h] = 1;
    for (const Index h : outer) {
      row[h] = rows;
      for (Index g = h; !ends_fan[previous(g)];) row[g = mesh_.opposite(previous(g))] = rows;
      ++rows;
    }
  }
  Laplacian result;
  result.area = Vec::Zero(rows);
  Lists& lists = result.rows;
  lists.begin.assign(to_size(rows) + 1, 0);
  for (const Index r : row) ++lists.begin[to_size(r) + 1];
  Index used = 0;
  for (Index r = 0; r < rows; ++r) {
    std::size_t& end = lists.begin[to_size(r) + 1];
    if (end > 0) ++used, end += 2;  // one more than corners, and the diagonal
    end += lists.begin[r];
  }
  lists.end.assign(lists.begin.begin(), lists.begin.end() - 1);
  lists.entries.resize(lists.begin.back());
  const auto add = [&](Index r, Index unknown, double value) {
    for (std::size_t k = lists.begin[r]; k < lists.end[r]; ++k)
      if (lists.entries[k].number == unknown) {
        lists.entries[k].value += value;
        return;
      }
    lists.entries[lists.end[r]++] = {unknown, value};
  };
  const auto unknown_at = [&](Index v) { return boundary.is_held[v] ? -1 : unknown_[v]; };
  for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
    const Index a = row[h], b = row[next(h)];
    result.area[a] += sine_[face_of(h)];
    const Index r = unknown_at(mesh_.from_vertex(h)), s = unknown_at(mesh_.to_vertex(h));
    if (r == s) continue;  // both held, or of one loop
    const double w = 0.5 * cotangent_[h];
    if (r >= 0) add(a, r, w), add(b, r, -w);
    if (s >= 0) add(b, s, w), add(a, s, -w);
  }
  result.area /= result.area.sum();
  result.area = result.area.cwiseMax(kMinVertexAreaRatio / used);
  return result;
}

FlatteningSystem::Lists FlatteningSystem::columns_of(const Lists& rows) const {
  Lists columns;
  columns.begin.assign(to_size(unknowns()) + 1, 0);
  const auto each = [&](const auto& use) {
    for (std::size_t r = 0; r < rows.end.size(); ++r)
      for (std::size_t k = rows.begin[r]; k < rows.end[r]; ++k)
        use(static_cast<Index>(r), rows.entries[k]);
  };
  each([&](Index, const Entry& entry) { ++columns.begin[to_size(entry.number) + 1]; });
  for (std::size_t c = 1; c < columns.begin.size(); ++c) columns.begin[c] += columns.begin[c - 1];
  columns.end.assign(columns.begin.begin(), columns.begin.end() - 1);
  columns.entries.resize(columns.begin.back());
  each([&](Index row, const Entry& entry) {
    columns.entries[columns.end[to_size(entry.number)]++] = {row, entry.value};
  });
  return columns;
}

void FlatteningSystem::analyze() {
  factor_ = std::make_shared<Factor>();
  const Boundary none{{}, std::vector<char>(to_size(mesh_.vertex_count()), 0)};
  const Lists rows = laplacian(none).rows, columns = columns_of(rows);
  std::vector<Index> last(to_size(unknowns()), -1), below;
  for (Index c = 0; c < unknowns(); ++c) {
    below.clear();
    for (std::size_t k = columns.begin[c]; k < columns.end[c]; ++k) {
      const auto r = to_size(columns.entries[k].number);
      for (std::size_t i = rows.begin[r]; i < rows.end[r]; ++i)
        if (const Index u = rows.entries[i].number; u > c && std::exchange(last[u], c) != c)
          below.push_back(u);
    }
    factor_->pattern.append_column(below);
  }
  factor_->pattern.order_in_blocks(1);
  factor_->solver = make_direct_solver();
  factor_->solver->analyze(factor_->pattern);
}

std::shared_ptr<FlatteningSystem::Factor> FlatteningSystem::factorized(const Boundary& boundary,
                                                                       const StopCheck& stop) {
  if (!factor_) analyze();
  stop.poll();
  const SparsePattern& pattern = factor_->pattern;
  const auto [rows, area] = laplacian(boundary);
  const Lists columns = columns_of(rows);
  Vec values(pattern.nonzeros()), sum = Vec::Zero(unknowns());
  double diagonal = 0;
  Index free = 0;
  for (Index c = 0; c < unknowns(); ++c) {
    for (std::size_t k = columns.begin[c]; k < columns.end[c]; ++k) {
      const auto& [row, value] = columns.entries[k];
      const double factor = value / area[row];
      for (std::size_t i = rows.begin[row]; i < rows.end[row]; ++i)
        if (const auto& [u, other] = rows.entries[i]; u >= c) sum[u] += factor * other;
    }
    for (Index slot = pattern.column_starts[c]; slot < pattern.column_starts[c + 1]; ++slot)
      values[slot] = std::exchange(sum[pattern.rows[slot]], 0);
    if (columns.begin[c] < columns.end[c]) ++free, diagonal += values[pattern.diagonal_slot(c)];
  }
  for (Index c = 0; c < unknowns(); ++c)
    if (columns.begin[c] == columns.end[c]) values[pattern.diagonal_slot(c)] = diagonal / free;
  const FactorStatus status =
      factorize_shifted(*factor_->solver, pattern, values, kSmallestShift, stop).status;
  return status == FactorStatus::Ok ? factor_ : nullptr;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
