// What the tests of io/ share: a folder that vanishes, expected errors, small maps.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <string_view>

#include "majorant/framework/error.h"
#include "majorant/io/bezier_cell.h"
#include "majorant/io/map_file.h"

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

inline std::string content_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// The message of the Error of that kind that `action` throws; fails the test if there is none.
inline std::string error_message(ErrorKind kind, const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << "no error was thrown";
  return {};
}

// The folder of public test data, if it is installed on this machine.
inline std::optional<std::filesystem::path> shared_data() {
  const char* variable = std::getenv("MAJORANT_SHARED_DATA");
#ifdef MAJORANT_SHARED_DATA
  const std::string compiled = MAJORANT_SHARED_DATA;
#else
  const std::string compiled;
#endif
  const std::filesystem::path folder = variable != nullptr ? variable : compiled.c_str();
  if (folder.empty()) return std::nullopt;
  for (const char* below : {"", "public", "data/public"}) {
    if (std::filesystem::is_directory(folder / below / "bad")) return folder / below;
  }
  return std::nullopt;
}

// A strip of `cells` Bezier triangles with random control points; neighbours share an edge.
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
    if (f > 0) {  // edge 0 of this cell is edge 1 of the last one, backwards
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
