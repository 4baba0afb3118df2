// A symmetric surface, mapped symmetrically: a linear constraint with real coefficients, added to
// what parametrize() solves at every degree, and held exactly by elimination.
//
// Sample run:
//   example_mirror_symmetry examples/meshes/cap.obj cap.vtu
#include <array>
#include <cmath>
#include <iostream>
#include <map>

#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/solve/parametrize.h"

using namespace majorant;

// Nodes b are the mirror images of nodes a in the line at `angle` through the origin.
struct Mirrored final : Constraint {
  std::vector<std::pair<Index, Index>> nodes;  // (a, b); a = b on the line
  double angle = 0;
  void append_rows(ConstraintRows& rows) const override {
    const double c = std::cos(2 * angle), s = std::sin(2 * angle);
    for (const auto& [a, b] : nodes)
      for (const int k : {0, 1}) {
        rows.begin_row("mirrored nodes " + std::to_string(a) + ", " + std::to_string(b));
        rows.add(2 * b + k, 1);
        rows.add(2 * a, k == 0 ? -c : -s);
        rows.add(2 * a + 1, k == 0 ? -s : c);
        rows.end_row(0);
      }
  }
};

// Pairs of nodes whose places on the surface are mirror images in the plane x = 0.
std::vector<std::pair<Index, Index>> mirrored_nodes(const RowMatrix& places) {
  // Files have nine digits: cells of 1e-6 that begin where no mean of such numbers lies.
  const auto cell = [](double x) { return std::lround(1e6 * x + 0.1234567); };
  const auto key = [&](double x, double y, double z) {
    return std::array<long, 3>{cell(x), cell(y), cell(z)};
  };
  std::map<std::array<long, 3>, Index> node_at;
  for (Index k = 0; k < places.rows(); ++k)
    node_at[key(places(k, 0), places(k, 1), places(k, 2))] = k;
  std::vector<std::pair<Index, Index>> pairs;
  for (Index k = 0; k < places.rows(); ++k) {
    const Index image = node_at.at(key(-places(k, 0), places(k, 1), places(k, 2)));
    if (image >= k) pairs.emplace_back(k, image);
  }
  return pairs;
}

int main(int argc, char** argv) {
  if (argc < 3) return std::cerr << "usage: " << argv[0] << " IN.obj OUT.vtu\n", 1;
  auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(argv[1])));
  // 1. The line of symmetry of the start: half way between a boundary vertex and its image.
  ParametrizationOptions options;
  const Vec start = initial_map(*mesh, options.map);
  double angle = 0;
  for (const auto& [a, b] : mirrored_nodes(mesh->positions()))
    if (a == mesh->boundary_loops()[0][0] || b == mesh->boundary_loops()[0][0]) {
      const Vector2 middle =
          start.segment<2>(2 * a).normalized() + start.segment<2>(2 * b).normalized();
      angle = std::atan2(middle.y(), middle.x());
    }
  // 2. At every degree, all nodes come in pairs.
  Mirrored last;
  options.extend = [&](MapExtension& map) {
    last.nodes = mirrored_nodes(map.space().node_positions(mesh->positions()));
    last.angle = angle;
    map.add(last);
  };
  const ParametrizationResult result = parametrize(mesh, options);
  // 3. Symmetric to the last digits.
  const Vec& x = result.map->control_points();
  const double c = std::cos(2 * angle), s = std::sin(2 * angle);
  double off = 0;
  for (const auto& [a, b] : last.nodes) {
    const Vector2 p = x.segment<2>(2 * a), image(c * p.x() + s * p.y(), s * p.x() - c * p.y());
    off = std::max(off, (image - x.segment<2>(2 * b)).norm());
  }
  std::cout << status_name(result.status) << ", energy " << result.measures.value << ", "
            << result.variables << " unknowns, symmetric to " << off << "\n";
  write_vtu(argv[2], to_map_file(*result.map));
  return result.status == Status::Converged && off < 1e-12 ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
