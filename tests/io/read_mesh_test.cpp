#include "majorant/io/read_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <random>

#include "io_test_helpers.h"
#include "majorant/io/io.h"
#include "majorant/mesh/surface_mesh.h"
#include "public_data.h"

namespace majorant {
namespace {

using Polygons = IndexLists;

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

class ReadMesh : public ::testing::Test {
 protected:
  PolygonMesh read(const std::string& name, std::string_view content) const {
    return read_mesh(folder_.write(name, content));
  }
  std::string refuse(const std::string& name, std::string_view content) const {
    const std::string path = folder_.write(name, content);
    std::string message = error_message(ErrorKind::Unreadable, [&] { read_mesh(path); });
    EXPECT_NE(message.find(name), std::string::npos) << message;
    return message;
  }

  TemporaryFolder folder_;
};

TEST_F(ReadMesh, ObjKeepsEverythingThatAWriterNeeds) {
  const PolygonMesh mesh =
      read("a.OBJ",
           "\xEF\xBB\xBF# comment \\\nmtllib a b.mtl\no thing\n"
           "v 0 0 0 1 0 0\nv\t+1 0. 0  # here \\\r\nv 1 1e0 0 1.0\nv 0 \\\n 1 0\n"
           "vt 0 0\nvt 1 0 0\nvt .5\nvn 0 0 1\n"
           "vp 1 2\nl 1 2\ng left right\nusemtl red\n"
           "f 1/1/1 2/2/1 3/3/1 \\\n 4/1/1\ns off\nf -4//1 -3//-1 -2//1\n"
           "f 1 2 4\n\n   \nusemtl last");
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.positions[1], Vector3(1, 0, 0));
  EXPECT_EQ(mesh.positions[3], Vector3(0, 1, 0));
  EXPECT_EQ(mesh.polygons, (Polygons{{0, 1, 2, 3}, {0, 1, 2}, {0, 1, 3}}));
  EXPECT_EQ(mesh.polygon_texcoords, (Polygons{{0, 1, 2, 0}, {}, {}}));
  EXPECT_EQ(mesh.polygon_normals, (Polygons{{0, 0, 0, 0}, {0, 0, 0}, {}}));
  EXPECT_EQ(mesh.texcoords[2], Vector2(0.5, 0));
  EXPECT_EQ(mesh.polygon_lines, (std::vector<long>{17, 20, 21}));
  const std::vector<std::pair<Index, std::string>> directives = {
      {0, "# comment \\"}, {0, "mtllib a b.mtl"}, {0, "o thing"}, {0, "v 4"},        {0, "l 1 2"},
      {0, "g left right"}, {0, "usemtl red"},     {1, "s off"},   {3, "usemtl last"}};
  EXPECT_EQ(mesh.directives, directives);
  ASSERT_EQ(mesh.colors.size(), 4u);
  EXPECT_EQ(mesh.colors[0], Vector3(1, 0, 0));
  for (std::size_t v = 1; v < 4; ++v) EXPECT_FALSE(mesh.colors[v].allFinite());
  ASSERT_EQ(mesh.warnings.size(), 1u);  // about vp
}

TEST_F(ReadMesh, ObjFacesWithSomeTextureCoordinatesHaveNone) {
  const PolygonMesh mesh = read("a.obj", kTriangle +
                                             "vt 0 0\nvt 1 0\nvn 0 0 1\nf 1/1 2 3/2\n"
                                             "f 1//1 2 3\nf 1/1 2/2 3/1\nf 1 2/1 3\n");
  EXPECT_EQ(mesh.polygon_texcoords, (Polygons{{}, {}, {0, 1, 0}, {}}));
  EXPECT_TRUE(mesh.polygon_normals.empty());
  ASSERT_EQ(mesh.warnings.size(), 2u);
  expect_contains(mesh.warnings[0], {"a.obj:7: a vt index at some corners only", "as is 1 more"});
  expect_contains(mesh.warnings[1], {"a.obj:8: a vn index at some corners only"});
}

TEST_F(ReadMesh, ObjLineEndsAndForwardReferences) {
  const std::string text = "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0";
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string content;
    for (const char c : text) content += c == '\n' ? end : std::string(1, c);
    EXPECT_EQ(read("a.obj", content).polygons, (Polygons{{0, 1, 2}}));
  }
  EXPECT_TRUE(read("a.obj", text).polygon_texcoords.empty());
}

