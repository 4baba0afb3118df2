// Volume meshes optimized: untangled where invalid, fixed where requested, and proven afterwards.
#include "majorant/volumes/optimize_volume_mesh.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

#include "majorant/framework/error.h"
#include "majorant/io/volume_files.h"
#include "majorant/volumes/turned_cells.h"
#include "support.h"

namespace majorant {
namespace {

namespace fs = std::filesystem;
using Vector3i = Eigen::Vector3i;

class OptimizedMeshes : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("majorant_optimized_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  VolumeMesh mesh_of(const std::string& content, const char* name = "a.mesh") const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << content;
    return read_volume_mesh(path);
  }
  static VolumeResult optimized(const VolumeMesh& mesh, const VolumeOptions& options = {}) {
    RunRecord record;
    return optimize_volume_mesh(mesh, options, record);
  }

 private:
  fs::path folder_;
};

// Returns a cube of count^3 unit cubes of six tetrahedra in Medit's format; `moved` gives the
// position of vertex (i, j, k).
std::string cube(int count, const std::function<Vector3(const Vector3&)>& moved) {
  const auto vertex = [&](int i, int j, int k) {
    return 1 + i + (count + 1) * (j + (count + 1) * k);
  };
  std::string text = "MeshVersionFormatted 2\nDimension 3\nVertices " +
                     std::to_string((count + 1) * (count + 1) * (count + 1)) + "\n";
  for (int k = 0; k <= count; ++k)
    for (int j = 0; j <= count; ++j)
      for (int i = 0; i <= count; ++i) {
        const Vector3 at = moved(Vector3(i, j, k));
        for (const double x : at) text += fmt::format("{} ", x);
        text += "0\n";
      }
  text += "Tetrahedra " + std::to_string(6 * count * count * count) + "\n";
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}};
  for (int k = 0; k < count; ++k)
    for (int j = 0; j < count; ++j)
      for (int i = 0; i < count; ++i)
        for (int t = 0; t < 6; ++t) {
          int at[3] = {i, j, k}, corners[4] = {vertex(i, j, k)};
          for (int c = 1; c < 4; ++c) {
            ++at[kOrders[t][c - 1]];
            corners[c] = vertex(at[0], at[1], at[2]);
          }
          if (t >= 3) std::swap(corners[1], corners[2]);
          for (const int c : corners) text += std::to_string(c) + " ";
          text += "1\n";
        }
  return text + "End\n";
}

bool is_inside(const Vector3& at, int count) { return at.minCoeff() > 0 && at.maxCoeff() < count; }

TEST_F(OptimizedMeshes, TangledCubesAreUntangled) {
  test::Random random(1);
  const auto thrown = [&](const Vector3& at) -> Vector3 {
    if (!is_inside(at, 4)) return at;
    return at + Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  };
  const VolumeMesh mesh = mesh_of(cube(4, thrown));
  const VolumeResult result = optimized(mesh);
  EXPECT_GT(result.before.invalid(), 20);
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_TRUE(result.after.is_valid());
  EXPECT_GT(result.untangling_iterations, 0);
  EXPECT_LE(result.value, result.initial_value);
  EXPECT_GT(result.after.least_scaled_jacobian(), 0.3);
  EXPECT_EQ(result.moved_nodes, 27);
  // The boundary is fixed.
  for (Index v = 0; v < mesh.points.rows(); ++v)
    if (!is_inside(mesh.points.row(v).transpose(), 4)) {
      EXPECT_EQ(result.points.row(v), mesh.points.row(v)) << v;
    }
}

