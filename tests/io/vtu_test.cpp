#include <bit>
#include <cstdint>
#include <limits>

#include "io_test_helpers.h"
#include "majorant/io/base64.h"
#include "majorant/io/io.h"

namespace majorant {
namespace {

template <class A, class B>
bool same_bits(const A& a, const B& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return false;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(a.data()[i]) != std::bit_cast<std::uint64_t>(b.data()[i])) {
      return false;
    }
  }
  return true;
}

void expect_same(const MapFile& a, const MapFile& b) {
  EXPECT_EQ(a.degree, b.degree);
  EXPECT_TRUE(same_bits(a.points, b.points));
  EXPECT_TRUE(same_bits(a.uv, b.uv));
  EXPECT_TRUE(same_bits(a.distortion, b.distortion));
  EXPECT_TRUE(same_bits(a.min_det, b.min_det));
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.input_vertex, b.input_vertex);
  EXPECT_EQ(a.input_face, b.input_face);
  EXPECT_EQ(a.claims, b.claims);
}

TEST(Vtu, RoundTripIsExactForEveryDegree) {
  const TemporaryFolder folder;
  for (int degree = 1; degree <= 8; ++degree) {
    const MapFile map = random_strip(degree, 5, 7u + static_cast<unsigned>(degree));
    write_vtu(folder.file("map.vtu"), map);
    expect_same(map, read_vtu(folder.file("map.vtu")));
  }
}

// Older files have claims as an array of strings.
TEST(Vtu, ClaimsOfOlderFiles) {
  const std::string path = MAJORANT_SOURCE_DIR "/tests/data/maps/good/wrong_claims_1.vtu";
  EXPECT_NE(content_of(path).find("type=\"String\" Name=\"majorant_claims\""), std::string::npos);
  EXPECT_EQ(read_vtu(path).claims,
            R"({"degree": 3, "energy": "none", "seams": true, )"
            R"("normalized": {"origin": [1000000000.0, 0], "size": 1e-09}})");
}

TEST(Vtu, ChartsOfAnAtlas) {
  const TemporaryFolder folder;
  MapFile map = random_strip(2, 5, 1);
  map.chart = Eigen::VectorXi::LinSpaced(5, 0, 4) / 2;
  write_vtu(folder.file("map.vtu"), map);
  EXPECT_EQ(read_vtu(folder.file("map.vtu")).chart, map.chart);
  map.chart[3] = -1;
  error_message(ErrorKind::Invalid, [&] { write_vtu(folder.file("map.vtu"), map); });
  map.chart.conservativeResize(4);
  error_message(ErrorKind::Invalid, [&] { write_vtu(folder.file("map.vtu"), map); });
}

TEST(Vtu, RoundTripKeepsEveryFiniteDouble) {
  const TemporaryFolder folder;
  MapFile map = random_strip(3, 40, 1);
  std::mt19937_64 random(5);
  for (double& x : map.points.reshaped()) {
    do x = std::bit_cast<double>(random());
    while (!std::isfinite(x));
  }
  const double extremes[] = {std::numeric_limits<double>::denorm_min(), 1e300,  -1e300, -0.0,
                             std::numeric_limits<double>::max(),        1e-310, 0.1};
  for (Eigen::Index i = 0; i < map.uv.size(); ++i) map.uv.data()[i] = extremes[i % 7];
  write_vtu(folder.file("map.vtu"), map);
  expect_same(map, read_vtu(folder.file("map.vtu")));
}

TEST(Vtu, OptionalArraysMayBeMissing) {
  const TemporaryFolder folder;
  MapFile map = random_strip(2, 3, 2);
  map.distortion.resize(0);
  map.min_det.resize(0);
  map.input_face.resize(0);
  map.input_vertex.resize(0);
  map.claims.clear();
  write_vtu(folder.file("map.vtu"), map);
  expect_same(map, read_vtu(folder.file("map.vtu")));
}

