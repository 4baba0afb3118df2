// The order of nodes for every format, cell type and degree, against the programs that define it,
// whose output is in tests/data/node_positions.txt.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "majorant/io/volume_files.h"
#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/node_orders.h"

namespace majorant {
namespace {

namespace fs = std::filesystem;

constexpr double kNear = 1e-9, kNearOne = 1e-5;

using Places = std::vector<std::array<int, 3>>;

int dimension_of(const std::string& shape) {
  const std::string initial = shape.substr(0, 3);
  if (initial == "seg") return 1;
  return initial == "tri" || initial == "qua" ? 2 : 3;
}

// Reads words of digits, one digit per coordinate.
Places places_of(std::istringstream& words) {
  Places out;
  for (std::string word; words >> word;) {
    auto& place = out.emplace_back(std::array<int, 3>{});
    for (std::size_t c = 0; c < word.size(); ++c) place[c] = word[c] - '0';
  }
  return out;
}

// The elements of an MFEM mesh: its text before the nodes.
struct MfemCells {
  std::string text;
  std::size_t elements = 0;
};

class NodePositions : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("majorant_positions_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  VolumeMesh read(const std::string& name, const std::string& content) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << content;
    return read_volume_mesh(path);
  }

  // Expects every node of every cell at its position in the straight cell.
  static void expect_lattice(const VolumeMesh& mesh, std::size_t cells) {
    std::size_t count = 0;
    for (const CellBlock& block : mesh.blocks) {
      const auto weights = corner_weights(block.type.shape, block.type.degree);
      count += to_size(block.size());
      for (Index cell = 0; cell < block.size(); ++cell)
        for (Index k = 0; k < block.nodes.cols(); ++k) {
          Vector3 place = Vector3::Zero();
          double sum = 0;
          for (int c = 0; c < corner_count(block.type.shape); ++c) {
            const double weight = weights[to_size(k)][to_size(c)];
            place += weight * mesh.points.row(block.nodes(cell, c)).transpose();
            sum += weight;
          }
          EXPECT_NEAR((mesh.points.row(block.nodes(cell, k)).transpose() - place / sum).norm(), 0,
                      kNear)
              << describe(block.type) << ", cell " << cell << ", node " << k;
        }
    }
    EXPECT_EQ(count, cells);
  }

  // Expects that the cell is the reference cell.
  static void expect_identity(const VolumeMesh& mesh) {
    if (mesh.dimension() < 2) return;
    const VolumeCheck check = check_volume_mesh(mesh);
    ASSERT_EQ(check.cells.size(), 1u);
    // Bounds of det J include the rounding of Bernstein coefficients.
    EXPECT_NEAR(check.cells[0].range.low, 1, kNearOne);
    EXPECT_NEAR(check.cells[0].range.largest, 1, kNearOne);
  }

