// glTF with geometry compressed by Draco or meshoptimizer: reading restores the compressed data.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#ifdef MAJORANT_HAS_DRACO
#include <draco/compression/encode.h>
#endif
#ifdef MAJORANT_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include "io/io_test_helpers.h"
#include "majorant/framework/error.h"
#include "majorant/io/base64.h"
#include "majorant/io/internal/gltf_compression.h"
#include "majorant/io/read_mesh.h"

namespace majorant {
namespace {

using Json = nlohmann::json;
using Corner = std::array<float, 5>;  // position, texture coordinates

struct Grid {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 2>> uv;
  std::vector<std::uint32_t> indices;
};

Grid bumpy_grid(int n) {
  Grid grid;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const float x = static_cast<float>(i) / static_cast<float>(n),
                  y = static_cast<float>(j) / static_cast<float>(n);
      grid.positions.push_back({x, y, 0.3F * x * y * (1 - x)});
      grid.uv.push_back({y, x});
    }
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (const std::uint32_t v :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        grid.indices.push_back(v);
  return grid;
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

Json data_buffer(const std::string& bytes) {
  std::string uri = "data:application/octet-stream;base64,";
  append_base64(bytes, uri);
  return {{"byteLength", bytes.size()}, {"uri", uri}};
}

// Returns a document without buffers and views: three accessors of one primitive.
Json document_of(const Grid& grid) {
  Json json = Json::parse(R"({
    "asset": {"version": "2.0"},
    "accessors": [
      {"componentType": 5126, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
      {"componentType": 5126, "type": "VEC2"},
      {"componentType": 5125, "type": "SCALAR"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2}]}],
    "nodes": [{"mesh": 0}],
    "scenes": [{"nodes": [0]}],
    "buffers": [],
    "bufferViews": []})");
  json["accessors"][0]["count"] = json["accessors"][1]["count"] = grid.positions.size();
  json["accessors"][2]["count"] = grid.indices.size();
  return json;
}

void require(Json& json, const char* extension) {
  for (const char* key : {"extensionsUsed", "extensionsRequired"})
    json[key] = Json::array({Json(extension)});
}

class CompressedGltf : public ::testing::Test {
 protected:
  std::string written(const Json& document) { return folder_.write("a.gltf", document.dump()); }

  // Returns the triangles of a file as multisets of corners, each from its least corner on.
  std::map<std::array<Corner, 3>, int> triangles_of(const Json& document) {
    const PolygonMesh mesh = read_mesh(written(document));
    std::map<std::array<Corner, 3>, int> triangles;
    for (std::size_t p = 0; p < mesh.polygons.size(); ++p) {
      std::array<Corner, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3 x = mesh.positions[mesh.polygons[p][k]];
        const Vector2 uv = mesh.texcoords[mesh.polygon_texcoords[p][k]];
        for (int c = 0; c < 3; ++c) corners[k][c] = static_cast<float>(x[c]);
        for (int c = 0; c < 2; ++c) corners[k][3 + c] = static_cast<float>(uv[c]);
      }
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      ++triangles[corners];
    }
    return triangles;
  }

  Json plain(const Grid& grid) {
    Json json = document_of(grid);
    for (const std::string& bytes :
         {bytes_of(grid.positions), bytes_of(grid.uv), bytes_of(grid.indices)}) {
      json["accessors"][json["buffers"].size()]["bufferView"] = json["buffers"].size();
      json["bufferViews"].push_back(
          {{"buffer", json["buffers"].size()}, {"byteLength", bytes.size()}});
      json["buffers"].push_back(data_buffer(bytes));
    }
    return json;
  }

