// Forged checkpoint files with a correct checksum: they are refused by name.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "apps/mpi/checkpoint.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr auto kMost = std::numeric_limits<std::int64_t>::max();

class Forged : public testing::Test {
 protected:
  ~Forged() override { std::filesystem::remove(path_); }

  // Returns a valid file of 4 vertices and 2 faces at degree 2.
  static CheckpointFile sound() {
    CheckpointFile file;
    file.header = Json::parse(R"({"vertices": 4, "faces": 2, "degree": 2, "state": {
        "entering": false, "initial_value": 4.5, "softened": true, "stalls": 1, "refinements": 2,
        "barrier_followed": false, "depth": 5, "remedies": []}})");
    for (std::size_t k = 0; k < RemedyUses().size(); ++k)
      file.header["state"]["remedies"].push_back({{"runs", 1}, {"gained", 0.5}});
    file.start = file.vertex_points = Vec::LinSpaced(8, 0, 1);
    file.other_points = Vec::LinSpaced(12, 0, 1);
    file.levels = {0, 1};
    return file;
  }

  // Returns the error of reading the file; empty if it is valid.
  std::string read(const CheckpointFile& file) const {
    write_checkpoint_file(path_, file);
    try {
      require_state(path_, read_checkpoint_file(path_), 0);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::Unreadable);
      const std::string message = e.what();
      EXPECT_TRUE(message.starts_with(path_ + ": ")) << message;
      return message;
    }
    return "";
  }
  void refuse(const CheckpointFile& file, const std::string& word) const {
    const std::string message = read(file);
    EXPECT_NE(message.find(word), std::string::npos) << file.header << ": " << message;
  }
  void refuse_header(const Json::json_pointer& place, const Json& value) const {
    CheckpointFile file = sound();
    file.header[place] = value;
    refuse(file, "header");
  }

  std::string path_ = (std::filesystem::temp_directory_path() /
                       ("majorant_" + std::to_string(::getpid()) + ".ckpt"))
                          .string();
};

using Place = Json::json_pointer;

TEST_F(Forged, SoundFilesAreAccepted) {
  const CheckpointFile file = sound();
  EXPECT_EQ(read(file), "");
  const CheckpointFile back = read_checkpoint_file(path_);
  EXPECT_EQ(back.header, file.header);
  EXPECT_EQ(back.start, file.start);
  EXPECT_EQ(back.vertex_points, file.vertex_points);
  EXPECT_EQ(back.other_points, file.other_points);
  EXPECT_EQ(back.levels, file.levels);
}

// Bytes that are missing, added or changed.
TEST_F(Forged, Bytes) {
  write_checkpoint_file(path_, sound());
  const std::string bytes = [&] {
    std::ifstream stream(path_, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  }();
  const auto refused = [&](const std::string& other) -> std::string {
    std::ofstream(path_, std::ios::binary) << other;
    try {
      read_checkpoint_file(path_);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::Unreadable);
      return e.what();
    }
    return "read as if it were sound";
  };
  const auto expect = [&](const std::string& other, const std::string& word) {
    const std::string message = refused(other);
    EXPECT_NE(message.find(word), std::string::npos) << message;
  };
  for (std::size_t length = 0; length < bytes.size(); ++length)
    expect(bytes.substr(0, length), length < 8 ? "no checkpoint" : "cut short");
  expect(bytes + "x", "damaged");
  expect("v 0 0 0\n", "no checkpoint");
  for (std::size_t place = 0; place < bytes.size(); ++place) {
    std::string other = bytes;
    other[place] = static_cast<char>(other[place] ^ (1 << place % 8));
    expect(other, place < 8 ? "no checkpoint" : place < 16 ? "version 1" : "damaged");
  }
  // With a correct checksum: headers longer than the file, other versions.
  const auto summed = [](std::string other) {
    other.resize(other.size() - 8);
    const std::uint64_t sum = hashed(std::as_bytes(std::span(other.data(), other.size())));
    return other.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  };
  EXPECT_EQ(summed(bytes), bytes);
  for (const std::uint64_t number : {std::uint64_t{0}, std::uint64_t{2}, std::uint64_t{1} << 63,
                                     std::numeric_limits<std::uint64_t>::max()}) {
    std::string other = bytes;
    std::memcpy(other.data() + 16, &number, sizeof number);
    EXPECT_TRUE(refused(summed(other)).starts_with(path_ + ": "));
    std::memcpy(other.data() + 8, &number, sizeof number);
    expect(summed(other), "version");
  }
}

