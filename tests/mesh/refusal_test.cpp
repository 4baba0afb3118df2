// Error messages in the words of the library and in those of other front ends.
#include "majorant/mesh/refusal.h"

#include <gtest/gtest.h>

#include <set>

#include "mesh/test_meshes.h"

namespace majorant {
namespace {

TEST(Refusal, ContainsTheRemedyInTheCallersWords) {
  const Refusal refusal(ErrorKind::Unsupported, "a; b.obj", "a; b.obj: face 7: zero area; ",
                        Hint::Repair, " measures it");
  EXPECT_STREQ(refusal.what(), "a; b.obj: face 7: zero area; repair() measures it");
  EXPECT_EQ(refusal.message("the button Repair"),
            "a; b.obj: face 7: zero area; the button Repair measures it");
  EXPECT_EQ(refusal.problem(), "a; b.obj: face 7: zero area");
  const auto words = [](const Refusal& r) { return "`fix " + r.file() + "`"; };
  EXPECT_EQ(message_of(refusal, words), "a; b.obj: face 7: zero area; `fix a; b.obj` measures it");
  EXPECT_EQ(problem_of(refusal), refusal.problem());
  const Error other(ErrorKind::Usage, "no; other");
  EXPECT_EQ(message_of(other, words), "no; other");
  EXPECT_EQ(problem_of(other), "no; other");
}

TEST(Refusal, EveryRemedyHasWordsOfItsOwn) {
  std::set<std::string_view> words;
  const int count = static_cast<int>(Hint::LeaveOutLegends) + 1;
  for (int k = 0; k < count; ++k) words.insert(words_of(static_cast<Hint>(k)));
  EXPECT_EQ(words.size(), static_cast<std::size_t>(count));
  EXPECT_EQ(words.count(""), 0u);
  EXPECT_EQ(words_of(Hint::MakeSeamless), "make_seamless()");
  EXPECT_EQ(words_of(Hint::MapAlone), "map it by itself");
}

TEST(Refusal, IsThrownByTheLibrary) {
  PolygonMesh mesh = grid(3);
  mesh.polygons.push_back(mesh.polygons[0]);
  try {
    SurfaceMesh::from_polygons(mesh);
    FAIL();
  } catch (const Error& error) {
    const auto* const refusal = dynamic_cast<const Refusal*>(&error);
    ASSERT_NE(refusal, nullptr);
    EXPECT_EQ(refusal->hint(), Hint::Repair);
    EXPECT_EQ(refusal->file(), mesh.file);
    EXPECT_EQ(refusal->problem().find("repair()"), std::string::npos);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
