// Tables of a type of cells: its nodes, the matrix from nodes to control points (in floating point
// and exact), the coefficients of det J and their bisection, the faces.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <memory>
#include <mutex>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/det_coefficients.h"
#include "majorant/elements/positivity.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

using ExactInteger = boost::multiprecision::cpp_int;

// Returns the description of the element with this shape, of two or three dimensions.
BernsteinElement bernstein_element(CellShape shape, int degree);

class ReferenceCell {
 public:
  // Returns the cell of a shape of two or three dimensions and a degree up to CellType::kMaxDegree.
  // It is made at the first call, from any thread.
  static const ReferenceCell& of(const CellType& type);

  const CellType& type() const { return type_; }
  const BernsteinElement& element() const { return element_; }
  const BernsteinBasis& basis() const { return basis_; }  // of the map
  const DetCoefficients& det() const { return det_; }
  const Subdivision& subdivision() const { return subdivision_; }
  bool nodes_are_control_points() const { return is_identity_; }

  // Control points = this times nodes; #control points by #nodes, every weight correctly rounded.
  const RowMatrix& control_points() const { return control_points_; }
  // The largest sum of magnitudes in a row.
  double amplification() const { return amplification_; }

  // The matrix as numerators (by rows) over a common denominator.
  struct ExactMatrix {
    std::vector<ExactInteger> numerators;
    ExactInteger denominator = 1;
  };
  const ExactMatrix& exact_control_points() const;

  // The derivatives by reference coordinates at the points of the lattice on which J is sampled:
  // row dim s + d for point s and direction d, one column for each control point.
  const RowMatrix& sampled_gradients() const { return sampled_gradients_; }

  // A side of the cell; in the plane an edge.
  struct Side {
    std::vector<int> corners;
    std::vector<int> loop;   // the corners in their order around the side, as seen from outside
    std::vector<int> nodes;  // the stored nodes on the side
    std::vector<std::vector<int>> weights;  // of each node on the corners; their sum is degree^2
  };
  const std::vector<Side>& sides() const { return sides_; }

  // The nodes of the turned cell, its mirror image: node k is at the former node reflection()[k].
  // Turning twice restores the cell.
  const std::vector<int>& reflection() const { return reflection_; }

 private:
  explicit ReferenceCell(const CellType& type);
  void make_control_points();
  void make_gradients();
  void make_sides();
  std::vector<int> loop_of(const std::vector<int>& corners) const;
  void make_reflection();

  CellType type_;
  BernsteinElement element_;
  BernsteinBasis basis_;
  DetCoefficients det_;
  Subdivision subdivision_;
  bool is_identity_;
  RowMatrix control_points_, sampled_gradients_;
  double amplification_ = 1;
  std::vector<Side> sides_;
  std::vector<int> reflection_;
  mutable std::once_flag exact_made_;
  mutable ExactMatrix exact_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
