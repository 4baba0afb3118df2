#include "majorant/parametrization/initialization/internal/weighted_tutte.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <numbers>

#include "majorant/framework/error.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

using Neighbours = std::vector<std::vector<Index>>;

Neighbours neighbours_of(const Cells& faces, std::size_t vertices) {
  Neighbours all(vertices);
  for (Index h = 0; h < 3 * static_cast<Index>(faces.rows()); ++h) {
    const Index a = from_vertex(faces, h), b = to_vertex(faces, h);
    all[a].push_back(b);
    all[b].push_back(a);
  }
  for (auto& some : all) {
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
  }
  return all;
}

// The vertices by their distance from the held ones, in edges.
class Layers {
 public:
  Layers(const Neighbours& neighbours, const std::vector<char>& held)
      : neighbours_(neighbours), layer_(held.size(), -1), ring_(held.size(), 0) {
    for (std::size_t v = 0; v < held.size(); ++v)
      if (held[v]) order_.push_back(static_cast<Index>(v));
    const std::size_t free = order_.size();
    for (const Index v : order_) layer_[v] = 0;
    for (std::size_t k = 0; k < order_.size(); ++k)
      for (const Index w : neighbours_[order_[k]])
        if (layer_[w] < 0) {
          layer_[w] = layer_[order_[k]] + 1;
          order_.push_back(w);
        }
    depth_ = layer_[order_.back()];
    order_.erase(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(free));
    measure_rings();
    Parents(*this).find();
  }

  const std::vector<Index>& order() const { return order_; }  // free vertices, layer by layer
  Index parent(Index v) const { return parent_[v]; }
  // Returns the weight of the mean of all neighbours in v's place.
  double share(Index v, double leaning) const {
    return std::min(1.0, leaning * static_cast<double>(ring_[v]) / narrow());
  }

 private:
  // The choice of a parent for each vertex among its neighbours nearer to the boundary, such that
  // as many vertices as possible are parents of one child only. If two vertices of a ring had one
  // parent, ring after ring, the ring would collapse.
  class Parents {
   public:
    explicit Parents(Layers& layers)
        : layers_(layers),
          children_(layers.layer_.size(), 0),
          child_(layers.layer_.size(), -1),
          visited_(layers.layer_.size(), -1) {
      layers_.parent_.assign(layers.layer_.size(), -1);
    }

    void find() {
      for (const Index v : layers_.order_)
        if (layers_.ring_[v] <= layers_.narrow()) claim(v, v);
      for (const Index v : layers_.order_)
        if (Index& p = layers_.parent_[v]; p < 0) {
          for (const Index w : layers_.neighbours_[v])
            if (nearer(w, v) && (p < 0 || children_[w] < children_[p])) p = w;
          ++children_[p];
        }
    }

   private:
    bool nearer(Index w, Index v) const { return layers_.layer_[w] < layers_.layer_[v]; }

    // Searches an augmenting path of the matching of children and parents from v. run: the number
    // of the search.
    bool claim(Index v, Index run) {
      for (const Index p : layers_.neighbours_[v]) {
        if (!nearer(p, v) || visited_[p] == run) continue;
        visited_[p] = run;
        if (child_[p] >= 0 && !claim(child_[p], run)) continue;
        child_[p] = v;
        layers_.parent_[v] = p;
        children_[p] = 1;
        return true;
      }
      return false;
    }

    Layers& layers_;
    std::vector<int> children_;
    std::vector<Index> child_, visited_;
  };

  void measure_rings() {
    UnionFind rings(static_cast<Index>(layer_.size()));
    for (const Index v : order_)
      for (const Index w : neighbours_[v])
        if (layer_[w] == layer_[v]) rings.join(v, w);
    std::vector<Index> size(layer_.size(), 0);
    for (const Index v : order_) ++size[rings.find(v)];
    for (const Index v : order_) ring_[v] = size[rings.find(v)];
  }

  // Returns the number of vertices of a ring that shrinks by exp(-1) over the whole depth.
  double narrow() const { return 2 * std::numbers::pi * depth_; }

  const Neighbours& neighbours_;
  std::vector<Index> order_, parent_;
  std::vector<int> layer_;   // by vertex, 0: held
  std::vector<Index> ring_;  // by vertex: the size of its ring
  int depth_ = 0;
};

}  // namespace

Vec weighted_tutte(const Cells& faces, const std::vector<char>& held, Vec x, double leaning,
                   const std::string& otherwise, const StopCheck& stop) {
  using Matrix = Eigen::SparseMatrix<double>;
  const Neighbours neighbours = neighbours_of(faces, held.size());
  const Layers layers(neighbours, held);
  std::vector<Index> row(held.size(), -1);
  const auto size = static_cast<Index>(layers.order().size());
  if (size == 0) return x;
  for (Index k = 0; k < size; ++k) row[layers.order()[k]] = k;
  Eigen::MatrixX2d rhs = Eigen::MatrixX2d::Zero(size, 2);
  std::vector<Eigen::Triplet<double>> entries;
  for (const Index v : layers.order()) {
    const double share = layers.share(v, leaning);
    entries.emplace_back(row[v], row[v], 1.0);
    const auto subtract = [&](Index w, double weight) {
      if (row[w] >= 0)
        entries.emplace_back(row[v], row[w], -weight);
      else
        rhs.row(row[v]) += weight * x.segment<2>(2 * w).transpose();
    };
    subtract(layers.parent(v), 1 - share);
    const auto count = static_cast<double>(neighbours[v].size());
    for (const Index w : neighbours[v]) subtract(w, share / count);
  }
  Matrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  stop.poll();
  Eigen::SparseLU<Matrix> lu(matrix);
  stop.poll();
  if (lu.info() != Eigen::Success) throw Error(ErrorKind::Infeasible, otherwise);
  Eigen::MatrixX2d p = lu.solve(rhs);
  p += lu.solve(rhs - matrix * p).eval();  // refines the last digits, which narrow rings need
  for (const Index v : layers.order()) x.segment<2>(2 * v) = p.row(row[v]).transpose();
  return x;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
