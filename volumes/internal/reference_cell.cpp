#include "majorant/volumes/internal/reference_cell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/error.h"
#include "majorant/framework/rounding.h"

namespace majorant {
namespace {

using Rational = boost::multiprecision::cpp_rational;

template <class Space>
BernsteinElement described(int corners, int degree) {
  Cells cell(1, corners);
  for (Index k = 0; k < corners; ++k) cell(0, k) = k;
  return Space(cell, corners, degree).element();
}

// Returns the nodes of a segment, in [0, 1]; symmetric.
std::vector<double> segment_nodes(NodeKind kind, int degree) {
  std::vector<double> x;
  for (int k = 0; k <= degree; ++k) x.push_back(static_cast<double>(k) / degree);
  if (kind != NodeKind::GaussLobatto) return x;
  // The zeros of (1 - x^2) P_n'(x), moved to [0, 1].
  if (degree == 3) x[1] = 0.5 - std::sqrt(0.05);
  if (degree == 4) x[1] = 0.5 - std::sqrt(3.0 / 28);
  for (int k = 0; k < degree; ++k) x[to_size(degree - k)] = 1 - x[to_size(k)];
  return x;
}

// The functions of one factor, and its nodes as barycentric coordinates. Nodes on the lattice are
// exact. Gauss-Lobatto points are those of MFEM: warped and scaled to sum 1, from rounded ones on
// the segment.
template <class Number>
struct Factor {
  std::vector<std::vector<int>> exponents;
  std::vector<std::vector<Number>> inverse;  // control points by nodes

  Factor(NodeKind kind, int corners, int degree) {
    std::vector<int> e(to_size(corners));
    const auto fill = [&](const auto& self, int at, int left) -> void {
      e[to_size(at)] = left;
      if (at + 1 == corners) return exponents.push_back(e);
      for (int k = 0; k <= left; ++k) {
        e[to_size(at)] = k;
        self(self, at + 1, left - k);
      }
    };
    fill(fill, 0, degree);
    const std::vector<double> x = segment_nodes(kind, degree);
    std::vector<std::vector<Number>> rows;
    for (const auto& node : exponents) {
      std::vector<Number> point;
      Number sum = 0;
      for (const int k : node)
        sum +=
            point.emplace_back(kind == NodeKind::GaussLobatto ? Number(x[to_size(k)]) : Number(k));
      for (Number& p : point) p /= sum;
      rows.push_back(values(point, degree));
    }
    invert(std::move(rows));
  }

