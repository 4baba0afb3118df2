#include "input.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "../../examples/meshes.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant::tinyad {

void Input::write(const std::string& folder) const {
  std::filesystem::create_directories(folder);
  for (const auto& [name, array] : arrays_) {
    std::ofstream file(folder + "/" + name + ".txt");
    file << array.rows() << " " << array.cols() << "\n";
    for (const auto& row : array.rowwise()) {
      for (const double x : row) file << fmt::format("{:.17g} ", x);
      file << "\n";
    }
    if (!file.flush()) throw std::runtime_error(folder + "/" + name + ".txt: cannot be written");
  }
}

namespace {

struct Polygons {
  RowMatrix positions;
  RowMatrix corners;  // #P by corners; all polygons have equally many
};

Polygons read_polygons(const std::string& path) {
  const PolygonMesh mesh = read_mesh(path);
  const Index count = std::ssize(mesh.polygons), size = std::ssize(mesh.polygons[0]);
  Polygons out{RowMatrix(std::ssize(mesh.positions), 3), RowMatrix(count, size)};
  for (Index v = 0; v < out.positions.rows(); ++v)
    out.positions.row(v) = mesh.positions[to_size(v)].transpose();
  for (Index p = 0; p < count; ++p) {
    if (std::ssize(mesh.polygons[to_size(p)]) != size)
      throw std::runtime_error(path + ": polygons of several sizes");
    for (Index k = 0; k < size; ++k)
      out.corners(p, k) = static_cast<double>(mesh.polygons[to_size(p)][to_size(k)]);
  }
  return out;
}

// Returns n by n quads over the unit square at height z.
template <class Height>
Polygons grid(int n, const Height& z) {
  Polygons out{RowMatrix((n + 1) * (n + 1), 3), RowMatrix(n * n, 4)};
  for (int i = 0, v = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j, ++v) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      out.positions.row(v) << x, y, z(x, y);
    }
  for (int i = 0, q = 0; i < n; ++i)
    for (int j = 0; j < n; ++j, ++q) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      out.corners.row(q) << a, b, b + 1, a + 1;
    }
  return out;
}

// Returns two triangles for each quad.
RowMatrix halved(const RowMatrix& quads) {
  RowMatrix out(2 * quads.rows(), 3);
  for (Index q = 0; q < quads.rows(); ++q) {
    out.row(2 * q) = quads.row(q).head<3>();
    out.row(2 * q + 1) << quads(q, 0), quads(q, 2), quads(q, 3);
  }
  return out;
}

// Returns Tutte's embedding [Tut63] with the boundary on the unit circle, spaced by length.
RowMatrix tutte(const SurfaceMesh& mesh) {
  const Index count = mesh.vertex_count();
  RowMatrix map = RowMatrix::Zero(count, 2);
  std::vector<char> held(to_size(count), 0);
  const std::vector<Index>& loop = mesh.boundary_loops().front();
  double length = 0;
  const auto step = [&](std::size_t k) {
    return (mesh.positions().row(loop[(k + 1) % loop.size()]) - mesh.positions().row(loop[k]))
        .norm();
  };
  for (std::size_t k = 0; k < loop.size(); ++k) length += step(k);
  double at = 0;
  for (std::size_t k = 0; k < loop.size(); at += step(k), ++k) {
    const double angle = 2 * std::numbers::pi * at / length;
    map.row(loop[k]) << std::cos(angle), std::sin(angle);
    held[to_size(loop[k])] = 1;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, 2);
  const auto edge = [&](Index a, Index b) {
    if (held[to_size(a)]) return;
    entries.emplace_back(a, a, 1);
    if (held[to_size(b)])
      right.row(a) += map.row(b);
    else
      entries.emplace_back(a, b, -1);
  };
  for (Index h = 0; h < 3 * mesh.face_count(); ++h) {
    const Index a = mesh.from_vertex(h), b = mesh.to_vertex(h);
    edge(a, b);
    if (mesh.opposite(h) < 0) edge(b, a);
  }
  for (Index v = 0; v < count; ++v)
    if (held[to_size(v)]) {
      entries.emplace_back(v, v, 1);
      right.row(v) = map.row(v);
    }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
}

}  // namespace

Input disk(const std::string& folder) {
  Polygons mesh = grid(24, [](double x, double y) {
    return 0.5 * std::sin(5 * x) * std::cos(4 * y + x) + 0.3 * x * y;
  });
  if (folder.empty())
    mesh.corners = halved(mesh.corners);
  else
    mesh = read_polygons(folder + "/armadillo_cut_low.obj");
  Input input;
  input.set("start", tutte(SurfaceMesh::from_arrays(mesh.positions, mesh.corners.cast<Index>())));
  input.set("positions", mesh.positions);
  input.set("faces", mesh.corners);
  return input;
}

