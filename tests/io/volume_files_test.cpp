// Volume meshes read, checked and written: of the public collection, and small ones of every
// format.
#include "majorant/io/volume_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>

#include "majorant/framework/error.h"
#include "majorant/io/base64.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/formats.h"
#include "majorant/io/written_mark.h"
#include "public_data.h"

namespace majorant {
namespace {

namespace fs = std::filesystem;

class VolumeFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("majorant_volumes_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(file(name), std::ios::binary) << content;
    return file(name);
  }
  // Returns the content of a file without its mark, which occurs once.
  static std::string without_mark(const std::string& path, std::string content) {
    const std::string mark = mark_text(mark_style(format_of(path)));
    const std::size_t at = content.find(mark);
    EXPECT_NE(at, std::string::npos) << path;
    if (at != std::string::npos) content.erase(at, mark.size());
    EXPECT_EQ(content.find(mark), std::string::npos) << path;
    return content;
  }
  // Without moved nodes: the bytes of the file, and a mark. With one moved coordinate: only that
  // differs.
  void expect_written_back(const std::string& path) const {
    VolumeMesh mesh = read_volume_mesh(path);
    EXPECT_EQ(without_mark(path, volume_mesh_content(path, mesh)), read_whole_file(path)) << path;
    const Points3 before = mesh.points;
    const Index moved = static_cast<Index>(mesh.points.rows()) / 2;
    mesh.points(moved, 0) = std::nextafter(mesh.points(moved, 0), 1e9);
    mesh.points(moved, 1) = 0.1 + 0.2;
    const std::string out = file("back" + fs::path(path).extension().string());
    write_volume_mesh(out, mesh);
    const VolumeMesh back = read_volume_mesh(out);
    EXPECT_EQ(back.points, mesh.points) << path;
    ASSERT_EQ(back.blocks.size(), mesh.blocks.size());
    for (std::size_t b = 0; b < back.blocks.size(); ++b) {
      EXPECT_EQ(back.blocks[b].nodes, mesh.blocks[b].nodes);
      EXPECT_EQ(back.blocks[b].numbers, mesh.blocks[b].numbers);
      EXPECT_EQ(back.blocks[b].regions, mesh.blocks[b].regions);
    }
    EXPECT_FALSE(has_mark(path)) << path;
    EXPECT_TRUE(has_mark(out)) << path;
    EXPECT_EQ(volume_mesh_content(out, back), read_whole_file(out)) << path;
    mesh.points = before;
    EXPECT_EQ(without_mark(path, volume_mesh_content(path, mesh)), read_whole_file(path)) << path;
  }

 private:
  fs::path folder_;
};

TEST_F(VolumeFiles, PublicMeshesAreReadCheckedAndWrittenBack) {
  const fs::path folder = public_data("volumes");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  // Meshes that are invalid.
  const std::map<std::string, bool> tangled{{"jagged.mesh", true},
                                            {"tangled_o2_n4_25.msh", true},
                                            {"tangled_o2_n6_120.msh", true},
                                            {"tangled_o2_n8_400.msh", true}};
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".msh" && extension != ".mesh") continue;
    SCOPED_TRACE(entry.path().string());
    ++files;
    expect_written_back(entry.path());
    const VolumeMesh mesh = read_volume_mesh(entry.path());
    const VolumeCheck check = check_volume_mesh(mesh);
    EXPECT_EQ(check.undecided(), 0);
    EXPECT_TRUE(check.disagreements.empty());
    EXPECT_TRUE(check.crowded.empty());
    EXPECT_EQ(check.invalid() > 0, tangled.count(entry.path().filename()) > 0);
    EXPECT_EQ(check.least_scaled_jacobian() > 0, check.invalid() == 0);
  }
  EXPECT_EQ(files, 28);
}

const std::string kMedit =
    "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 2\n1 1 1 3\n"
    "Triangles 1\n1 3 2 9\nTetrahedra 2\n1 2 3 4 7\n2 3 4 5 8\nCorners 1\n1\nEnd\n";
const std::string kMfem =
    "MFEM mesh v1.0\n# two squares\ndimension\n2\nelements\n2\n1 3 0 1 4 3\n2 3 1 2 5 "
    "4\nboundary\n1\n"
    "7 1 0 1\nvertices\n6\n2\n0 0\n1 0\n2 0\n0 1\n1 1\n2 1\n";