// Boundary nodes slide in planes and along edges, and corners are fixed; a free boundary moves in
// all directions.
TEST_F(OptimizedMeshes, BoundariesSlideOrAreFree) {
  const auto graded = [](const Vector3& at) -> Vector3 {
    return at.unaryExpr([](double x) { return 3 * std::pow(x / 3, 1.5); });
  };
  const VolumeMesh mesh = mesh_of(cube(3, graded));
  VolumeOptions options;
  options.target = VolumeTarget::Size;
  options.sizes = {1.0};
  options.boundary = VolumeBoundary::Slide;
  const VolumeResult slid = optimized(mesh, options);
  EXPECT_TRUE(slid.after.is_valid());
  EXPECT_EQ(slid.curved_sides, 0);
  int moved_on_boundary = 0;
  for (Index v = 0; v < mesh.points.rows(); ++v)
    for (int d = 0; d < 3; ++d) {
      const double before = mesh.points(v, d);
      if (before == 0 || before == 3)
        EXPECT_EQ(slid.points(v, d), before) << v;
      else if (!is_inside(mesh.points.row(v).transpose(), 3) && slid.points(v, d) != before)
        ++moved_on_boundary;
    }
  EXPECT_GT(moved_on_boundary, 50);
  options.boundary = VolumeBoundary::Fixed;
  const VolumeResult fixed = optimized(mesh, options);
  EXPECT_LT(slid.value, fixed.value);
  // A free boundary moves at invalid elements; here all are invalid.
  options.boundary = VolumeBoundary::Free;
  EXPECT_EQ(optimized(mesh, options).points, fixed.points);
}

// Returns a cube of count^3 cubes of six quadratic tetrahedra as gmsh's .msh; `moved` gives the
// position of node (i, j, k), by halves of a cube.
std::string quadratic_cube(int count, const std::function<Vector3(const Vector3&)>& moved) {
  const int side = 2 * count + 1;
  const auto node = [&](const Vector3i& at) {
    return 1 + at.x() + side * (at.y() + side * at.z());
  };
  std::string text =
      fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", side * side * side);
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const Vector3 at = moved(Vector3(i, j, k) / 2);
        text += fmt::format("{} {} {} {}\n", node({i, j, k}), at.x(), at.y(), at.z());
      }
  text += fmt::format("$EndNodes\n$Elements\n{}\n", 6 * count * count * count);
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}};
  constexpr int kEdges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};
  int number = 0;
  for (int cube = 0; cube < count * count * count; ++cube)
    for (int t = 0; t < 6; ++t) {
      Vector3i corners[4];
      corners[0] = 2 * Vector3i(cube % count, cube / count % count, cube / count / count);
      for (int c = 1; c < 4; ++c) {
        corners[c] = corners[c - 1];
        corners[c][kOrders[t][c - 1]] += 2;
      }
      if (t >= 3) std::swap(corners[1], corners[2]);
      text += fmt::format("{} 11 2 1 1", ++number);
      for (const Vector3i& corner : corners) text += fmt::format(" {}", node(corner));
      for (const auto& [a, b] : kEdges)
        text += fmt::format(" {}", node((corners[a] + corners[b]) / 2));
      text += "\n";
    }
  return text + "$EndElements\n";
}

// Fixed nodes at midpoints of edges whose ends slide: they are fixed as nodes, not as control
// points, and the written mesh is the proven one.
TEST_F(OptimizedMeshes, NamedNodesOfCurvedElementsStayWhileOthersSlide) {
  const auto graded = [](double x) { return 2 * std::pow(x / 2, 3); };
  std::string text = quadratic_cube(2, [&](const Vector3& at) -> Vector3 {
    return at.unaryExpr(
        [&](double x) { return (graded(std::floor(x)) + graded(std::ceil(x))) / 2; });
  });
  text.replace(text.find("$Elements\n48"), 12, "$Elements\n52");
  std::string points;
  const std::array<Index, 4> named{11, 13, 7, 17};  // rows: the midpoints of the edges of one face
  for (std::size_t k = 0; k < named.size(); ++k)
    points += fmt::format("{} 15 2 9 9 {}\n", 49 + k, named[k] + 1);
  text.insert(text.find("$EndElements"), points);
  const VolumeMesh mesh = mesh_of(text, "a.msh");
  VolumeOptions options;
  options.boundary = VolumeBoundary::Slide;
  const VolumeResult result = optimized(mesh, options);
  EXPECT_TRUE(result.before.is_valid());
  EXPECT_TRUE(result.is_valid()) << result.message;
  EXPECT_LT(result.value, 0.8 * result.initial_value);
  for (const Index row : named) EXPECT_EQ(result.points.row(row), mesh.points.row(row)) << row;
}

