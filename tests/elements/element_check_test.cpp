// Wrong descriptions are refused by the constructor of the space, with the reason.
#include "majorant/elements/internal/element_check.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "element_maps.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

class AnySpace final : public BernsteinSpace {
 public:
  AnySpace(const BernsteinElement& element, const Cells& cells)
      : BernsteinSpace(element, cells, static_cast<Index>(cells.cols())) {}
};

Cells one_cell(const BernsteinElement& element) {
  Cells cell(1, element.corner_count());
  for (Index k = 0; k < cell.cols(); ++k) cell(0, k) = k;
  return cell;
}

// Returns the constructor's error for this description; empty if it accepts it.
std::string refusal(const BernsteinElement& element, const Cells& cells) {
  try {
    const AnySpace space(element, cells);
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "";
}

void expect_refused(const std::function<void(BernsteinElement&)>& spoil, const std::string& why,
                    BernsteinElement element = test::wedge(2)) {
  const Cells cells = one_cell(element);
  spoil(element);
  const std::string text = refusal(element, cells);
  EXPECT_NE(text.find(why), std::string::npos) << "'" << text << "' instead of '" << why << "'";
}

TEST(ElementCheck, GoodDescriptionsPass) {
  for (int degree = 1; degree <= 4; ++degree)
    for (const BernsteinElement& e :
         {test::wedge(degree), test::upright_wedge(degree), test::hexahedron(degree)})
      EXPECT_EQ(refusal(e, one_cell(e)), "");
}

TEST(ElementCheck, Factors) {
  expect_refused([](auto& e) { e.factors = {3, 3}; }, "a cell of 4 dimensions");
  expect_refused([](auto& e) { e.factors = {2}; }, "a cell of 1 dimensions");
  expect_refused([](auto& e) { e.factors = {3, 1, 2}; }, "a factor of 1 corners");
}

TEST(ElementCheck, Derivatives) {
  expect_refused([](auto& e) { e.derivatives[1] = {1, 3}; }, "not two of one factor");
  expect_refused([](auto& e) { e.derivatives[1] = {1, 7}; }, "not two of one factor");
  expect_refused([](auto& e) { e.derivatives[1] = {1, 1}; }, "not two of one factor");
  expect_refused([](auto& e) { e.derivatives.pop_back(); }, "2 derivatives for 3 dimensions");
  expect_refused([](auto& e) { e.derivatives[1] = {2, 0}; }, "det J of the identity is 0");
}

std::vector<Exponents> one_missing(const Degrees& n) {
  std::vector<Exponents> all = test::wedge_lattice(n);
  all.pop_back();
  return all;
}

std::vector<Exponents> one_twice(const Degrees& n) {
  std::vector<Exponents> all = test::wedge_lattice(n);
  all.back() = all.front();
  return all;
}

std::vector<Exponents> all_of_one_degree(const Degrees& n) {
  return test::wedge_lattice({n[0], n[0]});
}

std::vector<Exponents> one_of_a_higher_degree(const Degrees& n) {
  std::vector<Exponents> all = test::wedge_lattice(n);
  ++all.back()[0];
  return all;
}

std::vector<Exponents> corners_last(const Degrees& n) {
  std::vector<Exponents> all = test::wedge_lattice(n);
  std::reverse(all.begin(), all.end());
  return all;
}

TEST(ElementCheck, NodeOrders) {
  expect_refused([](auto& e) { e.lattice = one_missing; }, "each once");
  expect_refused([](auto& e) { e.lattice = one_twice; }, "each once");
  expect_refused([](auto& e) { e.lattice = all_of_one_degree; },
                 "functions of these degrees, each once");
  expect_refused([](auto& e) { e.lattice = one_of_a_higher_degree; }, "each once");
  expect_refused([](auto& e) { e.lattice = corners_last; }, "node 0 is no corner");
}

TEST(ElementCheck, Bisections) {
  constexpr int m = EdgeBisection::kMidpoint;
  const std::string child = "not made of the others and the midpoint";
  expect_refused([](auto& e) { e.bisections.clear(); }, "no bisections");
  expect_refused([](auto& e) { e.bisections[0].a = 4; }, "not two of one factor");
  expect_refused([](auto& e) { e.bisections[0].first = {0, 1, 2, 3, 4}; }, child);
  expect_refused([](auto& e) { e.bisections[0].first = {m, 0, 2, 3, 4}; }, child);
  expect_refused([](auto& e) { e.bisections[0].first = {m, 0, m, 3, 4}; }, child);
  expect_refused([](auto& e) { e.bisections[0].first = {m, 0, 3, 1, 4}; }, child);
  expect_refused([](auto& e) { e.bisections[0].second = {m, 2, 0, 3}; }, child);
  expect_refused([](auto& e) { e.bisections[0].second = {m, 2, 9, 3, 4}; }, child);
}

// Tables of another element: the library's computation is wrong, not the user's description.
TEST(ElementCheck, DeterminantsThatDisagree) {
  BernsteinElement other = test::wedge(2);
  other.derivatives[2] = {3, 4};  // the reversed segment
  try {
    check_determinants(test::wedge(2), DetCoefficients(other));
    ADD_FAILURE() << "not refused";
  } catch (const InvalidArgument& e) {
    EXPECT_NE(std::string(e.what()).find("det J of the identity is 8, but"), std::string::npos)
        << e.what();
  }
  EXPECT_NO_THROW(check_determinants(other, DetCoefficients(other)));
}

// Bernstein weights that are not exact in doubles have no bounds.
TEST(ElementCheck, DegreesBeyondExactWeights) {
  expect_refused([](auto& e) { e.degree = e.max_degree = 9; }, "too high for exact",
                 test::hexahedron(2));
  EXPECT_THROW(BernsteinBasis({2, 2, 2}, {{12, 12, 12, 12, 12, 12}}), InvalidArgument);
  EXPECT_NO_THROW(BernsteinBasis({2, 2, 2}, {{8, 8, 8, 8, 8, 8}}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