  // Changes bytes of the first buffer: reading gives a result or an Error.
  void survives_damage(Json json, const std::string& bytes) {
    std::mt19937 random(7);
    int refused = 0;
    for (int k = 0; k < 200; ++k) {
      std::string damaged = bytes;
      if (k % 4 == 0)
        damaged.resize(random() % bytes.size());
      else
        for (int change = 0; change <= k % 4; ++change)
          damaged[random() % damaged.size()] = static_cast<char>(random());
      json["buffers"][0] = data_buffer(damaged);
      json["buffers"][0]["byteLength"] = bytes.size();
      if (k % 4 == 0) json["buffers"][0] = data_buffer(damaged.append(bytes.size(), 'x'));
      try {
        read_mesh(written(json));
      } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("a.gltf"), std::string::npos);
        ++refused;
      }
    }
    EXPECT_GT(refused, 0);
  }

  TemporaryFolder folder_;
};

#ifdef MAJORANT_HAS_MESHOPTIMIZER

// Returns three views, compressed into buffer 0, and a fallback buffer without bytes.
Json meshopt_document(const Grid& grid, std::string& compressed, bool is_strip_of_indices) {
  Json json = document_of(grid);
  require(json, "EXT_meshopt_compression");
  std::size_t place = 0;
  const auto add = [&](std::string bytes, std::size_t count, std::size_t stride, const char* mode) {
    json["accessors"][json["bufferViews"].size()]["bufferView"] = json["bufferViews"].size();
    Json view{{"buffer", 1}, {"byteOffset", place}, {"byteLength", count * stride}};
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", compressed.size()},
                                                     {"byteLength", bytes.size()},
                                                     {"byteStride", stride},
                                                     {"count", count},
                                                     {"mode", mode}};
    json["bufferViews"].push_back(view);
    compressed += bytes;
    place += count * stride;
  };
  const auto vertices = [&](const auto& values) {
    const std::size_t size = sizeof(values[0]);
    std::string bytes(meshopt_encodeVertexBufferBound(values.size(), size), '\0');
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                            bytes.size(), values.data(), values.size(), size));
    add(bytes, values.size(), size, "ATTRIBUTES");
  };
  vertices(grid.positions);
  vertices(grid.uv);
  const std::size_t count = grid.indices.size(), most = grid.positions.size();
  std::string bytes(is_strip_of_indices ? meshopt_encodeIndexSequenceBound(count, most)
                                        : meshopt_encodeIndexBufferBound(count, most),
                    '\0');
  auto* const out = reinterpret_cast<unsigned char*>(bytes.data());
  bytes.resize(is_strip_of_indices
                   ? meshopt_encodeIndexSequence(out, bytes.size(), grid.indices.data(), count)
                   : meshopt_encodeIndexBuffer(out, bytes.size(), grid.indices.data(), count));
  add(bytes, count, 4, is_strip_of_indices ? "INDICES" : "TRIANGLES");
  json["buffers"].push_back(data_buffer(compressed));
  Json fallback{{"byteLength", place}};
  fallback["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
  json["buffers"].push_back(fallback);
  return json;
}

TEST_F(CompressedGltf, MeshoptIsDecoded) {
  const Grid grid = bumpy_grid(7);
  const auto expected = triangles_of(plain(grid));
  EXPECT_EQ(expected.size(), 98u);
  for (const bool is_sequence : {false, true}) {
    std::string compressed;
    EXPECT_EQ(triangles_of(meshopt_document(grid, compressed, is_sequence)), expected);
  }
}

TEST_F(CompressedGltf, FiltersOfMeshopt) {
  const Grid grid = bumpy_grid(7);
  std::string compressed;
  Json json = meshopt_document(grid, compressed, false);
  std::vector<std::uint32_t> filtered(3 * grid.positions.size());
  constexpr int kBits = 24;  // the precision of a float
  meshopt_encodeFilterExp(filtered.data(), grid.positions.size(), 3 * sizeof(float), kBits,
                          grid.positions[0].data());
  std::string bytes(meshopt_encodeVertexBufferBound(grid.positions.size(), 12), '\0');
  bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                          bytes.size(), filtered.data(), grid.positions.size(),
                                          12));
  Json& view = json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"];
  view["byteOffset"] = compressed.size();
  view["byteLength"] = bytes.size();
  view["filter"] = "EXPONENTIAL";
  json["buffers"][0] = data_buffer(compressed + bytes);
  const PolygonMesh mesh = read_mesh(written(json));
  ASSERT_EQ(mesh.positions.size(), grid.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mesh.positions[v][c], grid.positions[v][c], 1e-6);
  // Filters of other strides, and an unknown one.
  for (const char* filter : {"OCTAHEDRAL", "QUATERNION", "COLOR"}) {
    view["filter"] = filter;
    const auto message = error_message(ErrorKind::Unreadable, [&] { read_mesh(written(json)); });
    EXPECT_NE(message.find("filter"), std::string::npos) << message;
  }
}