TEST_F(ReadMesh, ObjNumbersAtTheEdgeOfDoubles) {
  const PolygonMesh mesh =
      read("a.obj", "v 1e-400 4.9e-324 1.7976931348623157e308\n" + kTriangle + "f 1 2 3\n");
  EXPECT_EQ(mesh.positions[0], Vector3(0.0, 4.9e-324, 1.7976931348623157e308));
  EXPECT_NE(refuse("b.obj", "v 1e400 0 0\n").find("b.obj:1: "), std::string::npos);
}

TEST_F(ReadMesh, ObjRefusesNamingTheLine) {
  const auto expect_line_4 = [&](const std::string& line) {
    const std::string message = refuse("bad.obj", kTriangle + line + "\n");
    EXPECT_NE(message.find("bad.obj:4: "), std::string::npos) << line << " -> " << message;
  };
  for (const std::string line : {"f 1 2",
                                 "f",
                                 "f 1 2 0",
                                 "f 1 2 4",
                                 "f 1 2 -4",
                                 "f 1 2 99999999999999999999",
                                 "f 1 2 4294967297",
                                 "f 1 2 3x",
                                 "f 1/1/1/1 2 3",
                                 "f 1 2 /3",
                                 "f 1 2 three",
                                 "f 1.5 2 3",
                                 "v 0 0",
                                 "v 0 0 nan",
                                 "v 0 inf 0",
                                 "v 0 0 zero",
                                 "v 0 0 0 v 1 0 0",
                                 "vt 0 f 1 2 3",
                                 "v 0x1 0 0",
                                 "v 0,0 0 0",
                                 "v -1e999 0 0",
                                 "<html>",
                                 "1 2 3",
                                 "f 1/1/1/1/ 2 3",
                                 "f 1 2 -9223372036854775808"}) {
    expect_line_4(line);
  }
}

TEST_F(ReadMesh, ObjRefusesFilesWithoutFacesOrWithNullBytes) {
  refuse("a.obj", "");
  refuse("a.obj", "\n# nothing\n");
  refuse("a.obj", kTriangle);
  refuse("a.obj", "f 1 2 3\n");
  refuse("a.obj", kTriangle + "f 1 2 3\n" + std::string(1, '\0'));
  refuse("a.obj", kTriangle + "f 1 2 3\n\x1b[0m");
  refuse("a.obj", "<!DOCTYPE html>\n<body>v 1 2 3</body>\n");
  refuse("a.obj", "\xFF\xFEv 0 0 0\n");
  refuse("a.xyz", kTriangle + "f 1 2 3\n");
  refuse("obj", kTriangle + "f 1 2 3\n");
  error_message(ErrorKind::Unreadable, [&] { read_mesh(folder_.file("absent.obj")); });
  std::filesystem::create_directory(folder_.file("folder.obj"));
  error_message(ErrorKind::Unreadable, [&] { read_mesh(folder_.file("folder.obj")); });
}

TEST_F(ReadMesh, RepeatedVertexIsNotTheReadersError) {
  EXPECT_EQ(read("a.obj", kTriangle + "f 1 1 2\n").polygons, (Polygons{{0, 0, 1}}));
}

TEST_F(ReadMesh, OffVariants) {
  for (const std::string content :
       {"OFF\n# c\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n",
        "OFF 4 1 0\n0 0 0\n1 0 0\n\n1 1 0\n0 1 0 # c\n4 0 1 2 3 255 0 0",
        "COFF\r\n4 1\r\n0 0 0 1 1 1 1\r\n1 0 0 1 1 1 1\r\n1 1 0 1 1 1 1\r\n0 1 0 1 1 1 1\r\n4 0 1 "
        "2 3\r\n",
        "NOFF\n4 1 4\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n4 0 1 2 3\n"}) {
    const PolygonMesh mesh = read("a.off", content);
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[2], Vector3(1, 1, 0));
    EXPECT_EQ(mesh.polygons, (Polygons{{0, 1, 2, 3}}));
  }
  for (const std::string content :
       {"", "OFF", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n",
        "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
        "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "OFF\n99999999999 1 0\n", "OFF\n-1 1 0\n",
        "OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", "4OFF\n1 1 0\n", "OFF BINARY\n", "PLY\n",
        "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n",
        "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9223372036854775807 0 1 2\n",
        "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n3 0 1 2\n"}) {
    refuse("bad.off", content);
  }
}

