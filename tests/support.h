// Shared code of the tests of elements/, energies/ and constraints/: small meshes and maps with
// properties that are known by construction.
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/types.h"
#include "random.h"

namespace majorant::test {

struct Mesh {
  Cells faces;
  Points3 positions;
};

// Returns nx by ny squares of two triangles each; interior vertices are moved by at most `jitter`
// of a square.
inline Mesh grid(int nx, int ny, double jitter = 0, double height = 0, unsigned seed = 1) {
  Random random(seed);
  Mesh m;
  m.positions.resize((nx + 1) * (ny + 1), 3);
  for (int j = 0, v = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i, ++v) {
      const bool inside = i > 0 && j > 0 && i < nx && j < ny;
      const double du = inside ? jitter * random.uniform() : 0;
      const double dv = inside ? jitter * random.uniform() : 0;
      m.positions.row(v) << i + du, j + dv, height * random.uniform();
    }
  m.faces.resize(2 * nx * ny, 3);
  for (int j = 0, f = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
      m.faces.row(f++) << a, b, d;
      m.faces.row(f++) << d, c, a;  // the other triangle begins at the opposite corner
    }
  return m;
}

// Returns the map of `space` that is linear on every face and maps vertex v to uv.row(v).
inline Vec linear_map(const BezierTriangleSpace& space, const Points2& uv) {
  const TriangleIndices& ix = TriangleIndices::of_degree(space.degree());
  Vec x = Vec::Zero(2 * space.node_count());
  for (Index f = 0; f < space.element_count(); ++f)
    for (int l = 0; l < ix.count(); ++l) {
      const MultiIndex& m = ix.multi(l);
      Vector2 p(0, 0);
      for (int k = 0; k < 3; ++k)
        p += m[static_cast<std::size_t>(k)] * uv.row(space.faces()(f, k)).transpose();
      x.segment<2>(2 * space.cells()(f, l)) = p / space.degree();
    }
  return x;
}

inline Points2 flat(const Points3& p) { return p.leftCols<2>(); }

inline Vector2 map_point(const BezierTriangleSpace& space, VecIn x, Index f,
                         const Barycentric& xi) {
  const Vec b = bernstein_values(space.degree(), xi);
  Vector2 p(0, 0);
  for (int l = 0; l < b.size(); ++l) p += b[l] * x.segment<2>(2 * space.cells()(f, l));
  return p;
}

// Returns det J by reference coordinates, directly from basis gradients.
inline double det_at(const BezierTriangleSpace& space, VecIn x, Index f, const Barycentric& xi) {
  const Eigen::MatrixX2d g = bernstein_gradients(space.degree(), xi);
  Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
  for (int l = 0; l < g.rows(); ++l) j += x.segment<2>(2 * space.cells()(f, l)) * g.row(l);
  return j.determinant();
}

// Returns the determinants (twice the areas) of the flat faces of `positions`.
inline Vec rest_determinants(const Mesh& m) {
  Vec d(m.faces.rows());
  for (Index f = 0; f < m.faces.rows(); ++f) {
    const Vector3 a = m.positions.row(m.faces(f, 0)), b = m.positions.row(m.faces(f, 1)),
                  c = m.positions.row(m.faces(f, 2)), u = b - a, v = c - a;
    d[f] = std::sqrt(u.squaredNorm() * v.squaredNorm() - u.dot(v) * u.dot(v));
  }
  return d;
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