TEST_F(CompressedGltf, DamagedMeshopt) {
  std::string compressed;
  const Json json = meshopt_document(bumpy_grid(7), compressed, false);
  survives_damage(json, compressed);
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, Json>>{{"count", 1000000},
                                                 {"count", 0.5},
                                                 {"byteStride", 3},
                                                 {"byteStride", 260},
                                                 {"mode", "POINTS"},
                                                 {"buffer", 7},
                                                 {"byteLength", 1 << 30}}) {
    Json wrong = json;
    wrong["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
    error_message(ErrorKind::Unreadable, [&] { read_mesh(written(wrong)); });
  }
}

#endif

#ifdef MAJORANT_HAS_DRACO

Json draco_document(const Grid& grid, std::string& compressed, bool is_sequential) {
  draco::Mesh mesh;
  const auto points = static_cast<std::uint32_t>(grid.positions.size());
  mesh.set_num_points(points);
  const auto attribute = [&](draco::GeometryAttribute::Type type, const auto& values) {
    draco::GeometryAttribute entry;
    const auto width = static_cast<std::int8_t>(values[0].size());
    entry.Init(type, nullptr, width, draco::DT_FLOAT32, false, sizeof(values[0]), 0);
    const int id = mesh.AddAttribute(entry, true, points);
    for (std::uint32_t p = 0; p < points; ++p)
      mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(p), values[p].data());
    return mesh.attribute(id)->unique_id();
  };
  const auto position = attribute(draco::GeometryAttribute::POSITION, grid.positions);
  const auto uv = attribute(draco::GeometryAttribute::TEX_COORD, grid.uv);
  for (std::size_t k = 0; k < grid.indices.size(); k += 3)
    mesh.AddFace({{draco::PointIndex(grid.indices[k]), draco::PointIndex(grid.indices[k + 1]),
                   draco::PointIndex(grid.indices[k + 2])}});
  draco::Encoder encoder;  // without quantization
  encoder.SetEncodingMethod(is_sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                          : draco::MESH_EDGEBREAKER_ENCODING);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  compressed.assign(buffer.data(), buffer.size());

  Json json = document_of(grid);
  require(json, "KHR_draco_mesh_compression");
  json["buffers"].push_back(data_buffer(compressed));
  json["bufferViews"].push_back({{"buffer", 0}, {"byteLength", compressed.size()}});
  json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}}};
  return json;
}

TEST_F(CompressedGltf, DracoIsDecoded) {
  const Grid grid = bumpy_grid(7);
  const auto expected = triangles_of(plain(grid));
  for (const bool is_sequential : {false, true}) {
    std::string compressed;
    Json json = draco_document(grid, compressed, is_sequential);
    EXPECT_EQ(triangles_of(json), expected);
    json["meshes"][0]["primitives"].push_back(json["meshes"][0]["primitives"][0]);
    // Both primitives have one compressed mesh.
    EXPECT_EQ(read_mesh(written(json)).polygons.size(), 2 * 98u);
  }
}