TEST(Vtu, WriterRefusesUnsoundMapsAndWritesNothing) {
  const TemporaryFolder folder;
  const MapFile good = random_strip(2, 3, 2);
  std::vector<MapFile> bad(6, good);
  bad[0].uv(0, 0) = std::numeric_limits<double>::quiet_NaN();
  bad[1].points(1, 2) = std::numeric_limits<double>::infinity();
  bad[2].cells(0, 0) = static_cast<Index>(good.points.rows());
  bad[3].degree = 3;
  bad[4].distortion.conservativeResize(2);
  bad[5].cells.resize(0, 6);
  for (const MapFile& map : bad) {
    error_message(ErrorKind::Invalid, [&] { write_vtu(folder.file("bad.vtu"), map); });
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// Returns one triangle in a given encoding; `points` and `uv` are DataArray elements.
std::string triangle_file(const std::string& points, const std::string& uv,
                          const std::string& file_attributes, const std::string& appended = "") {
  return "<VTKFile type=\"UnstructuredGrid\" " + file_attributes +
         "><!-- c --><UnstructuredGrid><Piece NumberOfPoints='3' NumberOfCells='1'><Points>" +
         points + "</Points><PointData>" + uv +
         "</PointData><Cells><DataArray type='Int64' Name='connectivity' format='ascii'>0 1 2"
         "</DataArray><DataArray type='Int64' Name='offsets' format='ascii'>3</DataArray>"
         "<DataArray type='UInt8' Name='types' format='ascii'>5</DataArray></Cells></Piece>"
         "</UnstructuredGrid>" +
         appended + "</VTKFile>\n";
}

const std::string kAsciiPoints =
    "<DataArray type='Float64' NumberOfComponents='3' format='ascii'>0 0 0\n1 0 0 0 1 0"
    "</DataArray>";
const std::string kAsciiUv =
    "<DataArray type='Float64' Name='UV' NumberOfComponents='3' format='ascii'>0 0 9 0.1 0 9 "
    "0 1e-3 9</DataArray>";
const std::string kLittle = "byte_order='LittleEndian' header_type='UInt32'";

template <class Header, class Value>
std::string payload(const std::vector<Value>& values, bool big_endian) {
  std::string data;
  const auto add = [&](auto value) {
    char bytes[sizeof(value)];
    std::memcpy(bytes, &value, sizeof(value));
    if (big_endian) std::reverse(std::begin(bytes), std::end(bytes));
    data.append(bytes, sizeof(value));
  };
  add(static_cast<Header>(values.size() * sizeof(Value)));
  for (const Value value : values) add(value);
  return data;
}

const std::vector<double> kUv = {0, 0, 0.1, 0, 0, 1e-3};

TEST(Vtu, ReadsForeignEncodings) {
  const TemporaryFolder folder;
  const auto expect_uv = [&](const std::string& content) {
    const MapFile map = read_vtu(folder.write("foreign.vtu", content));
    EXPECT_EQ(map.degree, 1);
    EXPECT_EQ(map.uv(1, 0), 0.1);
    EXPECT_EQ(map.uv(2, 1), 1e-3);
    EXPECT_EQ(map.points(2, 1), 1.0);
    EXPECT_EQ(map.input_vertex.size(), 0);
  };
  const auto array = [](const std::string& attributes, const std::string& text) {
    return "<DataArray type='Float64' Name='uv' NumberOfComponents='2' " + attributes + ">" + text +
           "</DataArray>";
  };
  expect_uv(triangle_file(kAsciiPoints, kAsciiUv, kLittle));
  std::string joint;
  append_base64(payload<std::uint32_t>(kUv, false), joint);
  expect_uv(triangle_file(kAsciiPoints, array("format='binary'", "\n " + joint + "\n"), kLittle));
  const std::string big = payload<std::uint64_t>(kUv, true);
  std::string split;
  append_base64(big.substr(0, 8), split);
  append_base64(big.substr(8), split);
  expect_uv(triangle_file(kAsciiPoints, array("format='binary'", split),
                          "byte_order='BigEndian' header_type='UInt64'"));
  const std::string appended = array("format='appended' offset='2'", "");
  const std::string raw = payload<std::uint32_t>(kUv, false);
  expect_uv(triangle_file(kAsciiPoints, appended, kLittle,
                          "<AppendedData encoding='raw'>\n_xx" + raw + "</AppendedData>"));
  expect_uv(triangle_file(kAsciiPoints, appended, kLittle,
                          "<AppendedData encoding='base64'>_xx" + joint + "</AppendedData>"));
}

TEST(Vtu, RefusesUnsupportedContent) {
  const TemporaryFolder folder;
  const std::string good = triangle_file(kAsciiPoints, kAsciiUv, kLittle);
  const auto expect_refused = [&](const std::string& from, const std::string& to,
                                  const std::string& reason) {
    std::string content = good;
    ASSERT_NE(content.find(from), std::string::npos) << from;
    content.replace(content.find(from), from.size(), to);
    const std::string path = folder.write("bad.vtu", content);
    const std::string message = error_message(ErrorKind::Unreadable, [&] { read_vtu(path); });
    EXPECT_NE(message.find(reason), std::string::npos) << message;
    EXPECT_NE(message.find("bad.vtu"), std::string::npos) << message;
  };
  expect_refused("Name='UV'", "Name='VU'", "no PointData array 'uv'");
  expect_refused("header_type='UInt32'", "compressor='vtkLZ4DataCompressor'", "compress");
  expect_refused("0.1", "nan", "not finite");
  expect_refused("0 1 2", "0 1 3", "out of range");
  expect_refused("0 1 2", "0 1 -1", "out of range");
  expect_refused("0 1 2", "0 1 99999999999", "out of range");
  expect_refused("0 1 2", "0 1", "disagree");
  expect_refused(">3<", ">4<", "no triangle of degree");
  expect_refused(">5<", ">22<", "type 22");
  expect_refused("NumberOfPoints='3'", "NumberOfPoints='4'", "NumberOfPoints");
  expect_refused("NumberOfCells='1'", "NumberOfCells='7'", "disagree");
  expect_refused("9 0.1", "9 9 0.1", "components");
  expect_refused("UnstructuredGrid\" ", "PolyData\" ", "not a VTK UnstructuredGrid");
  expect_refused("format='ascii'>0 0 0", "format='raw'>0 0 0", "unknown format");
  expect_refused("</Cells>", "", "end tag");
  expect_refused("<PointData>",
                 "<PointData><DataArray type='Float64' Name='RationalWeights' format='ascii'>"
                 "1 2 1</DataArray>",
                 "rational");
  const auto point_data = [](const std::string& tag, const std::string& name,
                             const std::string& values) {
    return "<PointData" + tag + "><DataArray type='Float64' Name='" + name + "' format='ascii'>" +
           values + "</DataArray>";
  };
  expect_refused("<PointData>", point_data(" RationalWeights='w'", "w", "1 1 -5"), "rational");
  expect_refused("<PointData>", point_data(" RationalWeights='w'", "w", "0 0 0"), "rational");
  expect_refused("<PointData>", point_data(" RationalWeights='w'", "w", "1 1"), "one number per");
  expect_refused("<PointData>", point_data(" RationalWeights='x'", "w", "1 1 1"), "not there");
  for (const std::string degrees : {"2 2 2", "1 2 0", "1 1 5", "1 1", "1 1 1 1 1 1"})
    expect_refused("<Cells>",
                   "<CellData HigherOrderDegrees='d'><DataArray type='Float64' Name='d' "
                   "NumberOfComponents='3' format='ascii'>" +
                       degrees + "</DataArray></CellData><Cells>",
                   "HigherOrderDegrees");
  error_message(ErrorKind::Unreadable, [&] { read_vtu(folder.file("absent.vtu")); });
  error_message(ErrorKind::Unreadable, [&] { read_vtu(folder.write("empty.vtu", "")); });
  error_message(ErrorKind::Unreadable, [&] {
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "<a>";
    read_vtu(folder.write("deep.vtu", deep));
  });
}

TEST(Vtu, RefusesMixedCells) {
  const TemporaryFolder folder;
  const std::string content =
      "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='3' "
      "NumberOfCells='2'><Points>" +
      kAsciiPoints + "</Points><PointData>" + kAsciiUv +
      "</PointData><Cells><DataArray type='Int64' Name='connectivity'>0 1 2 0 1 2 0 1 2</DataArray>"
      "<DataArray type='Int64' Name='offsets'>3 9</DataArray>"
      "<DataArray type='UInt8' Name='types'>76 76</DataArray></Cells></Piece></UnstructuredGrid>"
      "</VTKFile>";
  const std::string path = folder.write("mixed.vtu", content);
  const std::string message = error_message(ErrorKind::Unreadable, [&] { read_vtu(path); });
  EXPECT_NE(message.find("another number of points"), std::string::npos) << message;
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
