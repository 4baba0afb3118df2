// Shared code of the tests of io/: a temporary folder, expected errors, small maps.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <string_view>

#include "expected_error.h"
#include "majorant/maps/bezier_cell.h"
#include "majorant/maps/map_file.h"

namespace majorant {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "majorant_io_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, std::string_view content) const {
    std::ofstream stream(file(name), std::ios::binary);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    return file(name);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::size_t entries(const TemporaryFolder& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder.path()), {}));
}

inline std::string content_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// Returns a strip of `cells` Bezier triangles with random control points; neighbours share an edge.
inline MapFile random_strip(int degree, Index cells, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  MapFile map;
  map.degree = degree;
  const Index size = bezier_cell_size(degree);
  map.cells.resize(cells, size);
  const auto first = bezier_edge_points(degree, 0);
  const auto shared = bezier_edge_points(degree, 1);
  Index next = 0;
  for (Index f = 0; f < cells; ++f) {
    map.cells.row(f).setConstant(-1);
    if (f > 0) {  // edge 0 of this cell is edge 1 of the previous one, reversed
      for (int s = 0; s <= degree; ++s) {
        map.cells(f, first[static_cast<std::size_t>(s)]) =
            map.cells(f - 1, shared[static_cast<std::size_t>(degree - s)]);
      }
    }
    for (Index k = 0; k < size; ++k) {
      if (map.cells(f, k) < 0) map.cells(f, k) = next++;
    }
  }
  map.points.resize(next, 3);
  map.uv.resize(next, 2);
  map.input_vertex = Eigen::VectorXi::Constant(next, -1);
  for (double& x : map.points.reshaped()) x = uniform(random);
  for (double& x : map.uv.reshaped()) x = uniform(random);
  Index vertex = 0;
  for (Index f = 0; f < cells; ++f) {
    for (Index k = 0; k < 3; ++k) {
      Index& number = map.input_vertex[map.cells(f, k)];
      if (number < 0) number = vertex++;
    }
  }
  map.input_face = Eigen::VectorXi::LinSpaced(cells, 0, cells - 1);
  map.distortion = Vec::LinSpaced(cells, 4.0, 9.0);
  map.min_det = Vec::Constant(cells, 0.25);
  map.claims = R"({"energy": "symmetric-dirichlet", "note": "<&>\"é\""})";
  return map;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