// Quantized positions exceed the bounds of their accessor; colours of three bytes are padded to
// four.
TEST_F(CompressedGltf, AccessorsHaveTheDecodedDracoData) {
  const Grid grid = bumpy_grid(7);
  const auto points = static_cast<std::uint32_t>(grid.positions.size());
  draco::Mesh mesh;
  mesh.set_num_points(points);
  draco::GeometryAttribute position, color;
  position.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  color.Init(draco::GeometryAttribute::COLOR, nullptr, 3, draco::DT_UINT8, true, 3, 0);
  const int positions = mesh.AddAttribute(position, true, points),
            colors = mesh.AddAttribute(color, true, points);
  for (std::uint32_t p = 0; p < points; ++p) {
    const std::array<std::uint8_t, 3> code{static_cast<std::uint8_t>(p), 200, 7};
    mesh.attribute(positions)->SetAttributeValue(draco::AttributeValueIndex(p),
                                                 grid.positions[p].data());
    mesh.attribute(colors)->SetAttributeValue(draco::AttributeValueIndex(p), code.data());
  }
  for (std::size_t k = 0; k < grid.indices.size(); k += 3)
    mesh.AddFace({{draco::PointIndex(grid.indices[k]), draco::PointIndex(grid.indices[k + 1]),
                   draco::PointIndex(grid.indices[k + 2])}});
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 5);
  draco::EncoderBuffer buffer;
  ASSERT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());

  Json json = document_of(grid);
  require(json, "KHR_draco_mesh_compression");
  json["accessors"][0]["max"] = {1, 1, 0.0441};
  json["accessors"][1] = {{"componentType", 5121}, {"type", "VEC3"}, {"normalized", true}};
  json["accessors"][1]["count"] = points;
  json["buffers"].push_back({{"byteLength", buffer.size()}});
  json["bufferViews"].push_back({{"buffer", 0}, {"byteLength", buffer.size()}});
  Json& primitive = json["meshes"][0]["primitives"][0];
  primitive["attributes"] = {{"POSITION", 0}, {"COLOR_0", 1}};
  primitive["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0},
      {"attributes",
       {{"POSITION", mesh.attribute(positions)->unique_id()},
        {"COLOR_0", mesh.attribute(colors)->unique_id()}}}};
  json = Json::parse(json.dump());  // numbers as read from a file
  std::vector<std::string> buffers{std::string(buffer.data(), buffer.size())};
  decode_draco(json, buffers, {[](const std::string& problem) { FAIL() << problem; }, [](auto) {}});

  const auto shown = [&](const char* name) {
    const std::size_t number = json["meshes"][0]["primitives"][0]["attributes"][name];
    const Json& accessor = json["accessors"][number];
    return std::pair(accessor, json["bufferViews"][accessor["bufferView"].get<std::size_t>()]);
  };
  const auto& [places, of_places] = shown("POSITION");
  const std::string& bytes = buffers[of_places["buffer"].get<std::size_t>()];
  ASSERT_EQ(bytes.size(), places["count"].get<std::size_t>() * 12);
  std::array<float, 3> low{1, 1, 1}, high{0, 0, 0};
  for (std::size_t at = 0; at < bytes.size(); at += 12)
    for (std::size_t c = 0; c < 3; ++c) {
      float value = 0;
      std::memcpy(&value, bytes.data() + at + 4 * c, sizeof value);
      low[c] = std::min(low[c], value);
      high[c] = std::max(high[c], value);
    }
  EXPECT_NE(high[2], 0.0441F);
  EXPECT_EQ((places["min"].get<std::array<float, 3>>()), low);
  EXPECT_EQ((places["max"].get<std::array<float, 3>>()), high);
  const auto& [codes, of_codes] = shown("COLOR_0");
  EXPECT_EQ(of_codes["byteStride"], 4);
  EXPECT_EQ(of_codes["byteLength"], 4 * codes["count"].get<std::size_t>());
  EXPECT_FALSE(codes.contains("max"));
}

TEST_F(CompressedGltf, DamagedDraco) {
  std::string compressed;
  const Json json = draco_document(bumpy_grid(7), compressed, false);
  survives_damage(json, compressed);
  const auto refused = [&](const char* part, const Json& value) {
    Json wrong = json;
    wrong["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"][part] = value;
    error_message(ErrorKind::Unreadable, [&] { read_mesh(written(wrong)); });
  };
  refused("bufferView", 3);
  refused("bufferView", "0");
  refused("attributes", 1);
  refused("attributes", {{"POSITION", 17}});
  refused("attributes", {{"NORMAL", 0}});
}

#endif

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