// All other nodes keep their bits, also those of curved elements that share control points.
TEST_F(OptimizedMeshes, AFreeBoundaryMovesNodesOfInvalidElementsAndNeighbours) {
  const VolumeMesh mesh =
      mesh_of(quadratic_cube(4,
                             [](const Vector3& at) -> Vector3 {
                               return at == Vector3(1.5, 0, 1) ? Vector3(1.5, 0.9, 1) : at;
                             }),
              "a.msh");
  VolumeOptions options;
  options.boundary = VolumeBoundary::Free;
  RunRecord none(std::numeric_limits<double>::infinity(), 0);
  for (const bool is_solved : {false, true}) {
    const VolumeResult result =
        is_solved ? optimized(mesh, options) : optimize_volume_mesh(mesh, options, none);
    ASSERT_GT(result.before.invalid(), 0);
    EXPECT_TRUE(result.is_valid()) << result.message;
    const Cells& cells = mesh.blocks[0].nodes;
    std::vector<char> is_faulty(static_cast<std::size_t>(cells.rows()), 0), is_near(is_faulty);
    for (std::size_t c = 0; c < is_faulty.size(); ++c)
      is_faulty[c] = result.before.cells[c].range.positive != ProofStatus::Proven;
    std::vector<char> may_move(static_cast<std::size_t>(mesh.points.rows()), 0);
    for (Index c = 0; c < cells.rows(); ++c)
      for (Index other = 0; other < cells.rows(); ++other) {
        if (is_faulty[static_cast<std::size_t>(other)] == 0) continue;
        int common = 0;
        for (Index k = 0; k < 4; ++k)
          for (Index l = 0; l < 4; ++l) common += cells(c, k) == cells(other, l) ? 1 : 0;
        if (common < 3) continue;
        for (const Index node : cells.row(c)) may_move[static_cast<std::size_t>(node)] = 1;
      }
    double largest = 0;
    for (Index v = 0; v < mesh.points.rows(); ++v) {
      const double way = (result.points.row(v) - mesh.points.row(v)).norm();
      largest = std::max(largest, way);
      if (may_move[static_cast<std::size_t>(v)] == 0) {
        EXPECT_EQ(result.points.row(v), mesh.points.row(v)) << v;
      }
    }
    EXPECT_GT(largest, 0);
    EXPECT_NEAR(result.largest_displacement, largest, 1e-12);
  }
}

// The mesh has ten quads of degree 2 under a circular arc, of small size at one end. Nodes on the
// arc slide along the arcs of the quads; the four corners are fixed.
TEST_F(OptimizedMeshes, NodesSlideAlongCurvedSides) {
  constexpr int kCount = 10;
  const auto angle = [](int k) { return 2.4 * std::pow(k / (2.0 * kCount), 1.6) + 0.3; };
  std::string text = "MFEM mesh v1.0\ndimension\n2\nelements\n10\n";
  for (int k = 0; k < kCount; ++k)
    text += fmt::format("1 3 {} {} {} {}\n", k + 1, k, 11 + k, 12 + k);
  text +=
      "boundary\n0\nvertices\n22\nnodes\nFiniteElementSpace\nFiniteElementCollection: "
      "L2_T4_2D_P2\nVDim: 2\nOrdering: 1\n\n";
  for (int k = 0; k < kCount; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const double t = angle(2 * k + 2 - i), radius = 1 + 0.15 * j;
        text += fmt::format("{} {}\n", radius * std::cos(t), radius * std::sin(t));
      }
  const VolumeMesh mesh = mesh_of(text);
  VolumeOptions options;
  options.boundary = VolumeBoundary::Slide;
  const VolumeResult slid = optimized(mesh, options);
  ASSERT_TRUE(slid.before.is_valid());
  EXPECT_TRUE(slid.is_valid()) << slid.message;
  EXPECT_EQ(slid.status, Status::Converged) << slid.message;
  options.boundary = VolumeBoundary::Fixed;
  const VolumeResult fixed = optimized(mesh, options);
  EXPECT_LT(slid.value, fixed.value - 1e-3);
  int moved_on_arcs = 0;
  for (Index v = 0; v < mesh.points.rows(); ++v) {
    const double before = mesh.points.row(v).norm(), after = slid.points.row(v).norm();
    if (std::abs(before - 1) < 1e-9 || std::abs(before - 1.3) < 1e-9) {
      EXPECT_NEAR(after, before, 2e-3) << v;  // the error of quadratic arcs
      moved_on_arcs += slid.points.row(v) != mesh.points.row(v) ? 1 : 0;
    }
  }
  EXPECT_GT(moved_on_arcs, 40);
  // The four corners.
  for (const Index v : {2, 8, 9 * (kCount - 1), 9 * (kCount - 1) + 6})
    EXPECT_EQ(slid.points.row(v), mesh.points.row(v)) << v;
}