 private:
  fs::path folder_;
};

std::string coordinates(const std::array<double, 3>& at, int dim) {
  std::string text;
  for (int c = 0; c < dim; ++c) text += fmt::format("{} ", at[to_size(c)]);
  return text + "\n";
}

std::array<double, 3> uniform(const std::array<int, 3>& place, int degree) {
  std::array<double, 3> at{};
  for (std::size_t c = 0; c < 3; ++c) at[c] = static_cast<double>(place[c]) / degree;
  return at;
}

// Returns MFEM's Gauss-Lobatto nodes of single cells: those of a segment, their products, and on
// simplices barycentric coordinates scaled to the sum 1.
std::array<double, 3> gauss_lobatto(const std::array<int, 3>& place, int degree,
                                    const std::string& shape) {
  const auto on_segment = [&](int k) {
    if (degree < 3) return static_cast<double>(k) / degree;
    const double first = degree == 3 ? 0.5 - std::sqrt(0.05) : 0.5 - std::sqrt(3.0 / 28);
    const std::array<double, 5> nodes = degree == 3
                                            ? std::array<double, 5>{0, first, 1 - first, 1, 0}
                                            : std::array<double, 5>{0, first, 0.5, 1 - first, 1};
    return nodes[to_size(k)];
  };
  std::array<double, 3> at{};
  for (std::size_t c = 0; c < 3; ++c) at[c] = on_segment(place[c]);
  const std::size_t of_simplex = shape == "tetrahedron"                    ? 3
                                 : shape == "triangle" || shape == "wedge" ? 2
                                                                           : 0;
  if (of_simplex == 0) return at;
  int left = degree;
  for (std::size_t c = 0; c < of_simplex; ++c) left -= place[c];
  double sum = on_segment(left);
  for (std::size_t c = 0; c < of_simplex; ++c) sum += at[c];
  for (std::size_t c = 0; c < of_simplex; ++c) at[c] /= sum;
  return at;
}

std::string gmsh_file(const std::string& type, int degree, const Places& places) {
  std::string text =
      fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    text += fmt::format("{} {}", k + 1, coordinates(uniform(places[k], degree), 3));
  text += fmt::format("$EndNodes\n$Elements\n1\n1 {} 2 1 1", type);
  for (std::size_t k = 0; k < places.size(); ++k) text += fmt::format(" {}", k + 1);
  return text + "\n$EndElements\n";
}

std::string medit_file(const std::string& section, int degree, const Places& places) {
  std::string text =
      fmt::format("MeshVersionFormatted 2\nDimension 3\nVertices {}\n", places.size());
  for (const auto& place : places) {
    text += coordinates(uniform(place, degree), 3);
    text.insert(text.size() - 1, "0");
  }
  text += section + " 1\n";
  for (std::size_t k = 0; k < places.size(); ++k) text += fmt::format("{} ", k + 1);
  return text + "1\nEnd\n";
}

std::string vtk_file(const std::string& type, int degree, const Places& places) {
  std::string text = fmt::format(
      "<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"LittleEndian\">"
      "<UnstructuredGrid><Piece NumberOfPoints=\"{}\" NumberOfCells=\"1\"><Points><DataArray "
      "type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n",
      places.size());
  for (const auto& place : places) text += coordinates(uniform(place, degree), 3);
  text +=
      "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
      "format=\"ascii\">\n";
  for (std::size_t k = 0; k < places.size(); ++k) text += fmt::format("{} ", k);
  return text + fmt::format(
                    "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" "
                    "format=\"ascii\">{}</DataArray><DataArray type=\"UInt8\" "
                    "Name=\"types\" format=\"ascii\">{}</DataArray></Cells></Piece>"
                    "</UnstructuredGrid></VTKFile>\n",
                    places.size(), type);
}

// Reads "D x,y,z x,y,z ... G:v,v,v ...": the dimension, positions of vertices, elements.
MfemCells mfem_cells(std::istringstream& words) {
  MfemCells out;
  std::string elements;
  std::size_t vertices = 0;
  int dim = 0;
  words >> dim;
  for (std::string word; words >> word;) {
    const std::size_t colon = word.find(':');
    if (colon == std::string::npos) {
      ++vertices;
      continue;
    }
    ++out.elements;
    for (char& c : word)
      if (c == ':' || c == ',') c = ' ';
    elements += "1 " + word + "\n";
  }
  out.text = fmt::format(
      "MFEM mesh v1.0\ndimension\n{}\nelements\n{}\n{}boundary\n0\nvertices\n{}\nnodes\n"
      "FiniteElementSpace\nFiniteElementCollection: ",
      dim, out.elements, elements, vertices);
  return out;
}

std::string mfem_file(const MfemCells& cells, const std::string& collection, int dim,
                      const std::vector<std::array<double, 3>>& nodes) {
  std::string text = cells.text + fmt::format("{}\nVDim: {}\nOrdering: 1\n\n", collection, dim);
  for (const auto& node : nodes) text += coordinates(node, dim);
  return text;
}

TEST_F(NodePositions, AgreeWithTheProgramsThatDefineThem) {
  std::ifstream table(MAJORANT_SOURCE_DIR "/tests/data/node_positions.txt");
  ASSERT_TRUE(table);
  std::map<std::string, MfemCells> meshes;
  std::map<std::string, int> rows;
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line[0] == '#') continue;
    SCOPED_TRACE(line.substr(0, 60));
    std::istringstream words(line);
    std::string format, name, shape;
    words >> format;
    ++rows[format];
    if (format == "shape") {
      words >> name;
      meshes[name] = mfem_cells(words);
      continue;
    }
    int degree = 0;
    words >> name >> shape >> degree;
    const Places places = places_of(words);
    if (format != "mfem") {
      const VolumeMesh mesh = format == "msh"   ? read("a.msh", gmsh_file(name, degree, places))
                              : format == "vtu" ? read("a.vtu", vtk_file(name, degree, places))
                                                : read("a.mesh", medit_file(name, degree, places));
      expect_lattice(mesh, 1);
      expect_identity(mesh);
      continue;
    }
    // Collections with one order of nodes, separated by commas.
    std::istringstream collections(name);
    for (std::string collection; std::getline(collections, collection, ',');) {
      SCOPED_TRACE(collection);
      const MfemCells& cells = meshes.at(shape);
      const int dim = dimension_of(shape);
      std::vector<std::array<double, 3>> nodes;
      for (const auto& place : places) nodes.push_back(uniform(place, degree));
      const VolumeMesh mesh = read("a.mesh", mfem_file(cells, collection, dim, nodes));
      expect_lattice(mesh, cells.elements);
      if (cells.elements > 1) continue;
      if (collection.starts_with("H1_") || collection.starts_with("H1@G") ||
          collection.starts_with("L2_T1"))
        for (std::size_t k = 0; k < places.size(); ++k)
          nodes[k] = gauss_lobatto(places[k], degree, shape);
      expect_identity(read("a.mesh", mfem_file(cells, collection, dim, nodes)));
    }
  }
  EXPECT_EQ(rows["msh"], 27);
  EXPECT_EQ(rows["vtu"], 63);
  EXPECT_EQ(rows["mesh"], 9);
  EXPECT_GT(rows["mfem"], 90);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