 private:
  std::vector<Number> values(const std::vector<Number>& point, int degree) const {
    std::vector<Number> out;
    for (const auto& e : exponents) {
      Number value = 1;
      int left = degree;
      for (std::size_t c = 0; c < e.size(); ++c)
        for (int k = 1; k <= e[c]; ++k) value = value * point[c] * Number(left--) / Number(k);
      out.push_back(value);
    }
    return out;
  }
  // Inverts by Gauss-Jordan; the pivot is the largest entry of its column.
  void invert(std::vector<std::vector<Number>> a) {
    const std::size_t n = a.size();
    const auto size = [](const Number& x) { return x < 0 ? Number(-x) : x; };
    inverse.assign(n, std::vector<Number>(n, Number(0)));
    for (std::size_t k = 0; k < n; ++k) inverse[k][k] = 1;
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t pivot = k;
      for (std::size_t r = k + 1; r < n; ++r)
        if (size(a[r][k]) > size(a[pivot][k])) pivot = r;
      std::swap(a[k], a[pivot]);
      std::swap(inverse[k], inverse[pivot]);
      const Number scale = a[k][k];
      for (std::size_t c = 0; c < n; ++c) {
        a[k][c] /= scale;
        inverse[k][c] /= scale;
      }
      for (std::size_t r = 0; r < n; ++r) {
        if (r == k || a[r][k] == 0) continue;
        const Number factor = a[r][k];
        for (std::size_t c = 0; c < n; ++c) {
          a[r][c] -= factor * a[k][c];
          inverse[r][c] -= factor * inverse[k][c];
        }
      }
    }
  }
};

// Returns the place of a node of the full set among the corners, by the exponents of its factors.
int factor_entry(const std::vector<std::vector<int>>& exponents, const int* e, int corners) {
  for (std::size_t k = 0; k < exponents.size(); ++k)
    if (std::equal(exponents[k].begin(), exponents[k].end(), e, e + corners))
      return static_cast<int>(k);
  return -1;
}

// Returns the values at nodes that a serendipity cell does not have, from those on the edges and
// corners of the square or cube around them: f = sum(edges) / 2 - sum(corners) / 4, c = sum(edges)
// / 4 - sum(corners) / 4. Wedges have no node at their centre.
template <class Number>
std::vector<Number> serendipity_row(const Exponents& node, const std::vector<Exponents>& nodes,
                                    int stored) {
  // In a factor whose coordinates are both positive, the node is in the middle.
  const auto is_around = [&](const Exponents& other) {
    for (std::size_t c = 0; c < node.size(); ++c)
      if (node[c] == 0 && other[c] != 0) return false;
    return true;
  };
  std::vector<int> corners, edges;
  for (int k = 0; k < stored; ++k) {
    if (!is_around(nodes[to_size(k)])) continue;
    const bool is_corner = std::none_of(nodes[to_size(k)].begin(), nodes[to_size(k)].end(),
                                        [](int x) { return x == 1; });
    (is_corner ? corners : edges).push_back(k);
  }
  std::vector<Number> row(to_size(stored), Number(0));
  const Number of_edge = Number(1) / Number(corners.size() == 8 ? 4 : 2);
  for (const int k : edges) row[to_size(k)] = of_edge;
  for (const int k : corners) row[to_size(k)] = Number(-1) / Number(4);
  return row;
}

// Returns the matrix, by rows, from the stored nodes to control points.
template <class Number>
std::vector<Number> control_matrix(const CellType& type, const BernsteinElement& element) {
  const std::vector<Exponents> nodes = element.functions(element.degrees());
  const int size = static_cast<int>(nodes.size()), stored = type.node_count();
  std::map<int, Factor<Number>> factors;
  for (const int corners : element.factors)
    factors.try_emplace(corners, type.kind, corners, type.degree);
  std::vector<std::vector<int>> entries;  // of every node, in its factors
  for (const Exponents& e : nodes) {
    auto& entry = entries.emplace_back();
    const int* at = e.data();
    for (const int corners : element.factors) {
      entry.push_back(factor_entry(factors.at(corners).exponents, at, corners));
      at += corners;
    }
  }
  std::vector<Number> out(to_size(size) * to_size(stored), Number(0));
  for (int column = 0; column < size; ++column) {
    std::vector<Number> spread(to_size(stored), Number(0));
    if (column < stored)
      spread[to_size(column)] = 1;
    else
      spread = serendipity_row<Number>(nodes[to_size(column)], nodes, stored);
    for (int row = 0; row < size; ++row) {
      Number weight = 1;
      for (std::size_t f = 0; f < element.factors.size(); ++f)
        weight *=
            factors.at(element.factors[f])
                .inverse[to_size(entries[to_size(row)][f])][to_size(entries[to_size(column)][f])];
      if (weight == 0) continue;
      for (int k = 0; k < stored; ++k)
        out[to_size(row * stored + k)] += weight * spread[to_size(k)];
    }
  }
  return out;
}

}  // namespace

BernsteinElement bernstein_element(CellShape shape, int degree) {
  switch (shape) {
    case CellShape::Triangle:
      return described<BezierTriangleSpace>(3, degree);
    case CellShape::Quad:
      return described<BezierQuadSpace>(4, degree);
    case CellShape::Tetrahedron:
      return described<BezierTetrahedronSpace>(4, degree);
    case CellShape::Wedge:
      return described<BezierWedgeSpace>(6, degree);
    case CellShape::Hexahedron:
      return described<BezierHexahedronSpace>(8, degree);
    default:
      throw InvalidArgument("bernstein_element: points and segments have none");
  }
}

