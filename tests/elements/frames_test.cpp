// Frames of rest shapes: components of spatial vectors, and shapes with a rotated first axis.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "majorant/elements/rest_shapes.h"
#include "majorant/framework/error.h"
#include "support.h"

namespace majorant {
namespace {

Points3 random_vectors(Index count) {
  test::Random random(5);
  Points3 v(count, 3);
  for (Index f = 0; f < count; ++f) v.row(f) = random.vector(3).transpose();
  return v;
}

// Returns tangents of the rest shape in its own frame: the inverse of M.
Eigen::Matrix2d tangents(const RestShapes& rest, Index f) {
  return Eigen::Matrix2d(rest.inverse_of(f)).inverse();
}

TEST(Frames, TangentsAreTheColumnsOfTheRestShape) {
  const test::Mesh m = test::grid(4, 3, 0.3, 0.5);
  const RestShapes rest = flat_triangles(m.positions, m.faces);
  for (const int corner : {0, 1}) {
    Points3 edges(m.faces.rows(), 3);
    for (Index f = 0; f < m.faces.rows(); ++f)
      edges.row(f) = 1e-3 * (m.positions.row(m.faces(f, corner)) - m.positions.row(m.faces(f, 2)));
    const RowMatrix in = in_frames(m.positions, m.faces, edges);
    for (Index f = 0; f < m.faces.rows(); ++f)
      EXPECT_LE((in.row(f).transpose() - 1e-3 * tangents(rest, f).col(corner)).norm(), 1e-17);
  }
}

TEST(Frames, NormalPartsAreLeftOut) {
  const test::Mesh m = test::grid(4, 3, 0.3, 0.5);
  const Points3 v = random_vectors(static_cast<Index>(m.faces.rows()));
  Points3 off = v;
  for (Index f = 0; f < m.faces.rows(); ++f) {
    const Vector3 p = m.positions.row(m.faces(f, 2));
    const Vector3 a = Vector3(m.positions.row(m.faces(f, 0))) - p;
    const Vector3 b = Vector3(m.positions.row(m.faces(f, 1))) - p;
    off.row(f) += a.cross(b).transpose();
  }
  EXPECT_LE((in_frames(m.positions, m.faces, v) - in_frames(m.positions, m.faces, off)).norm(),
            1e-14);
}

TEST(Frames, RefusesVectorsWithoutADirection) {
  test::Mesh m = test::grid(2, 1);
  Points3 v = Points3::Zero(4, 3);
  v.col(0).setOnes();
  EXPECT_NO_THROW(in_frames(m.positions, m.faces, v));
  EXPECT_THROW(in_frames(m.positions, m.faces, Points3(v.topRows(3))), InvalidArgument);
  for (const Vector3& bad : {Vector3(0, 0, 0), Vector3(0, 0, 2), Vector3(1, NAN, 0)}) {
    Points3 w = v;
    w.row(2) = bad.transpose();
    try {
      in_frames(m.positions, m.faces, w);
      ADD_FAILURE() << bad.transpose();
    } catch (const InvalidArgument& error) {
      EXPECT_NE(std::string(error.what()).find("triangle 2"), std::string::npos) << error.what();
    }
  }
  m.positions.row(m.faces(1, 0)) = m.positions.row(m.faces(1, 1));
  EXPECT_THROW(in_frames(m.positions, m.faces, v), InvalidArgument);
}

TEST(Frames, TurnedShapesHaveTheDirectionFirst) {
  const test::Mesh m = test::grid(4, 3, 0.3, 0.5);
  const RestShapes rest = flat_triangles(m.positions, m.faces);
  const RowMatrix axes =
      in_frames(m.positions, m.faces, random_vectors(static_cast<Index>(m.faces.rows())));
  const RestShapes other = turned(rest, axes);
  EXPECT_EQ(other.measure, rest.measure);
  for (Index f = 0; f < m.faces.rows(); ++f) {
    // The columns of M^-1 M' are the new axes in the old frame.
    const Eigen::Matrix2d turn = tangents(rest, f) * other.inverse_of(f);
    EXPECT_LE((turn.col(0) - axes.row(f).transpose().normalized()).norm(), 1e-13);
    EXPECT_LE((turn.transpose() * turn - Eigen::Matrix2d::Identity()).norm(), 1e-13);
    EXPECT_NEAR(turn.determinant(), 1, 1e-13);
  }
}

TEST(Frames, TurnedTetrahedra) {
  Cells cells(1, 4);
  cells << 0, 1, 2, 3;
  const RowMatrix positions = RowMatrix::Random(4, 3);
  const RestShapes rest = flat_simplices(positions, cells);
  RowMatrix axis(1, 3);
  axis << 1, -2, 0.5;
  const Eigen::Matrix3d turn =
      Eigen::Matrix3d(rest.inverse_of(0)).inverse() * turned(rest, axis).inverse_of(0);
  EXPECT_LE((turn.col(0) - axis.transpose().normalized()).norm(), 1e-12);
  EXPECT_LE((turn.transpose() * turn - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_GT(turn.determinant(), 0);
}

TEST(Frames, TurnedRefusesWrongSizesAndValues) {
  const test::Mesh m = test::grid(2, 1);
  const RestShapes rest = flat_triangles(m.positions, m.faces);
  EXPECT_THROW(turned(rest, RowMatrix::Ones(3, 2)), InvalidArgument);
  EXPECT_THROW(turned(rest, RowMatrix::Ones(4, 3)), InvalidArgument);
  EXPECT_THROW(turned(rest, RowMatrix::Zero(4, 2)), InvalidArgument);
  RowMatrix axes = RowMatrix::Ones(4, 2);
  axes(1, 1) = NAN;
  EXPECT_THROW(turned(rest, axes), InvalidArgument);
  RestShapes curved = rest;
  curved.nodes = RowMatrix::Ones(6, 2);
  EXPECT_THROW(turned(curved, RowMatrix::Ones(4, 2)), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
