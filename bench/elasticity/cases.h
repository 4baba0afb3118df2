// The problems of the elasticity suite (README.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/materials/lame_constants.h"
#include "majorant/framework/problem.h"

namespace majorant::elasticity {

struct Case {
  Problem problem;
  Vec start;  // reduced unknowns
};

// Returns mu = 1 and lambda = 2 nu / (1 - 2 nu), the constants of the suite.
LameConstants constants_of(double nu);

// The unit square or cube at rest, of n cells per side. Each cell has two triangles, or six
// tetrahedra around its diagonal.
template <class Space>
struct Block {
  Block(int n, int degree);
  std::shared_ptr<const Space> space;
  RestShapes rest;
  RowMatrix vertices, nodes;  // positions at rest; nodes: of the space
  Cells cells;
};
using Square = Block<BezierTriangleSpace>;
using Cube = Block<BezierTetrahedronSpace>;

enum class Material { NeoHookean, StableNeoHookean };
// The volume part of a material. Pointwise: U(det F) at every point, as in the suite. GaussNewton:
// the same energy, but the projected Hessian has only first derivatives of the volume. Projected: U
// of the mean of det F on every element, which does not lock at degree 2.
enum class Volume { Pointwise, GaussNewton, Projected };
// Affine: the start is stretched uniformly. MovedEnd: it is at rest except for the pulled end.
enum class Start { Affine, MovedEnd };

// Returns problems in the plane and in space with two opposite sides held at this distance.
Case stretched(const Square& square, Material material, double nu, Volume volume, double stretch,
               Start start);
Case stretched(const Cube& cube, Material material, double nu, Volume volume, double stretch,
               Start start);

// Returns the symmetric Dirichlet problem of degree 1 with a fixed boundary. positions: #V by 2,
// the start.
Case disk(const Square& square, const RowMatrix& positions);
// Returns the stable neo-Hookean problem with a folded start, whose boundary is fixed.
Case folded_solid(const Square& square, const RowMatrix& positions, double nu);
// Returns the untangling problem with a folded start and a fixed boundary. The untangling energy is
// its first term.
Case folded_map(const Square& square, const RowMatrix& positions);
// Returns the number of triangles that are not positively oriented.
int folds(const Square& square, const Vec& x);

// A start in a file of bench/elasticity.py. Each line has the name, the number of rows and the
// coordinates row by row.
struct NamedStart {
  std::string name;
  RowMatrix positions;
};
std::vector<NamedStart> read_starts(const std::string& path);

}  // namespace majorant::elasticity

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
