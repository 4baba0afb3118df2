// Compares two placements of quads for one quantization: by rectangles of the motorcycle graph, and
// by integer-grid maps of degree 1, 2 and 3. One row for each mesh and placement, without features.
//
//     degree   of the integer-grid map; "-": rectangles
//     there    whether det J > 0 on every triangle, and the quads are valid and as many as those of
//              the quantization; otherwise the reason
//     J        scaled Jacobian, its mean and its least value
//     angles   mean difference to 90 degrees over corners
//     s        CPU seconds in all, with the seamless map
//
// Last rows: means over the meshes with equally many quads in every placement.
//
// Sample runs:
//   build/release/bench/integer_grid_maps 4000 ../shared/data/public/closed/*.obj
//   build/release/bench/integer_grid_maps 0 ../shared/data/public/disks/*_500.obj   # half the faces
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/repair.h"
#include "majorant/quads/quad_mesh.h"

using namespace majorant;

namespace {

constexpr int kDegrees = 3;

struct Row {
  double count = 0, irregular = 0, mean = 0, min = 0, angles = 0, seconds = 0;
};

// degree: of the integer-grid map; 0: rectangles.
std::optional<Row> row_of(const SurfaceMesh& mesh, long count, int degree, std::string& why) {
  QuadMeshOptions options;
  if (count > 0) options.count = count;
  options.features = std::vector<char>();
  options.threads = 1;
  options.placing = degree == 0 ? QuadPlacing::Rectangles : QuadPlacing::IntegerGrid;
  if (degree > 0) options.first_degree = options.last_degree = degree;
  RunRecord record;
  const std::clock_t start = std::clock();
  try {
    const QuadMesh made = quad_mesh(mesh, options, record);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const QuadCheck& check = made.check;
    return Row{static_cast<double>(check.count),
               static_cast<double>(check.irregular),
               check.mean_scaled_jacobian,
               check.min_scaled_jacobian,
               check.angle_deviation,
               seconds};
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Infeasible) throw;
    why = error.what();
    const std::string prefix = message_prefix(mesh);
    if (why.starts_with(prefix)) why.erase(0, prefix.size());
    return std::nullopt;
  }
}

std::string text_of(int degree) { return degree == 0 ? "-" : std::to_string(degree); }

void print(const std::string& name, int degree, const std::string& there, const Row& row) {
  fmt::print("| {} | {} | {} | {:.0f} | {:.0f} | {:.4f} | {:.3f} | {:.2f} | {:.2f} |\n", name,
             text_of(degree), there, row.count, row.irregular, row.mean, row.min, row.angles,
             row.seconds);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "integer_grid_maps COUNT MESH...\n");
    return 2;
  }
  const long count = std::atol(argv[1]);
  fmt::print("| file | degree | there | quads | irregular | J | min J | angles | s |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|\n");
  std::array<Row, kDegrees + 1> sum{};
  std::array<int, kDegrees + 1> there{};
  int all = 0, complete = 0;
  for (int i = 2; i < argc; ++i) {
    const RepairedSurface surface = repair(read_mesh(argv[i]), {.welding = Welding::EqualPlaces});
    const std::string name = std::filesystem::path(argv[i]).stem().string();
    if (surface.mesh->topology().components != 1) continue;
    ++all;
    std::array<std::optional<Row>, kDegrees + 1> rows;
    bool is_complete = true;
    for (int degree = 0; degree <= kDegrees; ++degree) {
      std::string why;
      const std::optional<Row> row = rows[degree] = row_of(*surface.mesh, count, degree, why);
      is_complete &= row && rows[0] && row->count == rows[0]->count;
      there[degree] += row.has_value();
      if (row)
        print(name, degree, "yes", *row);
      else
        fmt::print("| {} | {} | {} | | | | | | |\n", name, text_of(degree), why);
      std::fflush(stdout);
    }
    if (!is_complete) continue;
    ++complete;
    for (int degree = 0; degree <= kDegrees; ++degree) {
      sum[degree].count += rows[degree]->count;
      sum[degree].irregular += rows[degree]->irregular;
      sum[degree].mean += rows[degree]->mean;
      sum[degree].min += rows[degree]->min;
      sum[degree].angles += rows[degree]->angles;
      sum[degree].seconds += rows[degree]->seconds;
    }
  }
  for (int degree = 0; degree <= kDegrees && complete > 0; ++degree) {
    Row mean = sum[degree];
    for (double* value :
         {&mean.count, &mean.irregular, &mean.mean, &mean.min, &mean.angles, &mean.seconds})
      *value /= complete;
    print("all", degree, fmt::format("{} of {}", there[degree], all), mean);
  }
  return 0;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
