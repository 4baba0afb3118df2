#include "majorant/io/internal/gmsh_types.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "majorant/volumes/node_orders.h"

namespace majorant {
namespace {

struct GmshType {
  int number;
  CellShape shape;
  int degree;
  NodeSet set = NodeSet::Full;
  CellType type() const { return {shape, degree, NodeKind::Uniform, set}; }
};

// gmsh's numbers of element types.
constexpr auto kGmshTypes = [] {
  using enum CellShape;
  return std::to_array<GmshType>({{15, Point, 1},
                                  {1, Segment, 1},
                                  {8, Segment, 2},
                                  {26, Segment, 3},
                                  {27, Segment, 4},
                                  {28, Segment, 5},
                                  {62, Segment, 6},
                                  {63, Segment, 7},
                                  {64, Segment, 8},
                                  {65, Segment, 9},
                                  {66, Segment, 10},
                                  {2, Triangle, 1},
                                  {9, Triangle, 2},
                                  {21, Triangle, 3},
                                  {23, Triangle, 4},
                                  {25, Triangle, 5},
                                  {42, Triangle, 6},
                                  {43, Triangle, 7},
                                  {44, Triangle, 8},
                                  {45, Triangle, 9},
                                  {46, Triangle, 10},
                                  {3, Quad, 1},
                                  {10, Quad, 2},
                                  {16, Quad, 2, NodeSet::Serendipity},
                                  {36, Quad, 3},
                                  {37, Quad, 4},
                                  {4, Tetrahedron, 1},
                                  {11, Tetrahedron, 2},
                                  {29, Tetrahedron, 3},
                                  {30, Tetrahedron, 4},
                                  {5, Hexahedron, 1},
                                  {12, Hexahedron, 2},
                                  {17, Hexahedron, 2, NodeSet::Serendipity},
                                  {92, Hexahedron, 3},
                                  {93, Hexahedron, 4},
                                  {6, Wedge, 1},
                                  {13, Wedge, 2},
                                  {18, Wedge, 2, NodeSet::Serendipity},
                                  {90, Wedge, 3},
                                  {91, Wedge, 4}});
}();

using Steps = std::array<int, 6>;  // offsets of exponents from one node to the next

Exponents moved(Exponents from, const Steps& steps, int times) {
  for (std::size_t c = 0; c < from.size(); ++c) from[c] += times * steps[c];
  return from;
}

// gmsh's recursive order: corners, edges, faces and the interior. The inner nodes of each are
// ordered like those of a smaller cell. Corner k of a cell of degree n is at from + n * (its
// offset).
class GmshOrder {
 public:
  explicit GmshOrder(std::vector<Exponents> corners, int degree) : degree_(degree) {
    for (const Exponents& corner : corners) {
      Steps steps;
      for (std::size_t c = 0; c < steps.size(); ++c)
        steps[c] = (corner[c] - corners[0][c]) / std::max(degree, 1);
      offsets_.push_back(steps);
    }
    origin_ = corners[0];
  }

  std::vector<Exponents> list(const CellType& type) {
    add(type.shape, origin_, degree_, type.set);
    return std::move(out_);
  }

 private:
  using Edges = std::vector<std::array<int, 2>>;
  using Faces = std::vector<std::vector<int>>;  // each has three or four corners

  Steps between(int a, int b) const {
    Steps steps = offsets_[to_size(b)];
    for (std::size_t c = 0; c < steps.size(); ++c) steps[c] -= offsets_[to_size(a)][c];
    return steps;
  }
  Exponents corner(const Exponents& from, int k, int n) const {
    return moved(from, offsets_[to_size(k)], n);
  }

  void add(CellShape shape, const Exponents& from, int n, NodeSet set = NodeSet::Full) {
    if (n < 0) return;
    if (n == 0) return out_.push_back(from);
    for (int k = 0; k < corner_count(shape); ++k) out_.push_back(corner(from, k, n));
    for (const auto& [a, b] : edges_of(shape))
      for (int s = 1; s < n; ++s) out_.push_back(moved(corner(from, a, n), between(a, b), s));
    if (set == NodeSet::Serendipity) return;
    for (const std::vector<int>& face : faces_of(shape)) add_face(face, from, n);
    add_interior(shape, from, n);
  }

  // Adds the inner nodes of a face, from a corner and the steps to its neighbours on the face.
  void add_face(const std::vector<int>& face, const Exponents& from, int n) {
    const Steps u = between(face[0], face[1]), v = between(face[0], face.back());
    const Exponents inner = moved(moved(corner(from, face[0], n), u, 1), v, 1);
    face.size() == 3 ? add_triangle(inner, u, v, n - 3) : add_quad(inner, u, v, n - 2);
  }

