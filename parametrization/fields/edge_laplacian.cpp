#include "majorant/parametrization/fields/edge_laplacian.h"

#include <algorithm>

namespace majorant {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// The unknowns at both ends of half-edge h, -1 where there is none.
std::array<Index, 2> ends(const Cells& faces, const std::vector<Index>& row_of, Index h) {
  return {row_of[at(faces(h / 3, h % 3))], row_of[at(faces(h / 3, (h + 1) % 3))]};
}

}  // namespace

EdgeLaplacian::EdgeLaplacian(const Cells& faces, const std::vector<Index>& row_of) {
  const Index size = row_of.empty() ? 0 : *std::max_element(row_of.begin(), row_of.end()) + 1;
  const Index half_edges = static_cast<Index>(3 * faces.rows());
  std::vector<std::vector<Index>> below(at(size));
  for (Index h = 0; h < half_edges; ++h) {
    const auto [a, b] = ends(faces, row_of, h);
    if (a >= 0 && b >= 0 && a != b) below[at(std::min(a, b))].push_back(std::max(a, b));
  }
  pattern_.size = size;
  pattern_.column_starts.push_back(0);
  for (Index c = 0; c < size; ++c) {
    auto& rows = below[at(c)];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    pattern_.rows.push_back(c);
    pattern_.rows.insert(pattern_.rows.end(), rows.begin(), rows.end());
    pattern_.column_starts.push_back(pattern_.nonzeros());
    pattern_.block_of.push_back(c);
  }
  for (Index h = 0; h < half_edges; ++h) {
    const auto [a, b] = ends(faces, row_of, h);
    Slots slots{-1, -1, -1};
    if (a == b) {  // x_a - x_b = 0
      slots_.push_back(slots);
      continue;
    }
    if (a >= 0) slots.from = pattern_.column_starts[at(a)];  // the diagonal comes first
    if (b >= 0) slots.to = pattern_.column_starts[at(b)];
    if (a >= 0 && b >= 0) {
      const auto& rows = below[at(std::min(a, b))];
      const auto found = std::lower_bound(rows.begin(), rows.end(), std::max(a, b));
      slots.between =
          pattern_.column_starts[at(std::min(a, b))] + 1 + static_cast<Index>(found - rows.begin());
    }
    slots_.push_back(slots);
  }
}

Vec EdgeLaplacian::values(const Vec& weights) const {
  Vec values = Vec::Zero(pattern_.nonzeros());
  for (std::size_t h = 0; h < slots_.size(); ++h) {
    const double w = weights[static_cast<Index>(h)];
    if (slots_[h].from >= 0) values[slots_[h].from] += w;
    if (slots_[h].to >= 0) values[slots_[h].to] += w;
    if (slots_[h].between >= 0) values[slots_[h].between] -= w;
  }
  return values;
}

}  // namespace majorant