const ReferenceCell& ReferenceCell::of(const CellType& type) {
  thread_local const ReferenceCell* last = nullptr;  // most meshes have cells of one type
  if (last != nullptr && last->type_ == type) return *last;
  static std::mutex mutex;
  static std::map<CellType, std::unique_ptr<const ReferenceCell>> all;
  const std::lock_guard lock(mutex);
  std::unique_ptr<const ReferenceCell>& cell = all[type];
  if (!cell) cell.reset(new ReferenceCell(type));
  last = cell.get();
  return *last;
}

ReferenceCell::ReferenceCell(const CellType& type)
    : type_(type),
      element_(bernstein_element(type.shape, type.degree)),
      basis_(element_.basis(element_.degrees())),
      det_(element_),
      subdivision_(det_.basis(), element_.bisections),
      is_identity_(type.kind == NodeKind::ControlPoints || type.degree == 1) {
  make_control_points();
  make_gradients();
  make_sides();
  make_reflection();
}

void ReferenceCell::make_control_points() {
  const int size = basis_.count(), stored = type_.node_count();
  if (is_identity_) {
    control_points_ = RowMatrix::Identity(size, size);
    return;
  }
  // In quadruple precision, entries that should be 0 have a rounding of about 1e-32.
  constexpr double kZero = 1e-20;
  const std::vector<Float128> weights = control_matrix<Float128>(type_, element_);
  control_points_.resize(size, stored);
  for (int k = 0; k < size * stored; ++k) {
    const auto weight = static_cast<double>(weights[to_size(k)]);
    control_points_(k / stored, k % stored) = std::abs(weight) < kZero ? 0 : weight;
  }
  amplification_ = control_points_.cwiseAbs().rowwise().sum().maxCoeff();
}

const ReferenceCell::ExactMatrix& ReferenceCell::exact_control_points() const {
  std::call_once(exact_made_, [this] {
    const std::vector<Rational> weights =
        is_identity_ ? std::vector<Rational>() : control_matrix<Rational>(type_, element_);
    for (const Rational& w : weights) exact_.denominator = lcm(exact_.denominator, denominator(w));
    for (const Rational& w : weights)
      exact_.numerators.push_back(numerator(w) * (exact_.denominator / denominator(w)));
  });
  return exact_;
}

void ReferenceCell::make_gradients() {
  // Uses the lattice of twice the degree, or one point if J is constant.
  const bool is_affine = type_.degree == 1 && element_.factors.size() == 1;
  const int n = 2 * type_.degree;
  const std::vector<Exponents> points =
      element_.functions(Degrees(element_.factors.size(), is_affine ? 1 : n));
  const Index count = is_affine ? 1 : static_cast<Index>(points.size());
  const int dim = element_.dim();
  sampled_gradients_.resize(dim * count, basis_.count());
  for (Index s = 0; s < count; ++s) {
    std::array<double, Exponents{}.size()> x{};
    for (std::size_t c = 0; c < x.size(); ++c)
      x[c] = static_cast<double>(points[to_size(s)][c]) / (is_affine ? 1 : n);
    const auto formal = [&](int k, int coordinate) {
      Exponents e = basis_.exponents(k);
      double value = basis_.weight(k) * e[to_size(coordinate)]--;
      if (value == 0) return 0.0;
      for (std::size_t c = 0; c < x.size(); ++c) value *= integer_power(x[c], e[c]);
      return value;
    };
    for (int d = 0; d < dim; ++d)
      for (int k = 0; k < basis_.count(); ++k) {
        const auto [plus, minus] = element_.derivatives[to_size(d)];
        sampled_gradients_(dim * s + d, k) = formal(k, plus) - formal(k, minus);
      }
  }
}