  void add_triangle(const Exponents& o, const Steps& u, const Steps& v, int n) {
    if (n < 0) return;
    if (n == 0) return out_.push_back(o);
    const auto push = [&](int i, int j) { out_.push_back(moved(moved(o, u, i), v, j)); };
    push(0, 0);
    push(n, 0);
    push(0, n);
    for (int s = 1; s < n; ++s) push(s, 0);
    for (int s = 1; s < n; ++s) push(n - s, s);
    for (int s = 1; s < n; ++s) push(0, n - s);
    add_triangle(moved(moved(o, u, 1), v, 1), u, v, n - 3);
  }

  void add_quad(const Exponents& o, const Steps& u, const Steps& v, int n) {
    if (n < 0) return;
    if (n == 0) return out_.push_back(o);
    const auto push = [&](int i, int j) { out_.push_back(moved(moved(o, u, i), v, j)); };
    push(0, 0);
    push(n, 0);
    push(n, n);
    push(0, n);
    for (int s = 1; s < n; ++s) push(s, 0);
    for (int s = 1; s < n; ++s) push(n, s);
    for (int s = 1; s < n; ++s) push(n - s, n);
    for (int s = 1; s < n; ++s) push(0, n - s);
    add_quad(moved(moved(o, u, 1), v, 1), u, v, n - 2);
  }

  void add_interior(CellShape shape, const Exponents& from, int n) {
    const auto inside = [&](std::initializer_list<int> neighbours) {
      Exponents at = from;
      for (const int k : neighbours) at = moved(at, between(0, k), 1);
      return at;
    };
    if (shape == CellShape::Triangle) add_face({0, 1, 2}, from, n);
    if (shape == CellShape::Quad) add_face({0, 1, 2, 3}, from, n);
    if (shape == CellShape::Tetrahedron) add(shape, inside({1, 2, 3}), n - 4);
    if (shape == CellShape::Hexahedron) add(shape, inside({1, 3, 4}), n - 2);
    if (shape != CellShape::Wedge || n < 3) return;
    // Each inner node of the triangle is followed by the nodes of a segment, ends first.
    const std::size_t begin = out_.size();
    add_triangle(inside({1, 2}), between(0, 1), between(0, 2), n - 3);
    const std::vector<Exponents> of_triangle(out_.begin() + static_cast<std::ptrdiff_t>(begin),
                                             out_.end());
    out_.resize(begin);
    for (const Exponents& e : of_triangle) {
      std::vector<int> heights{1};
      if (n > 2) heights.push_back(n - 1);
      for (int k = 2; k < n - 1; ++k) heights.push_back(k);
      for (const int k : heights) out_.push_back(moved(e, between(0, 3), k));
    }
  }

  static Edges edges_of(CellShape shape) {
    switch (shape) {
      case CellShape::Segment:
        return {{0, 1}};
      case CellShape::Triangle:
        return {{0, 1}, {1, 2}, {2, 0}};
      case CellShape::Quad:
        return {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
      case CellShape::Tetrahedron:
        return {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}};
      case CellShape::Wedge:
        return {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}};
      case CellShape::Hexahedron:
        return {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
      default:
        return {};
    }
  }

  static Faces faces_of(CellShape shape) {
    switch (shape) {
      case CellShape::Tetrahedron:
        return {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {3, 1, 2}};
      case CellShape::Wedge:
        return {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}};
      case CellShape::Hexahedron:
        return {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};
      default:
        return {};
    }
  }

  int degree_;
  std::vector<Steps> offsets_;
  Exponents origin_{};
  std::vector<Exponents> out_;
};

}  // namespace

std::optional<CellType> gmsh_type(std::int64_t number) {
  const auto known = std::find_if(kGmshTypes.begin(), kGmshTypes.end(),
                                  [&](const GmshType& t) { return t.number == number; });
  return known == kGmshTypes.end() ? std::nullopt : std::optional(known->type());
}

std::optional<int> gmsh_number(const CellType& type) {
  const auto known = std::find_if(kGmshTypes.begin(), kGmshTypes.end(),
                                  [&](const GmshType& t) { return t.type() == type; });
  return known == kGmshTypes.end() ? std::nullopt : std::optional(known->number);
}

bool is_gmsh_pyramid(std::int64_t number) {
  constexpr std::int64_t kPyramids[] = {7, 14, 19, 118, 119, 120, 121, 122, 123, 124, 125, 132};
  return std::find(std::begin(kPyramids), std::end(kPyramids), number) != std::end(kPyramids);
}

int gmsh_node_count(int number) { return gmsh_type(number)->node_count(); }
int gmsh_dimension(int number) { return dimension(gmsh_type(number)->shape); }

std::vector<int> gmsh_order(const CellType& type) {
  const std::vector<Exponents> places = vtk_order(type.shape, type.degree);
  const auto corners = places.begin() + corner_count(type.shape);
  std::vector<int> out;
  for (const Exponents& e : GmshOrder({places.begin(), corners}, type.degree).list(type))
    out.push_back(static_cast<int>(std::find(places.begin(), places.end(), e) - places.begin()));
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