const std::string kPlyHeader =
    "element vertex 4\nproperty uchar red\nproperty double x\nproperty float y\nproperty short z\n"
    "element extra 2\nproperty list uchar int junk\n"
    "element face 2\nproperty float quality\nproperty list uchar uint vertex_indices\n"
    "end_header\n";

std::string binary_ply(bool big_endian) {
  std::string data = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                     "_endian 1.0\ncomment by hand\n" + kPlyHeader;
  const auto add = [&](auto value) {
    char bytes[sizeof(value)];
    std::memcpy(bytes, &value, sizeof(value));
    if (big_endian) std::reverse(std::begin(bytes), std::end(bytes));
    data.append(bytes, sizeof(value));
  };
  for (const auto& [x, y, z] :
       {std::tuple{0.0, 0.0f, 0}, {1.0, 0.0f, 0}, {1.0, 0.5f, -7}, {0.0, 1.0f, 0}}) {
    add(std::uint8_t{200});
    add(x);
    add(y);
    add(static_cast<std::int16_t>(z));
  }
  add(std::uint8_t{0});
  add(std::uint8_t{1});
  add(std::int32_t{-5});
  for (const auto& corners : {std::vector<std::uint32_t>{0, 1, 2, 3}, {3, 1, 0}}) {
    add(1.5f);
    add(static_cast<std::uint8_t>(corners.size()));
    for (const std::uint32_t corner : corners) add(corner);
  }
  return data;
}

TEST_F(ReadMesh, PlyEncodings) {
  const std::string ascii = "ply\nformat ascii 1.0\n" + kPlyHeader +
                            "200 0 0 0\n200 1 0 0\n200 1 .5 -7\n200 0 1 0\n0\n1 -5\n"
                            "1.5 4 0 1 2 3\n1.5 3 3 1 0\n";
  for (const std::string& content : {ascii, binary_ply(false), binary_ply(true)}) {
    const PolygonMesh mesh = read("a.ply", content);
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[2], Vector3(1, 0.5, -7));
    EXPECT_EQ(mesh.polygons, (Polygons{{0, 1, 2, 3}, {3, 1, 0}}));
    EXPECT_TRUE(mesh.texcoords.empty());
  }
  EXPECT_NE(refuse("b.ply", ascii.substr(0, ascii.size() - 3)).find(":21: "), std::string::npos);
  refuse("b.ply", ascii + "3 0 1 2\n3 0 1 2\n");
}

// A PLY file in all encodings, with properties of random types and numbers that all of them hold.
class RandomPly {
 public:
  explicit RandomPly(unsigned seed) : random_(seed) {
    const Index vertices = 5 + below(40), faces = 1 + below(40);
    begin_element("vertex", vertices);
    std::vector<std::string> names = {"x", "y", "z", "quality", "flags"};
    std::shuffle(names.begin(), names.end(), random_);
    std::vector<Property> properties;
    for (const std::string& name : names) properties.push_back(property(name, name == "flags"));
    for (Index v = 0; v < vertices; ++v) add_record(properties, 100);
    begin_element("face", faces);
    properties.clear();
    if (below(2) == 0) properties.push_back(property("before", below(2) == 0));
    properties.push_back(property("vertex_indices", true));
    if (below(2) == 0) properties.push_back(property("after", below(2) == 0));
    for (Index f = 0; f < faces; ++f) add_record(properties, vertices);
    header_ += "end_header\n";
  }

  std::string ascii() const { return "ply\nformat ascii 1.0\n" + header_ + records_[0]; }
  std::string little() const {
    return "ply\nformat binary_little_endian 1.0\n" + header_ + records_[1];
  }
  std::string big() const { return "ply\nformat binary_big_endian 1.0\n" + header_ + records_[2]; }

 private:
  static constexpr std::array<std::string_view, 8> kTypes = {"char", "uchar",  "int16", "ushort",
                                                             "int",  "uint32", "float", "double"};
  struct Property {
    std::string name;
    Index type, list_type;  // -1: no list
  };