// Cells listed in reversed orientation are reversed in their file; cells that a moved node inverts
// are not.
TEST_F(OptimizedMeshes, TurnedCellsAreTurnedBack) {
  const auto identity = [](const Vector3& at) { return at; };
  std::string text = cube(2, identity);
  const VolumeMesh straight = mesh_of(text);
  EXPECT_TRUE(turned_cells(straight).empty());
  // Two tetrahedra, and all of them.
  for (const int every : {24, 1}) {
    std::istringstream lines(text);
    std::string out, line;
    for (int cell = -1; std::getline(lines, line); out += line + "\n") {
      if (line.starts_with("Tetrahedra")) cell = 0;
      if (cell < 0 || line.starts_with("Tetrahedra") || line == "End") continue;
      std::istringstream words(line);
      int nodes[5];
      for (int& node : nodes) words >> node;
      if (cell++ % every == 0)
        line = fmt::format("{} {} {} {} {}", nodes[1], nodes[0], nodes[2], nodes[3], nodes[4]);
    }
    const VolumeMesh mesh = mesh_of(out);
    const std::vector<CellName> cells = turned_cells(mesh);
    ASSERT_EQ(cells.size(), 48u / static_cast<std::size_t>(every));
    EXPECT_EQ(check_volume_mesh(mesh).inverted(), static_cast<Index>(cells.size()));
    const VolumeMesh turned = with_cells_turned(mesh, cells);
    EXPECT_TRUE(check_volume_mesh(turned).is_valid());
    EXPECT_EQ(turned.points, mesh.points);
    const VolumeMesh written = mesh_of(volume_mesh_content("b.mesh", turned), "b.mesh");
    EXPECT_TRUE(check_volume_mesh(written).is_valid());
    EXPECT_EQ(written.points, mesh.points);
  }
  const VolumeMesh tangled = mesh_of(cube(2, [](const Vector3& at) -> Vector3 {
    return at == Vector3(1, 1, 1) ? Vector3(2.5, 1, 1) : at;
  }));
  EXPECT_GT(check_volume_mesh(tangled).inverted(), 0);
  EXPECT_TRUE(turned_cells(tangled).empty());
}