const std::string kOldGmsh =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 4 \"part\"\n$EndPhysicalNames\n"
    "$Nodes\n5\n10 0 0 0\n20 1 0 0\n30 0 1 0\n4000 0 0 1\n50 1 1 1\n$EndNodes\n"
    "$Elements\n3\n1 15 2 9 9 10\n12 4 2 4 1 10 20 30 4000\n13 4 2 4 1 20 30 4000 "
    "50\n$EndElements\n"
    "$NodeData\nanything\n$EndNodeData\n";

const std::vector<std::pair<std::string, std::string>> kSmall{
    {"a.mesh", kMedit}, {"b.mesh", kMfem}, {"c.msh", kOldGmsh}};

TEST_F(VolumeFiles, SmallMeshesOfEveryFormat) {
  for (const auto& [name, content] : kSmall) {
    const std::string path = write(name, content);
    expect_written_back(path);
    const VolumeCheck check = check_volume_mesh(read_volume_mesh(path));
    EXPECT_TRUE(check.is_valid()) << name;
    EXPECT_EQ(check.cells.size(), 2u);
  }
  const VolumeMesh mesh = read_volume_mesh(file("c.msh"));
  EXPECT_EQ(mesh.blocks[1].numbers, (std::vector<std::int64_t>{12, 13}));
  EXPECT_EQ(mesh.blocks[1].regions, (std::vector<int>{4, 4}));
}

TEST_F(VolumeFiles, DefectsAreFound) {
  // First the second tetrahedron is inverted; then a third one is at the face of both.
  std::string turned = kMedit, crowded = kMedit;
  turned.replace(turned.find("2 3 4 5 8"), 9, "3 2 4 5 8");
  const VolumeCheck one = check_volume_mesh(read_volume_mesh(write("turned.mesh", turned)));
  EXPECT_EQ(one.invalid(), 1);
  EXPECT_EQ(one.inverted(), 1);
  crowded.replace(crowded.find("Tetrahedra 2"), 12, "Tetrahedra 3\n2 3 4 5 8");
  const VolumeCheck two = check_volume_mesh(read_volume_mesh(write("crowded.mesh", crowded)));
  EXPECT_FALSE(two.is_valid());
  EXPECT_GE(two.crowded.size(), 1u);
  // Two triangles of degree 2 with a common edge, each with its own midpoint.
  const std::string torn =
      "MeshVersionFormatted 2\nDimension 2\nVertices 10\n0 0 0\n2 0 0\n0 2 0\n2 2 0\n1 0 0\n1 1 0\n"
      "0 1 0\n1.25 1 0\n2 1 0\n1 2 0\nTrianglesP2 2\n1 2 3 5 6 7 1\n2 4 3 9 10 8 1\nEnd\n";
  const VolumeCheck three = check_volume_mesh(read_volume_mesh(write("torn.mesh", torn)));
  EXPECT_EQ(three.invalid(), 0);
  ASSERT_EQ(three.disagreements.size(), 1u);
  std::string joined = torn;
  joined.replace(joined.find("1.25 1 0"), 8, "1 1 0");
  EXPECT_TRUE(check_volume_mesh(read_volume_mesh(write("joined.mesh", joined))).is_valid());
}