// Deep JSON is refused, since parsers and copies of values recurse.
TEST_F(Forged, Depth) {
  write_checkpoint_file(path_, sound());
  std::ifstream stream(path_, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(stream), {});
  const std::string deep =
      "\"other\": " + std::string(300000, '[') + std::string(300000, ']') + ",";
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data() + 16, sizeof length);
  length += deep.size();
  std::memcpy(bytes.data() + 16, &length, sizeof length);
  bytes.insert(25, deep);  // after the brace
  bytes.resize(bytes.size() - 8);
  const std::uint64_t sum = hashed(std::as_bytes(std::span(bytes.data(), bytes.size())));
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  std::ofstream(path_, std::ios::binary) << bytes;
  try {
    read_checkpoint_file(path_);
    ADD_FAILURE() << "read as if it were sound";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::Unreadable);
    EXPECT_NE(std::string(e.what()).find("too deeply"), std::string::npos) << e.what();
  }
}

// Counts beyond those of the file, up to sizes that cannot be allocated.
TEST_F(Forged, Counts) {
  for (const char* key : {"/vertices", "/faces", "/degree"})
    for (const Json& value :
         {Json(), Json(true), Json("4"), Json::array(), Json::object(), Json(1.5), Json(4.0),
          Json(-1), Json(5), Json(9), Json(1 << 30), Json(kMost / 32), Json(kMost), Json(-kMost),
          Json(std::uint64_t{1} << 63), Json(std::numeric_limits<std::uint64_t>::max()),
          Json(1e308)})
      refuse_header(Place(key), value);
  refuse_header(Place("/degree"), 0);
  // Counts whose product is correct modulo 2^64.
  CheckpointFile file = sound();
  file.header["vertices"] = (std::uint64_t{1} << 59) + 4;
  refuse(file, "header");
}

TEST_F(Forged, State) {
  const Json of_no_flag{nullptr, 0, 1, "yes"},
      of_no_count{nullptr, -1, 0.5, "1", kMost, 1ULL << 63};
  for (const char* key : {"/state/entering", "/state/softened", "/state/barrier_followed"})
    for (const Json& value : of_no_flag) refuse_header(Place(key), value);
  for (const char* key :
       {"/state/stalls", "/state/refinements", "/state/depth", "/state/remedies/0/runs"})
    for (const Json& value : of_no_count) refuse_header(Place(key), value);
  refuse_header(Place("/state/depth"), 64);
  refuse_header(Place("/state/initial_value"), "4");
  refuse_header(Place("/state/remedies/1/gained"), nullptr);
  refuse_header(Place("/state/remedies"), Json::array({Json::object()}));
  for (const Json& value : {Json(), Json(3), Json::array(), Json::object()}) {
    refuse_header(Place("/state"), value);
    refuse_header(Place("/state/remedies"), value);
    refuse_header(Place(""), value);
  }
  const Json state = sound().header["state"];
  for (const auto& [key, value] : state.items()) {
    CheckpointFile file = sound();
    file.header["state"].erase(key);
    refuse(file, "'" + key + "'");
  }
}

TEST_F(Forged, Points) {
  for (Vec CheckpointFile::*points :
       {&CheckpointFile::start, &CheckpointFile::vertex_points, &CheckpointFile::other_points})
    for (const double number : {std::nan(""), kInfinity, -kInfinity}) {
      CheckpointFile file = sound();
      (file.*points)[(file.*points).size() - 1] = number;
      refuse(file, "not finite");
    }
  CheckpointFile file = sound();
  file.levels[1] = 5;
  refuse(file, "level 5 of 4");
  file.levels.push_back(0);
  refuse(file, "how long");
}

TEST_F(Forged, ReaderOfHeaders) {
  const Json json = Json::parse(R"({"list": [3, 1e400000], "deep": {"x": -7}})", nullptr, false);
  EXPECT_TRUE(json.is_discarded());  // JSON has no infinity
  const Json sound = Json::parse(R"({"list": [3, 0.5], "deep": {"x": -7}, "text": "t"})");
  const HeaderReader reader("f", sound);
  EXPECT_EQ(reader["deep"].integer("x", -7, -7), -7);
  EXPECT_EQ(reader["list"].integer(std::size_t{0}, 3, 3), 3);
  EXPECT_EQ(reader["list"].finite(std::size_t{1}), 0.5);
  EXPECT_EQ(reader.text("text"), "t");
  EXPECT_THROW(reader["deep"].integer("x", -6, 0), Error);
  EXPECT_THROW(reader["deep"].integer("x", -9, -8), Error);
  EXPECT_THROW(reader["list"].at(std::size_t{2}), Error);
  EXPECT_THROW(reader.at(std::size_t{0}), Error);
  EXPECT_THROW(reader["list"].at("x"), Error);
  EXPECT_THROW(reader.text("deep"), Error);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