  Index below(Index bound) { return static_cast<Index>(random_() % static_cast<unsigned>(bound)); }
  void begin_element(const std::string& name, Index count) {
    header_ += "element " + name + " " + std::to_string(count) + "\n";
  }
  Property property(const std::string& name, bool is_list) {
    const Property made{name, below(8), is_list ? below(6) : -1};
    header_ += "property ";
    if (is_list) header_ += "list " + std::string(kTypes[to_size(made.list_type)]) + " ";
    header_ += std::string(kTypes[to_size(made.type)]) + " " + name + "\n";
    return made;
  }
  void add_record(const std::vector<Property>& properties, Index bound) {
    for (const Property& p : properties) {
      const Index count = p.list_type < 0              ? 1
                          : p.name == "vertex_indices" ? 3 + below(4)
                                                       : below(4);
      if (p.list_type >= 0) add(p.list_type, count);
      for (Index k = 0; k < count; ++k) add(p.type, below(bound));
    }
    records_[0].back() = '\n';
  }
  void add(Index type, Index value) {
    records_[0] += std::to_string(value) + " ";
    const auto append = [&](auto number) {
      std::string bytes(sizeof(number), ' ');
      std::memcpy(bytes.data(), &number, sizeof(number));
      records_[1] += bytes;
      std::reverse(bytes.begin(), bytes.end());
      records_[2] += bytes;
    };
    if (type < 2) append(static_cast<std::uint8_t>(value));
    if (type == 2 || type == 3) append(static_cast<std::uint16_t>(value));
    if (type == 4 || type == 5) append(static_cast<std::uint32_t>(value));
    if (type == 6) append(static_cast<float>(value));
    if (type == 7) append(static_cast<double>(value));
  }

  std::mt19937 random_;
  std::string header_;
  std::array<std::string, 3> records_;  // ascii, little, big
};

TEST_F(ReadMesh, PlyRecordsOfAnyLayout) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const RandomPly ply(seed);
    const PolygonMesh ascii = read("a.ply", ply.ascii());
    for (const std::string& content : {ply.little(), ply.big()}) {
      const PolygonMesh mesh = read("b.ply", content);
      EXPECT_EQ(mesh.positions, ascii.positions) << seed;
      EXPECT_EQ(mesh.polygons, ascii.polygons) << seed;
      EXPECT_EQ(mesh.polygon_lines.size(), mesh.polygons.size());
      for (const std::size_t cut : {1, 5})
        refuse("c.ply", std::string_view(content).substr(0, content.size() - cut));
    }
  }
}

TEST_F(ReadMesh, PlyTexcoords) {
  const PolygonMesh mesh = read("a.ply",
                                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                "property float y\nproperty float z\nproperty float s\n"
                                "property float t\nelement face 1\n"
                                "property list uchar int vertex_index\nend_header\n"
                                "0 0 0 0 0\n1 0 0 .5 0\n0 1 0 0 .25\n3 2 0 1\n");
  EXPECT_EQ(mesh.texcoords[2], Vector2(0, 0.25));
  EXPECT_EQ(mesh.polygon_texcoords, mesh.polygons);
}