// Cells on one side of a common side; a cell that is listed twice, also with other nodes.
TEST_F(VolumeFiles, CellsOnOneSideAndCellsTwiceAreFound) {
  const auto check = [&](const std::string& name, const std::string& points,
                         const std::string& cells) {
    return check_volume_mesh(read_volume_mesh(
        write(name, "MeshVersionFormatted 2\nDimension 3\nVertices " + points + cells + "End\n")));
  };
  const std::string solid = "6\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0.2 0.2 0.3 0\n0 0 -1 0\n";
  const VolumeCheck inside = check("a.mesh", solid, "Tetrahedra 2\n1 2 3 4 0\n1 2 3 5 0\n");
  EXPECT_EQ(inside.invalid(), 0);
  ASSERT_EQ(inside.overlapping.size(), 1u);
  EXPECT_FALSE(inside.is_valid());
  EXPECT_TRUE(check("b.mesh", solid, "Tetrahedra 2\n1 2 3 4 0\n2 1 3 6 0\n").is_valid());
  // The inverted cell lies on the other side, and is invalid itself.
  const VolumeCheck turned = check("c.mesh", solid, "Tetrahedra 2\n1 2 3 4 0\n1 2 3 6 0\n");
  EXPECT_EQ(turned.inverted(), 1);
  EXPECT_TRUE(turned.sides_fit());
  const VolumeCheck twice = check("d.mesh", solid, "Tetrahedra 2\n1 2 3 4 0\n2 3 1 4 0\n");
  ASSERT_EQ(twice.repeated.size(), 1u);
  EXPECT_TRUE(twice.overlapping.empty());
  EXPECT_FALSE(twice.is_valid());
  const std::string copied =
      "8\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n-0 0 0 0\n1 0 0 0\n0 1 0 "
      "0\n0 0 1 0\n";
  EXPECT_EQ(check("e.mesh", copied, "Tetrahedra 2\n1 2 3 4 0\n5 6 7 8 0\n").repeated.size(), 1u);
  const std::string flat = "4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0.2 0.3 0 0\n";
  const VolumeCheck plane = check("f.mesh", flat, "Triangles 2\n1 2 3 0\n1 2 4 0\n");
  EXPECT_EQ(plane.invalid(), 0);
  EXPECT_EQ(plane.overlapping.size(), 1u);
  // On a surface in space, both sides of a sheet and one-sided bands are valid cells.
  const std::string bent = "4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0.2 0.3 1 0\n";
  EXPECT_TRUE(check("g.mesh", bent, "Triangles 3\n1 2 3 0\n1 3 2 0\n3 2 4 0\n").repeated.empty());
  EXPECT_EQ(check("h.mesh", bent, "Triangles 3\n1 2 3 0\n2 3 1 0\n3 2 4 0\n").repeated.size(), 1u);
}

// The mesh has three by three squares with separate nodes, joined at the ends of rows, where sides
// are equal up to a translation. A displaced square has no such side.
TEST_F(VolumeFiles, PeriodicMeshesAreCheckedAsSuch) {
  const auto file = [&](double pushed) {
    std::string text = "MFEM mesh v1.0\ndimension\n2\nelements\n9\n", nodes;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int next = (i + 1) % 3, above = (j + 1) % 3;
        text += "1 3 " + std::to_string(3 * j + i) + " " + std::to_string(3 * j + next) + " " +
                std::to_string(3 * above + next) + " " + std::to_string(3 * above + i) + "\n";
        for (int k = 0; k < 4; ++k)
          nodes += std::to_string(i + k % 2 + (i == 1 && j == 1 ? pushed : 0)) + " " +
                   std::to_string(j + k / 2) + "\n";
      }
    return text +
           "boundary\n0\nvertices\n9\nnodes\nFiniteElementSpace\nFiniteElementCollection: "
           "L2_T1_2D_P1\nVDim: 2\nOrdering: 1\n\n" +
           nodes;
  };
  const VolumeCheck periodic = check_volume_mesh(read_volume_mesh(write("a.mesh", file(0))));
  EXPECT_TRUE(periodic.is_valid());
  EXPECT_EQ(periodic.periodic_sides, 6);
  EXPECT_EQ(periodic.boundary_sides, 0);
  for (const double pushed : {0.25, -0.25, 1e-3}) {
    const VolumeCheck torn = check_volume_mesh(read_volume_mesh(write("a.mesh", file(pushed))));
    EXPECT_EQ(torn.disagreements.size(), 4u) << pushed;
    EXPECT_EQ(torn.periodic_sides, 6) << pushed;
  }
}

// v1.2 has an end mark, v1.3 also named sets of attributes.
TEST_F(VolumeFiles, NewerVersionsOfMfem) {
  std::string text = kMfem;
  text.replace(text.find("v1.0"), 4, "v1.2");
  EXPECT_THROW(read_volume_mesh(write("a.mesh", text)), Error);  // no mfem_mesh_end
  for (const char* const end : {"mfem_mesh_end\n", "mfem_serial_mesh_end\ncommunication_groups\n"})
    expect_written_back(write("a.mesh", text + end));
  text.replace(text.find("v1.2"), 4, "v1.3");
  text.insert(text.find("boundary"),
              "attribute_sets\n2\n\"the \\\"base\\\" 3\" 2\n1 2\nall\n1\n1\n");
  text.insert(text.find("vertices"), "bdr_attribute_sets\n0\n");
  const std::string path = write("a.mesh", text + "mfem_mesh_end\n");
  expect_written_back(path);
  EXPECT_TRUE(check_volume_mesh(read_volume_mesh(path)).is_valid());
  text.replace(text.find("v1.3"), 4, "v1.1");
  EXPECT_THROW(read_volume_mesh(write("a.mesh", text)), Error);
}

