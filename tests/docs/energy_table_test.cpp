// Compares the table of docs/energies.md with the declarations of the built-in energies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "majorant/energies/energy_factory.h"
#include "majorant/framework/energy_term.h"

namespace majorant {
namespace {

enum Column { kName, kFormula, kMinimum, kBarrier, kConvex, kCurvature, kFreeBoundary, kReference };

// Returns the cells of a table line without surrounding spaces and backquotes; "\|" is a bar in a
// cell.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out(1);
  for (std::size_t k = 1; k < line.size(); ++k) {
    if (line[k] == '|' && line[k - 1] != '\\')
      out.emplace_back();
    else
      out.back() += line[k];
  }
  out.pop_back();
  for (std::string& cell : out) {
    cell.erase(0, cell.find_first_not_of(" `"));
    cell.erase(cell.find_last_not_of(" `") + 1);
  }
  return out;
}

std::map<std::string, std::vector<std::string>> table_of_energies() {
  std::ifstream page(MAJORANT_SOURCE_DIR "/docs/energies.md");
  std::string line;
  while (std::getline(page, line) && line != "## Built-in energies") continue;
  std::map<std::string, std::vector<std::string>> rows;
  while (std::getline(page, line) && !line.starts_with("## "))
    if (line.starts_with("| `")) {
      const std::vector<std::string> row = cells(line);
      rows[row.front()] = row;
    }
  return rows;
}

std::string in_words(Barrier barrier) {
  if (barrier == Barrier::None) return "none";
  return barrier == Barrier::Weak ? "weak" : "strong";
}

std::string in_words(FreeScale scale) {
  if (scale == FreeScale::Determined) return "determined";
  return scale == FreeScale::Arbitrary ? "arbitrary" : "collapses";
}

// Returns the curvatures besides `projected` and `exact`, which all energies have.
std::string special_curvatures(const DensityTraits& traits) {
  std::string list;
  for (const Curvature c :
       {Curvature::Majorizer, Curvature::CompositeMajorizer, Curvature::Reweighted})
    if (std::count(traits.curvatures.begin(), traits.curvatures.end(), c))
      list += (list.empty() ? "" : ", ") + std::string(curvature_name(c));
  return list.empty() ? "-" : list;
}

TEST(EnergyTable, AgreesWithTheDeclarations) {
  const auto rows = table_of_energies();
  ASSERT_EQ(rows.size(), named_energies().size());
  for (const NamedEnergy& e : named_energies()) {
    SCOPED_TRACE(e.name);
    ASSERT_TRUE(rows.count(e.name));
    const std::vector<std::string>& row = rows.at(e.name);
    ASSERT_EQ(row.size(), kReference + 1U);
    const DensityTraits& traits = e.make.traits();
    for (const Curvature c : {Curvature::Projected, Curvature::Exact})
      EXPECT_TRUE(std::count(traits.curvatures.begin(), traits.curvatures.end(), c));
    EXPECT_EQ(row[kBarrier], in_words(traits.barrier));
    EXPECT_EQ(row[kCurvature], special_curvatures(traits));
    // The paper's majorizer exists for convex densities.
    EXPECT_EQ(row[kConvex],
              row[kCurvature].find("paper-majorizer") != std::string::npos ? "yes" : "no");
    EXPECT_TRUE(row[kFreeBoundary].starts_with(in_words(traits.free_scale))) << row[kFreeBoundary];
    // The page has "4, isometries", --help has "...; isometry 4".
    const std::string minimum = row[kMinimum].substr(0, row[kMinimum].find(','));
    EXPECT_TRUE(e.summary.ends_with(' ' + minimum)) << e.summary;
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