TEST_F(ReadMesh, PlyHostileHeaders) {
  const auto header = [](const std::string& format, const std::string& vertices,
                         const std::string& faces) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  };
  for (const std::string format : {"ascii", "binary_little_endian"}) {
    refuse("a.ply", header(format, "9223372036854775807", "1"));
    refuse("a.ply", header(format, "4000000000", "4000000000") + "0 0 0 0 0 0 0 0 0 0 0");
    refuse("a.ply", header(format, "-1", "1"));
    refuse("a.ply", header(format, "0", "0"));
    refuse("a.ply", header(format, "x", "0"));
  }
  std::string huge_list = header("binary_big_endian", "0", "1");
  huge_list.replace(huge_list.find("list uchar"), 10, "list uint ");
  refuse("a.ply", huge_list + "\xFF\xFF\xFF\xFF 1 2 3");
  refuse("a.ply",
         "ply\nformat ascii 1.0\nelement e 9223372036854775807\nelement vertex 1\n"
         "property int x\nend_header\n1\n");
  refuse("a.ply", "ply\nelement vertex 1\nproperty int x\nend_header\n1\n");
  refuse("a.ply", "ply\nformat ascii 1.0\nproperty int x\nend_header\n1\n");
  refuse("a.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\nend_header\n");
  refuse("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nelement vertex 1\nend_header\n");
  refuse("a.ply", header("ascii", "3", "1") + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n");
  refuse("a.ply", header("ascii", "3", "1") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n");
  refuse("a.ply", header("ascii", "3", "1") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n");
  refuse("a.ply", header("ascii", "3", "1") + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n");
  refuse("a.ply", header("ascii", "3", "1") + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n");
  refuse("a.ply", "not a ply file");
}

const std::string kAsciiStl =
    "solid two triangles\nfacet normal nan 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n"
    "  vertex 1 1 0\n endloop\nendfacet\nFACET NORMAL 0 0 1\nouter loop\nvertex 1 1 0\n"
    "vertex 0 1 0\nvertex -0 0 0\nendloop\nendfacet\nendsolid two\n";

std::string binary_stl_of(const std::vector<std::array<Eigen::Vector3f, 3>>& facets) {
  std::string data(84 + 50 * facets.size(), '\0');
  const auto count = static_cast<std::uint32_t>(facets.size());
  std::memcpy(data.data() + 80, &count, sizeof(count));
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      std::memcpy(data.data() + 84 + 50 * f + 12 * (k + 1), facets[f][k].data(), 12);
  return data;
}

std::string binary_stl() {
  std::string data(80, ' ');
  data.replace(0, 5, "solid");
  const auto add = [&](auto value) {
    char bytes[sizeof(value)];
    std::memcpy(bytes, &value, sizeof(value));
    data.append(bytes, sizeof(value));
  };
  add(std::uint32_t{2});
  for (const auto& corners :
       {std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0}, {1, 1, 0, 0, 1, 0, -0.0f, 0, 0}}) {
    for (int k = 0; k < 3; ++k) add(0.0f);
    for (const float x : corners) add(x);
    add(std::uint16_t{0});
  }
  return data;
}

TEST_F(ReadMesh, StlMergesEqualCornersInOrderOfAppearance) {
  for (const std::string& content : {kAsciiStl, binary_stl()}) {
    const PolygonMesh mesh = read("a.stl", content);
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[3], Vector3(0, 1, 0));
    EXPECT_EQ(mesh.polygons, (Polygons{{0, 1, 2}, {2, 3, 0}}));
  }
  refuse("b.stl", "");
  refuse("b.stl", "solid\nendsolid\n");
  refuse("b.stl", binary_stl().substr(0, 150));
  refuse("b.stl", binary_stl() + "x");
  refuse("b.stl", std::string(84, '\0'));
  refuse("b.stl", kAsciiStl.substr(0, kAsciiStl.find("endsolid")));
  refuse("b.stl",
         "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid\n");
  refuse("b.stl", "solid\nfacet\nouter loop\nvertex 0 0 inf\n");
  std::string not_finite = binary_stl();
  not_finite.replace(84 + 12, 4, std::string("\0\0\xC0\x7F", 4));
  refuse("b.stl", not_finite);
}

// Many equal corners, and none: the table of corners grows, and slots are taken by others.
TEST_F(ReadMesh, StlMergesAsManyCornersAsThereAre) {
  std::mt19937 random(7);
  for (const Index side : {1, 2, 13, 2000}) {
    std::uniform_int_distribution<Index> number(-side, side);
    std::vector<std::array<Eigen::Vector3f, 3>> facets(3001);
    for (auto& facet : facets)
      for (Eigen::Vector3f& corner : facet)
        for (int d = 0; d < 3; ++d)
          corner[d] =
              0.25F * (random() % 2 == 0 ? 1.0F : -1.0F) * static_cast<float>(number(random));
    const PolygonMesh mesh = read("a.stl", binary_stl_of(facets));
    std::map<std::array<float, 3>, Index> numbers;  // -0 is 0 here
    ASSERT_EQ(mesh.polygons.size(), facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3f& corner = facets[f][k];
        const auto known = numbers.try_emplace({corner[0], corner[1], corner[2]},
                                               static_cast<Index>(numbers.size()));
        EXPECT_EQ(mesh.polygons[f][k], known.first->second);
        EXPECT_EQ(mesh.positions[known.first->second], corner.cast<double>());
      }
    EXPECT_EQ(mesh.positions.size(), numbers.size());
    EXPECT_EQ(mesh.polygon_lines.back(), 3001);
  }
}

TEST_F(ReadMesh, VtuGivesBackTheInputMesh) {
  MapFile map = random_strip(3, 4, 3);
  const PolygonMesh plain = mesh_from_map(map, "");
  map.input_vertex = map.input_vertex.unaryExpr([](int v) { return v < 0 ? -1 : 10 - v; });
  map.input_face = map.input_face.reverse().eval();
  write_vtu(folder_.file("map.vtu"), map);
  const PolygonMesh mesh = read_mesh(folder_.file("map.vtu"));
  ASSERT_EQ(mesh.polygons.size(), 4u);
  EXPECT_EQ(mesh.positions.size(), 11u);
  for (std::size_t f = 0; f < 4; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index point = map.cells(static_cast<Index>(3 - f), static_cast<Index>(k));
      EXPECT_EQ(mesh.polygons[f][k], map.input_vertex[point]);
      EXPECT_EQ(mesh.positions[static_cast<std::size_t>(mesh.polygons[f][k])],
                map.points.row(point).transpose());
      EXPECT_EQ(mesh.texcoords[static_cast<std::size_t>(mesh.polygon_texcoords[f][k])],
                map.uv.row(point).transpose());
    }
  }
  EXPECT_EQ(plain.positions.size(), 6u);
  map.input_vertex[map.cells(0, 0)] = 2000000000;
  error_message(ErrorKind::Unreadable, [&] { mesh_from_map(map, ""); });
  map.input_vertex[map.cells(0, 0)] = map.input_vertex[map.cells(0, 1)];
  error_message(ErrorKind::Unreadable, [&] { mesh_from_map(map, ""); });
}

// The public collection of malformed files; where it is missing, the cases above represent it.
TEST_F(ReadMesh, PublicCollection) {
  const std::filesystem::path folder = public_data("bad");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  for (const char* name : {"empty", "no_faces", "truncated", "binary_garbage", "html_error_page",
                           "face_not_a_number", "vertex_two_coordinates", "index_out_of_range",
                           "index_zero", "index_overflow", "nan_coordinate", "inf_coordinate"}) {
    const std::string path = (folder / name).string() + ".obj";
    const std::string message = error_message(ErrorKind::Unreadable, [&] { read_mesh(path); });
    EXPECT_NE(message.find(path), std::string::npos) << message;
  }
  for (const char* name : {"tiny_1e-9", "negative_indices", "crlf", "all_reversed", "syntax_zoo",
                           "slivers_1e6", "huge_offset_1e12"}) {
    const PolygonMesh mesh = read_mesh((folder / name).string() + ".obj");
    EXPECT_EQ(mesh.positions.size(), 49u) << name;
    EXPECT_EQ(mesh.polygons.size(), 72u) << name;
  }
  EXPECT_EQ(read_mesh((folder / "unreferenced_vertices.obj").string()).positions.size(), 51u);
  EXPECT_EQ(read_mesh((folder / "face_repeats_vertex.obj").string()).polygons.size(), 73u);
}

// Readable files of unusable meshes (mesh/mesh_validation_test.cpp).
TEST_F(ReadMesh, PublicMeshesThatAreNoDisks) {
  const std::filesystem::path folder = public_data("bad");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  for (const char* name :
       {"nonmanifold_edge", "nonmanifold_vertex", "two_components", "closed_surface", "annulus",
        "moebius", "torus_one_hole", "flipped_faces", "triangle_soup", "duplicate_face",
        "face_repeats_vertex", "zero_area_face", "coincident_vertices", "huge_offset_1e12"}) {
    const std::string path = (folder / (std::string(name) + ".obj")).string();
    const std::string message = error_message(ErrorKind::Unsupported, [&] {
      SurfaceMesh::from_polygons(read_mesh(path)).require_disk();
    });
    EXPECT_NE(message.find(name), std::string::npos) << message;
  }
  for (const char* name :
       {"tiny_1e-9", "slivers_1e6", "negative_indices", "quads_and_polygons", "crlf",
        "unreferenced_vertices", "all_reversed", "single_triangle", "syntax_zoo"})
    EXPECT_NO_THROW(
        SurfaceMesh::from_polygons(read_mesh((folder / (std::string(name) + ".obj")).string()))
            .require_disk())
        << name;
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
