#include "majorant/constraints/axis_alignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace majorant {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Sets of unknowns that edges tie together, each named by its largest member.
class Lines {
 public:
  explicit Lines(Index unknowns) : parent_(at(unknowns)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  Index of(Index i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  void join(Index i, Index j) {
    i = of(i);
    j = of(j);
    parent_[at(std::min(i, j))] = std::max(i, j);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace

std::vector<Index> edge_nodes(const BezierTriangleSpace& space, Index half_edge) {
  const TriangleIndices& ix = TriangleIndices::of_degree(space.degree());
  std::vector<Index> nodes;
  for (const int local : ix.edge(half_edge % 3))
    nodes.push_back(space.cells()(half_edge / 3, local));
  return nodes;
}

AxisAlignment::AxisAlignment(std::shared_ptr<const BezierTriangleSpace> space,
                             std::vector<AlignedEdge> edges)
    : space_(std::move(space)), edges_(std::move(edges)) {
  for (const AlignedEdge& edge : edges_)
    if (edge.half_edge < 0 || edge.half_edge >= 3 * space_->element_count() ||
        edge.coordinate < 0 || edge.coordinate > 1)
      throw std::invalid_argument(fmt::format("axis alignment: no half-edge {} or no coordinate {}",
                                              edge.half_edge, edge.coordinate));
}

// Every unknown of a line equals the line's last one: rows that are solved without touching each
// other, which a row for each pair of neighbours would not be.
void AxisAlignment::append_rows(ConstraintRows& rows) const {
  Lines lines(2 * space_->node_count());
  for (const AlignedEdge& edge : edges_) {
    const std::vector<Index> nodes = edge_nodes(*space_, edge.half_edge);
    for (const Index node : nodes)
      lines.join(2 * node + edge.coordinate, 2 * nodes[0] + edge.coordinate);
  }
  std::vector<char> written(at(2 * space_->node_count()), 0);
  for (const AlignedEdge& edge : edges_) {
    const Index f = edge.half_edge / 3, k = edge.half_edge % 3;
    for (const Index node : edge_nodes(*space_, edge.half_edge)) {
      const Index unknown = 2 * node + edge.coordinate, last = lines.of(unknown);
      if (unknown == last || written[at(unknown)]) continue;
      written[at(unknown)] = 1;
      rows.begin_row(fmt::format("constant {} along edge ({}, {})",
                                 edge.coordinate == 0 ? 'u' : 'v', space_->faces()(f, k),
                                 space_->faces()(f, (k + 1) % 3)));
      rows.add(unknown, 1);
      rows.add(last, -1);
      rows.end_row(0);
    }
  }
}

}  // namespace majorant