void ReferenceCell::make_sides() {
  const std::vector<Exponents> nodes = element_.functions(element_.degrees());
  const int corners = corner_count(type_.shape), stored = type_.node_count();
  const auto weight = [&](const Exponents& node, const Exponents& corner) {
    int product = 1;
    std::size_t c = 0;
    for (const int count : element_.factors)
      for (int k = 0; k < count; ++k, ++c)
        if (corner[c] != 0) product *= node[c];
    return product;
  };
  for (int coordinate = 0; coordinate < element_.coordinate_count(); ++coordinate) {
    Side side;  // where this coordinate is 0
    for (int k = 0; k < corners; ++k)
      if (nodes[to_size(k)][to_size(coordinate)] == 0) side.corners.push_back(k);
    side.loop = loop_of(side.corners);
    for (int k = 0; k < stored; ++k) {
      if (nodes[to_size(k)][to_size(coordinate)] != 0) continue;
      side.nodes.push_back(k);
      auto& weights = side.weights.emplace_back();
      int sum = 0;
      for (const int corner : side.corners)
        sum += weights.emplace_back(weight(nodes[to_size(k)], nodes[to_size(corner)]));
      // Sides of cells with other factors are scaled to the same sum.
      for (int& w : weights) w = w * type_.degree * type_.degree / sum;
    }
    sides_.push_back(std::move(side));
  }
}

std::vector<int> ReferenceCell::loop_of(const std::vector<int>& corners) const {
  const std::vector<Exponents> nodes = element_.functions(element_.degrees());
  const auto place = [&](int corner) {
    Vector3 at = Vector3::Zero();
    for (int d = 0; d < element_.dim(); ++d)
      at[d] = nodes[to_size(corner)][to_size(element_.derivatives[to_size(d)][0])];
    return Vector3(at / type_.degree);
  };
  std::vector<int> loop = corners;
  // Puts the corners of a square in cyclic order. Two corners are opposite if their sum equals that
  // of the other two.
  if (loop.size() == 4)
    for (std::size_t k = 1; k < 4; ++k) {
      const std::size_t a = k % 3 + 1, b = (k + 1) % 3 + 1;
      if (place(corners[0]) + place(corners[k]) == place(corners[a]) + place(corners[b]))
        loop = {corners[0], corners[a], corners[k], corners[b]};
    }
  Vector3 middle = Vector3::Zero();
  for (int k = 0; k < corner_count(type_.shape); ++k) middle += place(k);
  middle /= corner_count(type_.shape);
  const Vector3 first = place(loop[0]), along = place(loop[1]) - first, inward = middle - first;
  const Vector3 other =
      element_.dim() == 2 ? Vector3(Vector3::UnitZ()) : Vector3(place(loop.back()) - first);
  // The interior of a plane cell is to the left of its edges, that of a solid cell below its sides.
  const double sense =
      element_.dim() == 2 ? along.cross(inward).dot(other) : -along.cross(other).dot(inward);
  if (sense < 0) std::reverse(loop.begin(), loop.end());
  return loop;
}

// Exchanges two coordinates of the first simplex, or the first two segments.
void ReferenceCell::make_reflection() {
  const std::vector<Exponents> nodes = element_.functions(element_.degrees());
  const bool is_simplex = element_.factors[0] > 2;
  for (int k = 0; k < type_.node_count(); ++k) {
    Exponents mirrored = nodes[to_size(k)];
    if (is_simplex) {
      std::swap(mirrored[1], mirrored[2]);
    } else {
      std::swap(mirrored[0], mirrored[2]);
      std::swap(mirrored[1], mirrored[3]);
    }
    const auto found = std::find(nodes.begin(), nodes.end(), mirrored);
    reflection_.push_back(static_cast<int>(found - nodes.begin()));
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
