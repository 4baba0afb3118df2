// Measures quantization, which assigns integers to the arcs of a T-mesh: CPU milliseconds,
// including the search for the edge length, and quality. Rows for each mesh and count; last rows:
// means.
//
//     joined   one search without features; arcs may have 0 edges, like quad_mesh()'s first attempt
//     separate one search without features; all arcs have at least one edge
//     run      all searches of a whole run of quad_mesh(), with features
//     arcs     number of arcs of the T-mesh
//     quads    number of quads, relative to the requested number
//     off      sum (n - t)^2 / max(t, 1) over arcs with target t, at the edge length of that number
//
// Sample run:
//   build/release/bench/quantization 500,1000,4000,10000 ../shared/data/public/closed/*.obj
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/run_record.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/repair.h"
#include "majorant/quads/internal/aligned_map.h"
#include "majorant/quads/internal/quantization_search.h"
#include "majorant/quads/quad_mesh.h"

using namespace majorant;

namespace {

// Measures the quantization of quad_mesh() by its announced activities.
class SearchClock final : public RunObserver {
 public:
  void begin(Activity) override { end(); }
  void announce(std::string_view part) override {
    end();
    if (!part.starts_with("whole numbers")) return;
    start_ = std::clock();
    ++searches_;
  }
  double milliseconds() const { return milliseconds_; }
  int searches() const { return searches_; }

 private:
  void end() {
    if (!start_) return;
    milliseconds_ += 1000 * static_cast<double>(std::clock() - *start_) / CLOCKS_PER_SEC;
    start_.reset();
  }

  std::optional<std::clock_t> start_;
  double milliseconds_ = 0;
  int searches_ = 0;
};

struct Sums {
  double milliseconds = 0;
  int rows = 0;
};

// Returns `off` at the edge length at which the map has the area of these quads.
double off_of(const SeamlessLattice& lattice, const TMesh& t_mesh,
              const std::vector<Index>& edges) {
  const double area = static_cast<double>(lattice.twice_area()) / 2;
  const double length = std::sqrt(area / static_cast<double>(quad_count(t_mesh, edges)));
  double sum = 0;
  for (std::size_t a = 0; a < edges.size(); ++a) {
    const double target = static_cast<double>(t_mesh.arcs[a].length()) / length;
    sum += (edges[a] - target) * (edges[a] - target) / std::max(target, 1.0);
  }
  return sum;
}

void print_row(const std::string& name, const std::string& arcs, const char* kind, double count,
               const std::string& made, int searches, double milliseconds, Sums& sums) {
  sums.milliseconds += milliseconds;
  ++sums.rows;
  fmt::print("| {} | {} | {} | {} | {} | {} | {:.1f} |\n", name, arcs, kind, count, made, searches,
             milliseconds);
  std::fflush(stdout);
}

// Returns the result of make(), or empty cells if there is no quantization.
template <class Make>
std::string made_by(const Make& make) {
  try {
    return make();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Infeasible) throw;
    return " | ";
  }
}

void measure_search(const std::string& name, const SeamlessLattice& lattice, const TMesh& t_mesh,
                    double count, ArcLengths lengths, Sums& sums) {
  const std::clock_t start = std::clock();
  const std::string made = made_by([&] {
    const std::vector<Index> edges =
        QuantizationSearch(lattice, t_mesh, lengths, {}).for_count(count);
    return fmt::format("{} | {:.2f}", quad_count(t_mesh, edges), off_of(lattice, t_mesh, edges));
  });
  print_row(name, std::to_string(t_mesh.arcs.size()),
            lengths == ArcLengths::NonNegative ? "joined" : "separate", count, made, 1,
            1000 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, sums);
}

void measure_run(const std::string& name, const SurfaceMesh& mesh, double count, Sums& sums) {
  SearchClock clock;
  RunRecord record(std::numeric_limits<double>::infinity(), std::numeric_limits<int>::max(),
                   nullptr, &clock);
  QuadMeshOptions options;
  options.count = std::lround(count);
  options.threads = 1;
  const std::string made =
      made_by([&] { return fmt::format("{} | ", quad_mesh(mesh, options, record).check.count); });
  print_row(name, "", "run", count, made, clock.searches(), clock.milliseconds(), sums);
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
  fmt::print("| file | arcs | | asked | quads | off | searches | ms |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  std::vector<Sums> joined(counts.size()), separate(counts.size()), run(counts.size());
  for (int i = 2; i < argc; ++i) {
    const RepairedSurface surface = repair(read_mesh(argv[i]), {.welding = Welding::EqualPlaces});
    if (surface.mesh->topology().components != 1) continue;
    const std::string name = std::filesystem::path(argv[i]).stem().string();
    const ResolvedSurface resolved = resolve_feature_edges(*surface.mesh);
    try {
      RunRecord record;
      SeamlessLattice lattice(resolved.mesh, aligned_map(resolved, {}, record).map);
      const TMesh t_mesh = trace_t_mesh(lattice);
      for (std::size_t c = 0; c < counts.size(); ++c) {
        measure_search(name, lattice, t_mesh, counts[c], ArcLengths::NonNegative, joined[c]);
        measure_search(name, lattice, t_mesh, counts[c], ArcLengths::Positive, separate[c]);
        measure_run(name, *surface.mesh, counts[c], run[c]);
      }
    } catch (const Error& error) {
      fmt::print("| {} | | | | {} | | | |\n", name, error.what());
    }
  }
  const auto print_mean = [](const char* arcs, double count, const Sums& sums) {
    fmt::print("| mean of {} | | {} | {} | | | | {:.1f} |\n", sums.rows, arcs, count,
               sums.milliseconds / std::max(sums.rows, 1));
  };
  for (std::size_t c = 0; c < counts.size(); ++c) {
    print_mean("joined", counts[c], joined[c]);
    print_mean("separate", counts[c], separate[c]);
    print_mean("run", counts[c], run[c]);
  }
  return 0;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