TEST_F(VolumeFiles, SurfacesInSpaceAreSeenFromTheirStraightCells) {
  // A vertical triangle of degree 2 whose edges are curved out of its plane.
  const std::string bulging =
      "MeshVersionFormatted 2\nDimension 3\nVertices 6\n0 0 0 0\n0 2 0 0\n0 0 2 0\n0.5 1 0 0\n0.5 "
      "1 1 0\n"
      "0.5 0 1 0\nTrianglesP2 1\n1 2 3 4 5 6 1\nEnd\n";
  const VolumeCheck check = check_volume_mesh(read_volume_mesh(write("b.mesh", bulging)));
  EXPECT_TRUE(check.is_surface);
  EXPECT_TRUE(check.is_valid());
  EXPECT_NEAR(check.cells[0].range.high, 4, 1e-9);
}

// Two triangles whose nodes have parameters, in 4.1; in 2.2 with partitions.
const std::string kParametric =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n2 1 1 4\n1\n2\n3\n4\n0 0 0 0 0\n"
    "1 0 0 1 0\n0 1 0 0 1\n1 1 0 1 1\n$EndNodes\n$Elements\n1 2 1 2\n2 1 2 2\n1 1 2 3\n2 2 4 3\n"
    "$EndElements\n";
const std::string kPartitioned =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n"
    "$EndNodes\n$Elements\n2\n1 2 4 0 1 1 1 1 2 3\n2 2 4 0 1 1 2 2 4 3\n$EndElements\n";

TEST_F(VolumeFiles, OtherFormatsReportOmittedData) {
  const auto left_out = [&](const std::string& name, const std::string& content,
                            const std::string& other, const GmshChoice& choice = {}) {
    const VolumeMesh mesh = read_volume_mesh(write(name, content));
    std::vector<std::string> out;
    write_volume_mesh(file(other), mesh, choice, &out, [&](const VolumeMesh& written) {
      ASSERT_EQ(written.blocks.size(), mesh.blocks.size());
      for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
        EXPECT_EQ(written.blocks[b].type, mesh.blocks[b].type);
        EXPECT_EQ(written.blocks[b].nodes, mesh.blocks[b].nodes);
      }
    });
    EXPECT_TRUE(has_mark(file(other))) << other;
    without_mark(file(other), read_whole_file(file(other)));
    return out;
  };
  using Names = std::vector<std::string>;
  const GmshChoice old{GmshVersion::Old, {}}, binary{{}, GmshEncoding::Binary};
  EXPECT_EQ(left_out("p.msh", kParametric, "q.msh"), Names());
  EXPECT_EQ(left_out("p.msh", kParametric, "q.msh", old), Names{"parameters of nodes"});
  EXPECT_EQ(left_out("p.msh", kPartitioned, "q.msh"), Names());
  EXPECT_EQ(left_out("p.msh", kPartitioned, "q.msh", binary), Names{"partitions of elements"});
  EXPECT_EQ(left_out("p.msh", kOldGmsh, "q.msh", binary), Names{"section $NodeData"});
  // A mark is replaced, other comments are dropped.
  const std::string marked = with_mark(MarkStyle::GmshSection, kOldGmsh);
  EXPECT_EQ(left_out("p.msh", marked, "q.msh", binary), Names{"section $NodeData"});
  EXPECT_EQ(left_out("p.msh", marked + "$Comments\nmajorant of all\n$EndComments\n", "q.msh", old),
            Names());
  EXPECT_EQ(
      left_out("p.msh", marked + "$Comments\nmajorant of all\n$EndComments\n", "q.msh", binary),
      (Names{"section $NodeData", "section $Comments"}));
  for (const auto& [name, content] : kSmall)
    for (const char* const other : {"q.vtu", "q.msh"})
      if (fs::path(name).extension() != fs::path(other).extension()) {
        EXPECT_EQ(left_out(name, content, other),
                  Names{"what " + file(name) + " has beside nodes, elements and their regions"});
      }
  const auto refused = [&](const std::string& name, const std::string& content,
                           const std::string& other, const std::string& says,
                           const GmshChoice& choice = {}) {
    SCOPED_TRACE(other + ": " + says);
    try {
      write_volume_mesh(file(other), read_volume_mesh(write(name, content)), choice);
      ADD_FAILURE() << "written";
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::Usage);
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
    EXPECT_FALSE(fs::exists(file(other)));
  };
  // One quad of degree 3, with nodes at Gauss-Lobatto points and with control points.
  const auto cubic = [&](const std::string& collection) {
    std::string text =
        "MFEM mesh v1.0\n\ndimension\n2\n\nelements\n1\n1 3 0 1 2 "
        "3\n\nboundary\n0\n\nvertices\n4\n\n"
        "nodes\nFiniteElementSpace\nFiniteElementCollection: " +
        collection + "\nVDim: 2\nOrdering: 1\n\n";
    const double at[4] = {0, (1 - std::sqrt(0.2)) / 2, (1 + std::sqrt(0.2)) / 2, 1};
    const int nodes[16][2] = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 0}, {2, 0}, {3, 1}, {3, 2},
                              {1, 3}, {2, 3}, {0, 1}, {0, 2}, {1, 1}, {2, 1}, {1, 2}, {2, 2}};
    for (const auto& node : nodes)
      text += std::to_string(at[node[0]]) + " " + std::to_string(at[node[1]]) + "\n";
    return text;
  };
  refused("r.mesh", cubic("H1_2D_P3"), "s.vtu", "Gauss-Lobatto");
  refused("r.mesh", cubic("H1_2D_P3"), "s.msh", "Gauss-Lobatto");
  refused("r.mesh", cubic("H1Pos_2D_P3"), "s.msh", "control points");
  left_out("r.mesh", cubic("H1Pos_2D_P3"), "s2.vtu");
  refused("r.msh", kOldGmsh, "s.mesh", "is written as .msh or .vtu");
  refused("r.msh", kOldGmsh, "s.msh.gz", ".gz");
  refused("r.msh", kOldGmsh, "s.vtu", "of .msh", binary);
}

