#include "majorant/io/read_vertex_lists.h"

#include "io_test_helpers.h"
#include "public_data.h"

namespace majorant {
namespace {

class ReadHandles : public ::testing::Test {
 protected:
  std::vector<Handle> read(const std::string& content, Index vertices = 100) const {
    return read_handles(folder_.write("handles.json", content), vertices);
  }
  std::string refuse(const std::string& content, Index vertices = 100) const {
    std::string message = error_message(ErrorKind::Unreadable, [&] { read(content, vertices); });
    EXPECT_NE(message.find("handles.json"), std::string::npos) << message;
    return message;
  }

  TemporaryFolder folder_;
};

TEST_F(ReadHandles, Format) {
  const auto handles = read(R"({"mesh": "bar.obj", "note": [1, {"a": null}], "index_base": 0,
      "handles": [{"vertex": 12, "target": [0.1, 2], "why": "x"},
                  {"target": "initial", "vertex": 99}, {"vertex": 12, "target": [0.1, 2.0]}]})");
  ASSERT_EQ(handles.size(), 2u);
  EXPECT_EQ(handles[0].vertex, 12);
  EXPECT_EQ(handles[0].target, Vector2(0.1, 2.0));
  EXPECT_EQ(handles[1].vertex, 99);
  EXPECT_FALSE(handles[1].target.has_value());
  EXPECT_TRUE(read(R"({"handles": []})").empty());
}

TEST_F(ReadHandles, IndexBaseShifts) {
  const std::string list = R"("handles": [{"vertex": 1, "target": [0, 0]}]})";
  EXPECT_EQ(read(R"({"index_base": 1, )" + list, 1)[0].vertex, 0);
  refuse(R"({"index_base": 0, )" + list, 1);
  refuse(R"({"index_base": 2, )" + list);
  refuse(R"({"index_base": "0", )" + list);
}

TEST_F(ReadHandles, RefusesNamingThePlace) {
  const std::string good = R"({"vertex": 0, "target": [0, 0]}, )";
  for (const std::string bad :
       {R"({"vertex": 100, "target": [0, 0]})", R"({"vertex": -1, "target": [0, 0]})",
        R"({"vertex": 18446744073709551615, "target": [0, 0]})",
        R"({"vertex": 4294967296, "target": [0, 0]})", R"({"vertex": 1.5, "target": [0, 0]})",
        R"({"vertex": "1", "target": [0, 0]})", R"({"target": [0, 0]})", R"({"vertex": 1})",
        R"({"vertex": 1, "target": [0]})", R"({"vertex": 1, "target": [0, 0, 0]})",
        R"({"vertex": 1, "target": [0, null]})", R"({"vertex": 1, "target": "start"})",
        R"({"vertex": 1, "target": true})", R"({"vertex": 0, "target": [1, 1]})",
        R"({"vertex": 0, "target": "initial"})", "7", "null"}) {
    const std::string message = refuse("{\"handles\": [" + good + bad + "]}");
    EXPECT_NE(message.find("handles[1]"), std::string::npos) << message;
  }
  refuse(R"({"handles": [{"vertex": 0, "target": [1e999, 0]}]})");
  refuse(R"({"handles": [{"vertex": 0, "target": [NaN, 0]}]})");
  refuse(R"({"handles": {"vertex": 0}})");
  refuse(R"([{"vertex": 0, "target": [0, 0]}])");
  refuse("{}");
  refuse("");
  EXPECT_NE(refuse("{\"handles\":\n[{\"vertex\": 0,").find("handles.json:2: "), std::string::npos);
  refuse(std::string(200000, '['));
  error_message(ErrorKind::Unreadable, [&] { read_handles(folder_.file("absent.json"), 3); });
}

TEST_F(ReadHandles, PublicCollection) {
  const std::filesystem::path bad = public_data("bad"), good = public_data("deform2d");
  if (bad.empty() || good.empty()) GTEST_SKIP() << kNoPublicData;
  for (const char* name : {"out_of_range", "twice", "truncated"}) {
    const std::string path = (bad / "handles_").string() + name + ".json";
    error_message(ErrorKind::Unreadable, [&] { read_handles(path, 1000); });
  }
  EXPECT_FALSE(read_handles((good / "bar.json").string(), 100000).empty());
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
