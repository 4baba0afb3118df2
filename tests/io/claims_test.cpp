// Claims: rules that several front ends depend on are read by one function.
#include "majorant/io/claims.h"

#include <fmt/format.h>

#include "expected_error.h"

namespace majorant {
namespace {

TEST(Claims, StartsAreKnownByTheRequirementsOfRules) {
  const auto start = [](const char* name) {
    return parse_claims(fmt::format(R"({{"init": "{}"}})", name), "a.vtu");
  };
  EXPECT_EQ(start("input").init, ClaimedStart::Input);
  EXPECT_EQ(start("planar").init, ClaimedStart::Planar);
  EXPECT_EQ(start("of a later version").init, ClaimedStart::Other);
  for (const char* name : {"tutte", "multiresolution"})
    EXPECT_TRUE(starts_at_tutte_boundary(start(name))) << name;
  for (const char* name : {"input", "planar", "field"})
    EXPECT_FALSE(starts_at_tutte_boundary(start(name))) << name;
  EXPECT_TRUE(starts_at_tutte_boundary(parse_claims("", "a.vtu")));
}

TEST(Claims, HeldPointsAndBoundariesAreRecognized) {
  const auto held = [](const char* text) { return held_by(parse_claims(text, "a.vtu")); };
  EXPECT_EQ(held(""), Held::Nothing);
  EXPECT_EQ(held(R"({"pins": [], "boundary": "free", "options": {"handles": ""}})"), Held::Nothing);
  EXPECT_EQ(held(R"({"pins": [{"vertex": 1, "target": [0, 0]}]})"), Held::Points);
  EXPECT_EQ(held(R"({"options": {"handles": "points.json"}})"), Held::Points);
  EXPECT_EQ(held(R"({"boundary": "fixed"})"), Held::Boundary);
}

TEST(Claims, CutsAreEdgesByTheirVertices) {
  EXPECT_FALSE(parse_claims("{}", "a.vtu").cuts);
  EXPECT_TRUE(parse_claims(R"({"cuts": []})", "a.vtu").cuts.value().empty());
  const auto cuts = parse_claims(R"({"cuts": [[3, 1], [0, 7]]})", "a.vtu").cuts.value();
  ASSERT_EQ(cuts.size(), 2u);
  EXPECT_EQ(cuts[0], (std::array<Index, 2>{3, 1}));
  expect_contains(error_message(ErrorKind::Unreadable,
                                [&] { parse_claims(R"({"cuts": [[3, 1], [0]]})", "a.vtu"); }),
                  {"a.vtu: majorant_claims.cuts[1] is not a list of two vertices"});
}

TEST(Claims, RefusedClaimsAreIgnoredByPictures) {
  const std::string good = R"({"energy": "mips", "degree": 2})";
  EXPECT_EQ(readable_claims(good).energy, "mips");
  for (const std::string bad : {"{", "[]", "3", R"({"energy": "mips", "degree": 0})",
                                R"({"energy": "mips", "boundary": "open"})"}) {
    EXPECT_FALSE(readable_claims(bad).energy) << bad;
    expect_contains(error_message(ErrorKind::Unreadable, [&] { parse_claims(bad, "a.vtu"); }),
                    {"a.vtu: majorant_claims", "damaged file"});
    // If no file is known, the message names none.
    EXPECT_EQ(error_message(ErrorKind::Unreadable, [&] { parse_claims(bad, ""); }).find("majorant"),
              0u);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
