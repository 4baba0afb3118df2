// The elements of the shared test suite. Independent formulas of their maps: element_maps.h. A new
// element is one line of all_elements(), with its space and a mesh: a box with jittered inner
// vertices and straight cells of positive determinant. The line also has the renumberings of a
// cell's corners that preserve its orientation, a quadrature rule and the highest degree to test.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <ostream>

#include "exact_polynomials.h"
#include "majorant/elements/bernstein_space.h"
#include "product_elements.h"
#include "support.h"

namespace majorant::test {

struct CellMesh {
  Cells cells;
  RowMatrix vertices;
};

struct ElementCase {
  std::string name;
  int degree;
  std::function<std::shared_ptr<const BernsteinSpace>(const Cells&, Index, int)> make;
  CellMesh mesh;
  std::vector<std::vector<int>> rotations;
  Quadrature rule;

  std::shared_ptr<const BernsteinSpace> space() const { return space(mesh.cells); }
  std::shared_ptr<const BernsteinSpace> space(const Cells& cells) const {
    return make(cells, static_cast<Index>(mesh.vertices.rows()), degree);
  }
};

inline void PrintTo(const ElementCase& c, std::ostream* out) { *out << c.name << c.degree; }

// ---- Meshes. ----

inline CellMesh triangle_grid() {
  const Mesh mesh = grid(3, 2, 0.25);
  return {mesh.faces, mesh.positions.leftCols<2>()};
}

inline CellMesh quad_grid() {
  const Mesh mesh = grid(3, 2, 0.25);
  Cells cells(6, 4);
  for (int j = 0, e = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i, ++e) {
      const int a = 4 * j + i;
      cells.row(e) << a, a + 1, a + 5, a + 4;
      std::rotate(cells.row(e).data(), cells.row(e).data() + e % 4, cells.row(e).data() + 4);
    }
  return {cells, mesh.positions.leftCols<2>()};
}

// Returns the vertices of 2 by 2 by 2 cubes, the middle one moved.
inline RowMatrix cube_vertices() {
  RowMatrix out(27, 3);
  for (int v = 0; v < 27; ++v) out.row(v) << v % 3, v / 3 % 3, v / 9;
  out.row(13) += Eigen::RowVector3d(0.2, -0.15, 0.1);
  return out;
}

// Returns the lowest vertex of a cube.
inline Index cube_origin(int cube) { return cube % 2 + 3 * (cube / 2 % 2 + 3 * (cube / 4)); }

inline CellMesh hexahedron_grid() {
  CellMesh out{Cells(8, 8), cube_vertices()};
  for (int cube = 0; cube < 8; ++cube)
    for (int k = 0; k < 8; ++k)
      out.cells(cube, k) = cube_origin(cube) + (k + 1) / 2 % 2 + 3 * (k / 2 % 2 + 3 * (k / 4));
  return out;
}

// Returns two wedges per cube.
inline CellMesh wedge_grid() {
  CellMesh out{Cells(16, 6), cube_vertices()};
  for (int cube = 0; cube < 8; ++cube) {
    const Index a = cube_origin(cube), b = a + 1, c = a + 3, d = a + 4;
    out.cells.row(2 * cube) << a, b, d, a + 9, b + 9, d + 9;
    out.cells.row(2 * cube + 1) << d, c, a, d + 9, c + 9, a + 9;
  }
  return out;
}

// Returns six tetrahedra per cube (Kuhn).
inline CellMesh tetrahedron_grid() {
  CellMesh out{Cells(48, 4), cube_vertices()};
  const auto vertex = [](const Eigen::Vector3i& p) { return p[0] + 3 * (p[1] + 3 * p[2]); };
  Index e = 0;
  for (int cube = 0; cube < 8; ++cube) {
    std::array<int, 3> axes{0, 1, 2};
    do {
      Eigen::Vector3i p(cube % 2, cube / 2 % 2, cube / 4);
      out.cells(e, 0) = vertex(p);
      for (int k = 0; k < 3; ++k) {
        ++p[axes[static_cast<std::size_t>(k)]];
        out.cells(e, k + 1) = vertex(p);
      }
      Eigen::Matrix3d edges;
      for (int k = 0; k < 3; ++k)
        edges.row(k) = out.vertices.row(out.cells(e, k + 1)) - out.vertices.row(out.cells(e, 0));
      if (edges.determinant() < 0) std::swap(out.cells(e, 1), out.cells(e, 2));
      ++e;
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  return out;
}

inline std::vector<std::vector<int>> cyclic(int corners) {
  std::vector<std::vector<int>> out;
  for (int shift = 0; shift < corners; ++shift) {
    out.emplace_back();
    for (int k = 0; k < corners; ++k) out.back().push_back((k + shift) % corners);
  }
  return out;
}

inline std::vector<std::vector<int>> even_permutations(int corners) {
  std::vector<std::vector<int>> out;
  std::vector<int> p;
  for (int k = 0; k < corners; ++k) p.push_back(k);
  do {
    int inversions = 0;
    for (std::size_t k = 0; k < p.size(); ++k)
      for (std::size_t j = 0; j < k; ++j) inversions += p[j] > p[k];
    if (inversions % 2 == 0) out.push_back(p);
  } while (std::next_permutation(p.begin(), p.end()));
  return out;
}

// ---- The elements. ----

template <class Space>
void add(std::vector<ElementCase>& out, const char* name, const CellMesh& mesh,
         const std::vector<std::vector<int>>& rotations, const Quadrature& rule, int max_degree) {
  const auto make = [](const Cells& cells, Index vertices, int degree) {
    return std::make_shared<const Space>(cells, vertices, degree);
  };
  for (int n = 1; n <= max_degree; ++n) out.push_back({name, n, make, mesh, rotations, rule});
}

inline std::vector<ElementCase> all_elements() {
  std::vector<ElementCase> out;
  add<BezierTriangleSpace>(out, "triangle", triangle_grid(), cyclic(3), radon_rule(), 5);
  add<BezierTetrahedronSpace>(out, "tetrahedron", tetrahedron_grid(), even_permutations(4),
                              walkington_rule(), 4);
  add<BezierQuadSpace>(out, "quad", quad_grid(), cyclic(4), tensor_gauss_rule(4), 4);
  // Rotated about t, and by 180 degrees about s.
  add<BezierHexahedronSpace>(
      out, "hexahedron", hexahedron_grid(),
      {{0, 1, 2, 3, 4, 5, 6, 7}, {1, 2, 3, 0, 5, 6, 7, 4}, {5, 4, 7, 6, 1, 0, 3, 2}},
      product_rule(tensor_gauss_rule(3), gauss_rule(3)), 3);
  const std::vector<std::vector<int>> of_wedges{
      {0, 1, 2, 3, 4, 5}, {1, 2, 0, 4, 5, 3}, {3, 5, 4, 0, 2, 1}};
  add<BezierWedgeSpace>(out, "wedge", wedge_grid(), of_wedges,
                        product_rule(radon_rule(), gauss_rule(3)), 3);
  add<UprightWedgeSpace>(out, "upright_wedge", wedge_grid(), of_wedges,
                         product_rule(gauss_rule(3), radon_rule()), 3);
  return out;
}

// Returns the elements to which a test applies and for which its cost is acceptable.
inline std::vector<ElementCase> elements_where(
    const std::function<bool(const ElementCase&)>& is_expected) {
  std::vector<ElementCase> out;
  for (ElementCase& c : all_elements())
    if (is_expected(c)) out.push_back(std::move(c));
  return out;
}

// For spatial product elements, bounds differ from corner values already at degree 1.
inline bool is_spatial_product(const BernsteinElement& element) {
  return element.dim() == 3 && element.factors.size() > 1;
}

inline std::string case_name(const testing::TestParamInfo<ElementCase>& info) {
  return info.param.name + std::to_string(info.param.degree);
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
