#include "majorant/maps/energy_text.h"

#include <gtest/gtest.h>

namespace majorant {
namespace {

TEST(EnergyText, IsSplitAtSignsOutsideOfExponents) {
  const auto words = split_energy_text(" 1e+3 * asap+arap + *mips+");
  ASSERT_EQ(words.size(), 4u);
  EXPECT_EQ(words[0].weight, "1e+3");
  EXPECT_EQ(words[0].name, "asap");
  EXPECT_EQ(words[1].weight, std::nullopt);
  EXPECT_EQ(words[1].name, "arap");
  EXPECT_EQ(words[2].weight, "");
  EXPECT_EQ(words[3].name, "");
}

TEST(EnergyText, FindsEnergiesByNameAndWeight) {
  const auto sum = find_energy_sum("symmetric-dirichlet + 0.5*mips");
  ASSERT_TRUE(sum);
  ASSERT_EQ(sum->size(), 2u);
  EXPECT_EQ(sum->at(0).weight, 1);
  EXPECT_EQ(sum->at(1).weight, 0.5);
  EXPECT_EQ(sum->at(1).make.traits().name, "mips");
  for (const char* wrong : {"", "mipss", "0*mips", "-1*mips", "inf*mips", "1e999*mips", "x*mips",
                            "*mips", "mips+", "2*2*mips"})
    EXPECT_FALSE(find_energy_sum(wrong)) << wrong;
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