// Cells are reversed in every format and encoding with lists of nodes, also curved cells.
TEST_F(OptimizedMeshes, CellsOfEveryFormatAreTurned) {
  const auto mirrored = [](const Vector3& at) { return Vector3(-at.x(), at.y(), at.z()); };
  const VolumeMesh source = mesh_of(quadratic_cube(1, mirrored), "a.msh");
  const auto expect_turned = [&](const VolumeMesh& mesh, const std::string& name) {
    SCOPED_TRACE(name);
    const VolumeMesh turned = with_cells_turned(mesh, turned_cells(mesh));
    EXPECT_TRUE(check_volume_mesh(turned).is_valid());
    const VolumeMesh written = mesh_of(volume_mesh_content(name, turned), name.c_str());
    EXPECT_TRUE(check_volume_mesh(written).is_valid());
    EXPECT_EQ(written.points, turned.points);
  };
  expect_turned(source, "b.msh");
  using enum GmshVersion;
  for (const GmshVersion version : {Old, New})
    for (const GmshEncoding encoding : {GmshEncoding::Text, GmshEncoding::Binary})
      expect_turned(mesh_of(volume_mesh_content("c.msh", source, {version, encoding}), "c.msh"),
                    "c.msh");
  expect_turned(mesh_of(volume_mesh_content("d.vtu", source), "d.vtu"), "d.vtu");
  // MFEM numbers nodes by the order of vertices: the nodes are reordered in the file.
  for (const char* const collection : {"H1@U_2D_P3", "L2_T4_2D_P3"}) {
    const bool is_continuous = collection[0] == 'H';
    std::string text =
        "MFEM mesh v1.0\ndimension\n2\nelements\n2\n1 3 0 1 4 3\n1 3 1 2 5 4\nboundary\n0\n"
        "vertices\n6\nnodes\nFiniteElementSpace\nFiniteElementCollection: " +
        std::string(collection) + "\nVDim: 2\nOrdering: 1\n\n";
    const int continuous[28][2] = {{0, 0},  {-3, 0}, {-6, 0}, {0, 3},  {-3, 3}, {-6, 3}, {-1, 0},
                                   {-2, 0}, {-3, 1}, {-3, 2}, {-1, 3}, {-2, 3}, {0, 1},  {0, 2},
                                   {-4, 0}, {-5, 0}, {-6, 1}, {-6, 2}, {-4, 3}, {-5, 3}, {-1, 1},
                                   {-2, 1}, {-1, 2}, {-2, 2}, {-4, 1}, {-5, 1}, {-4, 2}, {-5, 2}};
    for (const auto& at : continuous)
      if (is_continuous) text += fmt::format("{} {}\n", at[0], at[1]);
    for (int k = 0; k < 32 && !is_continuous; ++k)
      text += fmt::format("{} {}\n", -(k % 4) - 3 * (k / 16), k % 16 / 4);
    const VolumeMesh mesh = mesh_of(text);
    EXPECT_EQ(check_volume_mesh(mesh).inverted(), 2);
    expect_turned(mesh, "e.mesh");
  }
}

// Coordinates normal to axis-aligned planes are fixed, also where these planes meet others.
TEST_F(OptimizedMeshes, CoordinatesOfPlanesNormalToAnAxisStayBitByBit) {
  const VolumeMesh mesh = mesh_of(cube(4, [](const Vector3& at) -> Vector3 {
    return {0.7 * at.x() + 0.1, at.y() + 0.1, at.z() + 0.25 * at.x() + 0.1};
  }));
  VolumeOptions options;
  options.boundary = VolumeBoundary::Slide;
  const VolumeResult result = optimized(mesh, options);
  EXPECT_TRUE(result.after.is_valid());
  const Vector3 low = mesh.points.colwise().minCoeff(), high = mesh.points.colwise().maxCoeff();
  int moved = 0;
  for (Index v = 0; v < mesh.points.rows(); ++v)
    for (int d = 0; d < 3; ++d) {
      const double before = mesh.points(v, d);
      const bool is_plane = d < 2 && (before == low[d] || before == high[d]);
      if (is_plane)
        EXPECT_EQ(result.points(v, d), before) << v << " " << d;
      else if (result.points(v, d) != before)
        ++moved;
    }
  EXPECT_GT(moved, 100);
}

TEST_F(OptimizedMeshes, UnavoidableInversionsAreNamedBeforehand) {
  // A corner of the cube is moved through the cell that has four boundary vertices.
  const VolumeMesh mesh = mesh_of(cube(2, [](const Vector3& at) -> Vector3 {
    return at == Vector3(2, 0, 0) ? Vector3(1.4, 0.8, 0.2) : at;
  }));
  const VolumeResult result = optimized(mesh);
  EXPECT_EQ(result.status, Status::Infeasible);
  EXPECT_FALSE(result.impossible.empty());
  EXPECT_EQ(result.untangling_iterations, 0);
  EXPECT_EQ(result.points, mesh.points);
}

