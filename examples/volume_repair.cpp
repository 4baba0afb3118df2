// A curved mesh of volumes, checked and repaired: a quarter of a thick pipe of quadratic
// tetrahedra whose inner nodes were thrown about. What is written is proven to be valid.
//
// Sample run:
//   example_volume_repair pipe.vtu
#include <cmath>
#include <iostream>
#include <numbers>
#include <random>

#include "majorant/io/volume_files.h"
#include "majorant/volumes/volumes.h"

using namespace majorant;

constexpr int kCubes = 3, kNodes = 2 * kCubes + 1;  // along each side

int main(int argc, char** argv) {
  if (argc < 2) return std::cerr << "usage: " << argv[0] << " OUT.vtu\n", 1;
  // 1. Nodes on a grid of half a cube's side: corners of tetrahedra at even places, the middles of
  // their edges between them. Those inside are moved by up to 0.7 of a cube.
  VolumeMesh mesh;
  mesh.file = "pipe";
  mesh.points.resize(kNodes * kNodes * kNodes, 3);
  const auto node = [](const Eigen::Vector3i& at) {
    return (at.x() * kNodes + at.y()) * kNodes + at.z();
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> thrown(-0.7, 0.7);
  for (int i = 0; i < kNodes; ++i)
    for (int j = 0; j < kNodes; ++j)
      for (int k = 0; k < kNodes; ++k) {
        Vector3 p = Vector3(i, j, k) / 2;
        const bool is_inner = std::min({i, j, k}) > 0 && std::max({i, j, k}) < kNodes - 1;
        if (is_inner) p += Vector3(thrown(random), thrown(random), thrown(random));
        const double radius = 2 + p.x(), angle = p.y() / kCubes * std::numbers::pi / 2;
        mesh.points.row(node({i, j, k})) << radius * std::cos(angle), radius * std::sin(angle),
            p.z();
      }
  // 2. Six tetrahedra around the diagonal of each cube, nodes in VTK's order: the corners, then the
  // middles of the edges 01, 12, 20, 03, 13, 23.
  CellBlock block;
  block.type = {CellShape::Tetrahedron, 2};
  block.nodes.resize(6 * kCubes * kCubes * kCubes, 10);
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}};
  constexpr int kEdges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  Index e = 0;
  for (int cube = 0; cube < kCubes * kCubes * kCubes; ++cube)
    for (int t = 0; t < 6; ++t, ++e) {
      Eigen::Vector3i corners[4];
      corners[0] =
          2 * Eigen::Vector3i(cube / (kCubes * kCubes), cube / kCubes % kCubes, cube % kCubes);
      for (int c = 1; c < 4; ++c)
        corners[c] = corners[c - 1] + 2 * Eigen::Vector3i::Unit(kOrders[t][c - 1]);
      if (t >= 3) std::swap(corners[1], corners[2]);  // odd orders turn the other way
      for (int c = 0; c < 4; ++c) block.nodes(e, c) = node(corners[c]);
      for (int m = 0; m < 6; ++m)
        block.nodes(e, 4 + m) = node((corners[kEdges[m][0]] + corners[kEdges[m][1]]) / 2);
      block.numbers.push_back(e);
    }
  block.regions.assign(block.numbers.size(), 1);
  mesh.blocks.push_back(block);

  // 3. Which elements are valid? Not at nodes or quadrature points: all over, proven.
  const VolumeCheck check = check_volume_mesh(mesh);
  std::cout << check.invalid() << " of " << check.cells.size() << " elements have det J <= 0\n";
  for (const CheckedCell* cell : check.worst(3))
    std::cout << "  element " << cell->name.cell << ": least det J in [" << cell->range.low << ", "
              << cell->range.high << "] at " << place_of(mesh, *cell).transpose() << "\n";

  // 4. Untangled and optimized; the boundary stays as it is, bit by bit.
  RunRecord record;
  const VolumeResult result = optimize_volume_mesh(mesh, {}, record);
  std::cout << status_name(result.status) << ": " << result.message << "\n"
            << "untangled in " << result.untangling_iterations << " steps, optimized in "
            << record.trace().size() << "; least scaled Jacobian "
            << result.before.least_scaled_jacobian() << " before, "
            << result.after.least_scaled_jacobian() << " now\n";
  if (!result.is_valid()) return 1;

  // 5. Written, read back, and judged once more.
  mesh.points = result.points;
  write_volume_mesh(argv[argc - 1], mesh, {}, nullptr, [](const VolumeMesh& written) {
    if (!check_volume_mesh(written).is_valid()) throw Error(ErrorKind::Invalid, "not valid");
  });
  return 0;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