// In VTK the first triangle of linear wedges is oriented outwards, unlike that of other wedges;
// programs write both orders.
TEST_F(VolumeFiles, LinearWedgesOfVtkInBothOrders) {
  const auto wedges = [](const std::string& connectivity, int count) {
    std::string offsets, types;
    for (int k = 1; k <= count; ++k) {
      offsets += std::to_string(6 * k) + " ";
      types += "13 ";
    }
    return R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="9" NumberOfCells=")" +
           std::to_string(count) + R"("><Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 0 0 1 1 0 1 0 1 1 0 0 2 1 0 2 0 1 2</DataArray></Points><Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">)" +
           connectivity + R"(</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">)" +
           offsets + R"(</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">)" +
           types + "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>\n";
  };
  const VolumeMesh outward = read_volume_mesh(write("a.vtu", wedges("0 2 1 3 5 4 3 5 4 6 8 7", 2)));
  const VolumeMesh inward = read_volume_mesh(write("b.vtu", wedges("0 1 2 3 4 5 3 4 5 6 7 8", 2)));
  EXPECT_EQ(outward.blocks[0].nodes, inward.blocks[0].nodes);
  EXPECT_TRUE(check_volume_mesh(outward).is_valid());
  // One of three is inverted.
  const VolumeCheck turned = check_volume_mesh(
      read_volume_mesh(write("c.vtu", wedges("0 2 1 3 5 4 3 4 5 6 7 8 0 2 1 6 8 7", 3))));
  EXPECT_EQ(turned.inverted(), 1);
  // The written file has VTK's order, and reading restores the mesh.
  VolumeMesh plain = outward;
  plain.source = nullptr;
  plain.file.clear();
  write_volume_mesh(file("d.vtu"), plain);
  const VolumeMesh back = read_volume_mesh(file("d.vtu"));
  EXPECT_EQ(back.blocks[0].nodes, inward.blocks[0].nodes);
  const std::array<std::int64_t, 13> array{96, 0, 2, 1, 3, 5, 4,
                                           3,  5, 4, 6, 8, 7};  // its bytes first
  std::string encoded;
  append_base64({reinterpret_cast<const char*>(array.data()), sizeof array}, encoded);
  EXPECT_NE(read_whole_file(file("d.vtu")).find(encoded), std::string::npos);
}