TEST_F(OptimizedMeshes, UnsupportedMeshesAreRefused) {
  const std::string mirrored = cube(1, [](const Vector3& at) -> Vector3 {
    return {-at.x(), at.y(), at.z()};
  });
  EXPECT_THROW(optimized(mesh_of(mirrored)), Error);
  const std::string surface =
      "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n1 1 1 0\n"
      "Triangles 2\n1 2 3 0\n2 4 3 0\nEnd\n";
  EXPECT_THROW(optimized(mesh_of(surface)), Error);
  VolumeOptions options;
  options.target = VolumeTarget::Size;
  const VolumeMesh unit = mesh_of(cube(1, [](const Vector3& at) { return at; }));
  for (const std::vector<double>& sizes :
       {std::vector<double>{1, 2}, {0.0}, {-1.0}, {1e-110}, {1e110}, {std::nan("")}}) {
    options.sizes = sizes;
    EXPECT_THROW(optimized(unit, options), InvalidArgument) << sizes[0];
  }
}

// Two triangles, one of them inverted: the sum of their areas is 0.
TEST_F(OptimizedMeshes, AreasThatCancelHaveASize) {
  const VolumeMesh mesh = mesh_of(
      "MeshVersionFormatted 2\nDimension 2\nVertices 4\n0 0 0\n1 0 0\n0 1 0\n0 0 0\n"
      "Triangles 2\n1 2 3 1\n2 4 3 1\nEnd\n");
  VolumeOptions options;
  options.boundary = VolumeBoundary::Free;
  const VolumeResult result = optimized(mesh, options);
  EXPECT_EQ(result.before.invalid(), 1);
  EXPECT_TRUE(result.is_valid()) << result.message;
  EXPECT_GT(result.after.least_scaled_jacobian(), 0.99);
}

