// A mesh of volumes graded towards a wall, with an energy of one's own: hexahedra whose layers
// become thin at z = 0, by sizes that are asked for, while the box keeps its planes.
//
// Sample run:
//   example_volume_sizes layers.vtu
#include <algorithm>
#include <cmath>
#include <iostream>

#include "majorant/energies/make_energy.h"
#include "majorant/io/volume_files.h"
#include "majorant/volumes/volumes.h"

using namespace majorant;

constexpr int kCells = 6;

int main(int argc, char** argv) {
  if (argc < 2) return std::cerr << "usage: " << argv[0] << " OUT.vtu\n", 1;
  // 1. A box of straight hexahedra, corners in VTK's order, and the edge length that each should
  // have: small at the wall.
  VolumeMesh mesh;
  mesh.file = "box";
  mesh.points.resize((kCells + 1) * (kCells + 1) * (kCells + 1), 3);
  const auto vertex = [](int i, int j, int k) { return (i * (kCells + 1) + j) * (kCells + 1) + k; };
  CellBlock block;
  block.type = {CellShape::Hexahedron, 1};
  block.nodes.resize(kCells * kCells * kCells, 8);
  VolumeOptions options;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j)
      for (int k = 0; k <= kCells; ++k) {
        mesh.points.row(vertex(i, j, k)) << i, j, k;
        if (std::max({i, j, k}) == kCells) continue;
        const auto e = static_cast<Index>(block.numbers.size());
        block.nodes.row(e) << vertex(i, j, k), vertex(i + 1, j, k), vertex(i + 1, j + 1, k),
            vertex(i, j + 1, k), vertex(i, j, k + 1), vertex(i + 1, j, k + 1),
            vertex(i + 1, j + 1, k + 1), vertex(i, j + 1, k + 1);
        block.numbers.push_back(e);
        options.sizes.push_back(0.4 * std::pow(1.4, k));
      }
  block.regions.assign(block.numbers.size(), 1);
  mesh.blocks.push_back(block);

  // 2. An energy of J, the derivative of an element by the cube it should be: one line. It is at
  // its minimum, 0, where J is a rotation, and infinite where an element has no volume.
  options.energy = {{energy_factory(density<3, 3>("volume-and-shape",
                                                  [](const auto& J) {
                                                    using std::log;
                                                    const auto det = J.determinant();
                                                    return J.squaredNorm() - 3 - 2 * log(det);
                                                  })),
                     1.0}};
  // 3. Walls move in themselves, their edges along themselves.
  options.target = VolumeTarget::Size;
  options.boundary = VolumeBoundary::Slide;
  StepObserver print([](const TraceEntry& row, const Vec&) {
    std::cout << "energy " << row.energy << "\n";
    return Directive::Continue;
  });
  RunRecord record(std::numeric_limits<double>::infinity(), 100, nullptr, &print);
  const VolumeResult result = optimize_volume_mesh(mesh, options, record);
  if (!result.is_valid()) return 1;

  // 4. The layers as they are now.
  for (int k = 0; k <= kCells; ++k) std::cout << result.points(vertex(0, 0, k), 2) << " ";
  std::cout << "\nscaled Jacobian at least " << result.after.least_scaled_jacobian() << "\n";
  mesh.points = result.points;
  write_volume_mesh(argv[argc - 1], mesh);
  return result.points(vertex(0, 0, 1), 2) < 0.5 ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