TEST_F(VolumeFiles, CellsHaveAMark) {
  const VolumeMesh mesh = read_volume_mesh(write("a.mesh", kMedit));
  const VolumeCheck check = check_volume_mesh(mesh);
  write_cells_vtu(file("cells.vtu"), mesh, {&check.cells[0]});
  EXPECT_TRUE(has_mark(file("cells.vtu")));
  without_mark(file("cells.vtu"), read_whole_file(file("cells.vtu")));
  EXPECT_EQ(read_volume_mesh(file("cells.vtu")).blocks.size(), 1u);
}

struct Refusal {
  const char* name;
  std::string content;
  ErrorKind kind;
  const char* says;
};

TEST_F(VolumeFiles, RefusalsNameTheDefect) {
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const auto unreadable = ErrorKind::Unreadable;
  const auto unsupported = ErrorKind::Unsupported;
  const std::vector<Refusal> refusals{
      {"a.msh", "", unreadable, "not a gmsh file"},
      {"a.msh", changed(kOldGmsh, "2.2", "4.0"), unsupported, "MSH 4.0"},
      {"a.msh", changed(kOldGmsh, "12 4 2", "12 7 2"), unsupported, "pyramids"},
      {"a.msh", changed(kOldGmsh, "12 4 2", "12 31 2"), unsupported, "type 31"},
      {"a.msh", changed(kOldGmsh, "10 20 30 4000\n", "10 20 30 4\n"), unreadable, "node 4"},
      {"a.msh", changed(kOldGmsh, "20 1 0 0", "10 1 0 0"), unreadable, "two nodes"},
      {"a.msh", changed(kOldGmsh, "20 1 0 0", "20 nan 0 0"), unreadable, "not finite"},
      {"a.msh", changed(kOldGmsh, "$Nodes\n5", "$Nodes\n500000000"), unreadable,
       "more than the file"},
      {"a.msh", kOldGmsh.substr(0, kOldGmsh.find("$EndElements")), unreadable, "$EndElements"},
      {"a.mesh", changed(kMfem, "v1.0", "NURBS mesh v1.0"), unsupported, "NURBS"},
      {"a.mesh", changed(kMfem, "1 3 0 1 4 3", "1 7 0 1 4 3"), unsupported, "pyramids"},
      {"a.mesh", changed(kMfem, "1 3 0 1 4 3", "1 3 0 1 4 33"), unreadable, "vertex 33"},
      {"a.mesh", changed(kMfem, "2 1\n", ""), unreadable, "missing"},
      {"a.mesh", changed(kMedit, "Tetrahedra 2", "Pyramids 2"), unsupported, "Pyramids"},
      {"a.mesh", changed(kMedit, "2 3 4 5 8", "2 3 4 6 8"), unreadable, "vertex 6"},
      {"a.mesh", "v 0 0 0\n", unreadable, "not a mesh of MFEM"},
      {"a.obj", "v 0 0 0\n", unsupported, ".obj"},
      {"a.vtu", "<VTKFile/>", unreadable, "UnstructuredGrid"}};
  for (const Refusal& refusal : refusals) {
    SCOPED_TRACE(refusal.says);
    try {
      read_volume_mesh(write(refusal.name, refusal.content));
      ADD_FAILURE() << "read";
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), refusal.kind) << e.what();
      EXPECT_NE(std::string(e.what()).find(refusal.says), std::string::npos) << e.what();
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
  }
}

// Truncated anywhere, or with a changed byte, a file is read or refused.
TEST_F(VolumeFiles, DamagedFilesAreRefused) {
  for (const auto& [name, content] : kSmall)
    for (std::size_t k = 0; k < content.size(); ++k)
      for (const bool is_cut : {true, false}) {
        std::string damaged = is_cut ? content.substr(0, k) : content;
        if (!is_cut) damaged[k] = static_cast<char>(33 + 7 * k % 90);
        try {
          check_volume_mesh(read_volume_mesh(write(name, damaged)));
        } catch (const Error&) {
        }
      }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