Input cube(const std::string& folder) {
  int n = 6;
  Polygons mesh;
  if (folder.empty()) {
    const ExampleMesh cubes = bar(n, n);  // its axes are the example's z, x and reversed y
    mesh = {-cubes.points(Eigen::all, std::vector{1, 2, 0}) / n, cubes.cells.cast<double>()};
    mesh.corners.col(2).swap(mesh.corners.col(3));
  } else {
    mesh = read_polygons(folder + "/cube_48k.obj");
    n = static_cast<int>(std::lround(std::cbrt(mesh.positions.rows()))) - 1;
  }
  // Four edges of the cube, each given by two points.
  const double ends[4][6] = {
      {0.286031, -0.286031, -0.206107, -0.286031, 0.286031, -0.793893},
      {0, -0.75, 0, 0, -0.75, -0.75},
      {-0.75, 0, 0, -0.75, 0, -0.75},
      {-1.28603, -0.713969, -0.206107, -0.713969, -1.28603, -0.793893},
  };
  const int edges[4] = {0, n, n * (n + 1), n * (n + 2)};
  RowMatrix pins(4 * (n + 1), 1), targets(4 * (n + 1), 3);
  for (int e = 0, row = 0; e < 4; ++e)
    for (int k = 0; k <= n; ++k, ++row) {
      pins(row, 0) = edges[e] + k * (n + 1) * (n + 1);
      for (int c = 0; c < 3; ++c)
        targets(row, c) = ends[e][c] + k * (ends[e][c + 3] - ends[e][c]) / n;
    }
  Input input;
  input.set("positions", mesh.positions);
  input.set("cells", mesh.corners);
  input.set("pins", pins);
  input.set("targets", targets);
  return input;
}

Input sphere(const std::string& folder) {
  Polygons mesh;
  if (folder.empty()) {
    const ExampleMesh ball = octasphere(3);
    mesh = {ball.points, ball.cells.cast<double>()};
    const Eigen::Matrix3d stretch{{1, 0.4, 0}, {0, 1.2, 0.3}, {0.2, 0, 0.3}};
    for (auto p : mesh.positions.rowwise()) p = (p * stretch).normalized();
  } else {
    mesh = read_polygons(folder + "/giraffe_embedding.obj");
  }
  Input input;
  input.set("faces", mesh.corners);
  input.set("start", mesh.positions);
  return input;
}

Input frame_field(const std::string& folder) {
  Polygons mesh;
  if (folder.empty()) {
    const ExampleMesh ball = octasphere(3);
    mesh = {ball.points * Eigen::Vector3d(1, 1.3, 0.8).asDiagonal(), ball.cells.cast<double>()};
  } else {
    mesh = read_polygons(folder + "/cheburashka.off");
  }
  const Cells faces = mesh.corners.cast<Index>();
  const Index count = static_cast<Index>(faces.rows());
  RowMatrix bases(count, 6), start(count, 4);
  std::ifstream field(folder + "/cheburashka.rawfield");
  double skipped = 0;
  field >> skipped >> skipped;
  for (Index f = 0; f < count; ++f) {
    const auto edge = [&](int k) -> Vector3 {
      return mesh.positions.row(faces(f, k)) - mesh.positions.row(faces(f, 0));
    };
    const Vector3 first = edge(1).normalized();
    const Vector3 normal = first.cross(edge(2)).normalized(), second = normal.cross(first);
    bases.row(f) << first.transpose(), second.transpose();
    Vector3 vectors[4] = {{0.2, 0.1, 1}};
    if (folder.empty()) {
      vectors[0] = normal.cross(vectors[0]).normalized();
      vectors[1] = 1.2 * normal.cross(vectors[0]) + 0.3 * vectors[0];
    } else {
      for (Vector3& v : vectors) field >> v[0] >> v[1] >> v[2];
    }
    for (int k = 0; k < 2; ++k)
      start.row(f).segment<2>(2 * k) << first.dot(vectors[k]), second.dot(vectors[k]);
  }
  if (!folder.empty() && !field) throw std::runtime_error(folder + ": no field that fits");
  const SurfaceMesh surface = SurfaceMesh::from_arrays(mesh.positions, faces);
  RowMatrix edges(3 * count / 2, 4);
  for (Index h = 0, e = 0; h < 3 * count; ++h)
    if (h < surface.opposite(h))
      edges.row(e++) << surface.from_vertex(h), surface.to_vertex(h), h / 3,
          surface.opposite(h) / 3;
  Input input;
  input.set("positions", mesh.positions);
  input.set("bases", bases);
  input.set("edges", edges);
  input.set("start", start);
  return input;
}

Input quads(const std::string& folder) {
  Polygons mesh;
  if (folder.empty())
    mesh = grid(10, [](double x, double y) { return 0.2 * std::sin(4 * x) * std::cos(3 * y); });
  else
    mesh = read_polygons(folder + "/bunny.obj");
  const auto size = mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff();
  mesh.positions /= std::cbrt(size.prod());
  Input input;
  input.set("positions", mesh.positions);
  input.set("faces", mesh.corners);
  return input;
}

Input nothing(const std::string&) { return {}; }

}  // namespace majorant::tinyad

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