// A fan that can be untangled, and one that cannot, since its boundary is not star-shaped. Reported
// values are those of the result of untangling.
TEST_F(OptimizedMeshes, FailedUntanglingReportsItsLastState) {
  std::string points = "0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n1.5 0.5 0 0\n";
  std::string cells = "1 2 5 0\n2 3 5 0\n3 4 5 0\n4 1 5 0\n";
  const std::vector<Vector2> horseshoe{{0, 0}, {3, 0}, {3, 3}, {2, 3},
                                       {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (const Vector2& at : horseshoe) points += fmt::format("{} {} 0 0\n", at.x() + 5, at.y());
  points += "6.5 0.5 0 0\n";
  for (int k = 0; k < 8; ++k) cells += fmt::format("{} {} 14 0\n", 6 + k, 6 + (k + 1) % 8);
  const VolumeMesh mesh = mesh_of("MeshVersionFormatted 2\nDimension 3\nVertices 14\n" + points +
                                  "Triangles 12\n" + cells + "End\n");
  const VolumeResult result = optimized(mesh);
  EXPECT_EQ(result.status, Status::Infeasible);
  EXPECT_FALSE(result.is_valid());
  EXPECT_TRUE(result.impossible.empty());
  EXPECT_EQ(result.before.cells[1].range.positive, ProofStatus::Violated);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(result.after.cells[k].range.positive, ProofStatus::Proven) << k;
  EXPECT_GT(result.after.invalid(), 0);
  EXPECT_LT(result.points(4, 0), 1);
}

// A triangle of degree 3, x = f(u), y = v with f' = 0.002 + 3 (u - 1/3)^2: proofs of the usual
// depth fail, the deepest succeed.
TEST_F(OptimizedMeshes, NarrowlyValidMeshesAreNotUntangled) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n";
  constexpr int kNodes[10][2] = {{0, 0}, {3, 0}, {0, 3}, {1, 0}, {2, 0},
                                 {2, 1}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
  for (int k = 0; k < 10; ++k) {
    const double u = kNodes[k][0] / 3.0, v = kNodes[k][1] / 3.0;
    text += fmt::format("{} {} {} 0\n", k + 1, 0.002 * u + std::pow(u - 1.0 / 3, 3), v);
  }
  text += "$EndNodes\n$Elements\n1\n1 21 2 0 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n";
  const VolumeMesh mesh = mesh_of(text, "a.msh");
  const VolumeResult result = optimized(mesh);
  EXPECT_TRUE(result.before.is_valid());
  EXPECT_EQ(result.untangling_iterations, 0);
  EXPECT_NE(result.status, Status::Infeasible) << result.message;
  EXPECT_TRUE(result.is_valid());
  EXPECT_LE(result.value, result.initial_value);
}

TEST_F(OptimizedMeshes, LimitsLeaveAValidMesh) {
  const VolumeMesh mesh = mesh_of(cube(3, [](const Vector3& at) -> Vector3 {
    return is_inside(at, 3) ? Vector3(at + Vector3(0.2, 0.1, -0.2)) : at;
  }));
  RunRecord none(std::numeric_limits<double>::infinity(), 0);
  const VolumeResult untouched = optimize_volume_mesh(mesh, {}, none);
  EXPECT_EQ(untouched.status, Status::MaxIterations);
  EXPECT_TRUE(untouched.after.is_valid());
  EXPECT_EQ(untouched.points, mesh.points);
  RunRecord one(std::numeric_limits<double>::infinity(), 1);
  const VolumeResult moved = optimize_volume_mesh(mesh, {}, one);
  EXPECT_EQ(moved.status, Status::MaxIterations);
  EXPECT_TRUE(moved.after.is_valid());
  EXPECT_EQ(one.trace().size(), 1u);
}

// Nodes of curved elements that no step has moved are not computed from control points.
TEST_F(OptimizedMeshes, WithoutAStepNodesOfCurvedElementsStay) {
  std::string text = "MeshVersionFormatted 2\nDimension 2\nVertices 9\n";
  for (const char* const at : {"0 0", "2.1 0.1", "0.1 2.2", "2 2.1", "1.01 0.13", "1.1 1.03",
                               "0.17 1.11", "2.09 1.07", "1.07 2.19"})
    text += fmt::format("{} 0\n", at);
  text += "TrianglesP2 2\n1 2 3 5 6 7 1\n2 4 3 8 9 6 1\nEnd\n";
  const VolumeMesh mesh = mesh_of(text);
  for (const VolumeBoundary boundary :
       {VolumeBoundary::Fixed, VolumeBoundary::Slide, VolumeBoundary::Free}) {
    RunRecord none(std::numeric_limits<double>::infinity(), 0);
    VolumeOptions options;
    options.boundary = boundary;
    const VolumeResult result = optimize_volume_mesh(mesh, options, none);
    EXPECT_TRUE(result.is_valid()) << result.message;
    EXPECT_EQ(result.moved_nodes, 0);
    EXPECT_EQ(result.points, mesh.points);
  }
}

TEST_F(OptimizedMeshes, EveryEnergyAndTarget) {
  const VolumeMesh mesh = mesh_of(cube(3, [](const Vector3& at) -> Vector3 {
    return is_inside(at, 3) ? Vector3(at + Vector3(0.2, 0.1, -0.2)) : at;
  }));
  for (const NamedEnergy& energy : volume_energies(3))
    for (const VolumeTarget target : {VolumeTarget::Ideal, VolumeTarget::Initial}) {
      VolumeOptions options;
      options.energy = {{energy.make, 1.0}};
      options.target = target;
      const VolumeResult result = optimized(mesh, options);
      EXPECT_TRUE(result.after.is_valid()) << energy.name;
      EXPECT_LE(result.value, result.initial_value) << energy.name;
      EXPECT_TRUE(result.status == Status::Converged || result.status == Status::Stalled)
          << energy.name << " " << result.message;
    }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
