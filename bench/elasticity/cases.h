// The problems of the elasticity suite (README.md), as the minimizers see them.
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

// mu = 1 and lambda = 2 nu / (1 - 2 nu), as the suite has it.
LameConstants constants_of(double nu);

// The unit square or cube of n cells a side, each of two triangles or of six tetrahedra around its
// diagonal, at rest.
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
// The volume part of a material. Pointwise: U(det F) at every point, as the suite has it.
// GaussNewton: the same energy, whose projected Hessian has the first derivatives of the volume
// alone. Projected: U of the mean of det F on every element, which does not lock at degree 2.
enum class Volume { Pointwise, GaussNewton, Projected };
// Affine: the start is stretched; MovedEnd: at rest but for the end that is pulled.
enum class Start { Affine, MovedEnd };

// Two opposite sides held at this distance, in the plane and in space.
Case stretched(const Square& square, Material material, double nu, Volume volume, double stretch,
               Start start);
Case stretched(const Cube& cube, Material material, double nu, Volume volume, double stretch,
               Start start);

// Symmetric Dirichlet of degree 1 with a fixed boundary; positions: #V by 2, the start.
Case disk(const Square& square, const RowMatrix& positions);
// Stable neo-Hookean from a folded start, the boundary fixed where that has it.
Case folded_solid(const Square& square, const RowMatrix& positions, double nu);
// The untangling energy from a folded start, the boundary fixed. It is the first term of the
// problem.
Case folded_map(const Square& square, const RowMatrix& positions);
// Triangles that are not positively oriented.
int folds(const Square& square, const Vec& x);

// The positions of a file of starts (bench/elasticity.py), by name: a line each, the name, the
// number of rows and the coordinates row by row.
struct NamedStart {
  std::string name;
  RowMatrix positions;
};
std::vector<NamedStart> read_starts(const std::string& path);

}  // namespace majorant::elasticity

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
