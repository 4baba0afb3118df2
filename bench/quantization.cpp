// CPU milliseconds that whole numbers for the arcs of a T-mesh take, the search for the edge length
// included, and how good they are. A row for each mesh and count, without features; last rows:
// means.
//
//     arcs     of the T-mesh; joined: they may have no edges, as quad_mesh() asks first, separate:
//              all have one at least
//     quads    that they make, of those asked
//     off      sum (n - wanted)^2 / max(wanted, 1) over arcs, at the edge length that makes as many
//
// Sample run:
//   build/release/bench/quantization 500,1000,4000,10000 ../shared/data/public/closed/*.obj
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/repair.h"
#include "majorant/quads/internal/aligned_map.h"
#include "majorant/quads/internal/arc_numbers.h"

using namespace majorant;

namespace {

struct Sums {
  double milliseconds = 0;
  int rows = 0;
};

// At the edge length at which the area of the map is that of as many quads.
double off_of(const SeamlessLattice& lattice, const TMesh& t_mesh,
              const std::vector<Index>& edges) {
  const double area = static_cast<double>(lattice.twice_area()) / 2;
  const double length = std::sqrt(area / static_cast<double>(quad_count(t_mesh, edges)));
  double sum = 0;
  for (std::size_t a = 0; a < edges.size(); ++a) {
    const double wanted = static_cast<double>(t_mesh.arcs[a].length()) / length;
    sum += (edges[a] - wanted) * (edges[a] - wanted) / std::max(wanted, 1.0);
  }
  return sum;
}

void measure(const std::string& name, const SeamlessLattice& lattice, const TMesh& t_mesh,
             double count, ArcNumbers::Arcs arcs, Sums& sums) {
  const bool is_joined = arcs == ArcNumbers::Arcs::Joined;
  const std::clock_t start = std::clock();
  std::string made;
  try {
    const std::vector<Index> edges = ArcNumbers(lattice, t_mesh, arcs, {}).for_count(count);
    made = fmt::format("{} | {:.2f}", quad_count(t_mesh, edges), off_of(lattice, t_mesh, edges));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Infeasible) throw;
    made = " | ";
  }
  const double milliseconds =
      1000 * static_cast<double>(std::clock() - start) / static_cast<double>(CLOCKS_PER_SEC);
  sums.milliseconds += milliseconds;
  ++sums.rows;
  fmt::print("| {} | {} | {} | {} | {} | {:.1f} |\n", name, t_mesh.arcs.size(),
             is_joined ? "joined" : "separate", count, made, milliseconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "quantization COUNT,... MESH...\n");
    return 2;
  }
  std::vector<double> counts;
  std::istringstream list(argv[1]);
  for (std::string count; std::getline(list, count, ',');) counts.push_back(std::stod(count));
  fmt::print("| file | arcs | | asked | quads | off | ms |\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  std::vector<Sums> joined(counts.size()), separate(counts.size());
  for (int i = 2; i < argc; ++i) {
    const RepairedSurface surface = repair(read_mesh(argv[i]), {.welding = Welding::EqualPlaces});
    if (surface.mesh->topology().components != 1) continue;
    const std::string name = std::filesystem::path(argv[i]).stem().string();
    const RoomySurface room = with_room(*surface.mesh);
    try {
      RunRecord record;
      SeamlessLattice lattice(room.mesh, aligned_map(room, {}, record).map);
      const TMesh t_mesh = trace_t_mesh(lattice);
      for (std::size_t c = 0; c < counts.size(); ++c) {
        measure(name, lattice, t_mesh, counts[c], ArcNumbers::Arcs::Joined, joined[c]);
        measure(name, lattice, t_mesh, counts[c], ArcNumbers::Arcs::Separate, separate[c]);
      }
    } catch (const Error& error) {
      fmt::print("| {} | | | | {} | | |\n", name, error.what());
    }
  }
  const auto print_mean = [](const char* arcs, double count, const Sums& sums) {
    fmt::print("| mean of {} | | {} | {} | | | {:.1f} |\n", sums.rows, arcs, count,
               sums.milliseconds / std::max(sums.rows, 1));
  };
  for (std::size_t c = 0; c < counts.size(); ++c) {
    print_mean("joined", counts[c], joined[c]);
    print_mean("separate", counts[c], separate[c]);
  }
  return 0;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
