// Rules by their polynomial degree of exactness.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "majorant/elements/element_space.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

// A point and all others that result from renumbering the corners.
template <std::size_t Corners>
struct Orbit {
  std::array<double, Corners> point;
  double weight;  // of each of them
};

template <std::size_t Corners>
Quadrature symmetric_rule(const std::vector<Orbit<Corners>>& orbits) {
  std::vector<double> coordinates, weights;
  for (auto [point, weight] : orbits) {
    std::sort(point.begin(), point.end());
    do {
      coordinates.insert(coordinates.end(), point.begin(), point.end());
      weights.push_back(weight);
    } while (std::next_permutation(point.begin(), point.end()));
  }
  const auto size = static_cast<Index>(weights.size());
  return {{static_cast<int>(Corners)},
          Eigen::Map<const RowMatrix>(coordinates.data(), size, Corners),
          Eigen::Map<const Vec>(weights.data(), size)};
}

struct ExactRule {
  int degree;
  Quadrature rule;
};

// The rules of the triangle, by degree. Their digits are solutions of the moment equations of all
// symmetric polynomials of the degree, by Newton's method in 40 digits from random starts. Weights
// are positive and points inside.
const std::vector<ExactRule>& triangle_rules() {
  static const std::vector<ExactRule> rules{
      {1, lattice_rule(1)},
      {2, symmetric_rule<3>({
              {{0.166666666666666666, 0.166666666666666666, 0.666666666666666666},
               0.333333333333333333},
          })},
      {4, symmetric_rule<3>({
              {{0.445948490915964886, 0.445948490915964886, 0.108103018168070227},
               0.223381589678011465},
              {{0.091576213509770743, 0.091576213509770743, 0.816847572980458513},
               0.109951743655321867},
          })},
      {5, radon_rule()},
      {6, symmetric_rule<3>({
              {{0.480137964112215044, 0.480137964112215044, 0.039724071775569911},
               0.080731089593030978},
              {{0.219429982549782960, 0.219429982549782960, 0.561140034900434079},
               0.171333124152981030},
              {{0.141619015923968158, 0.839009259714791053, 0.019371724361240788},
               0.040634559793660662},
          })},
      {8, symmetric_rule<3>({
              {{1.0 / 3, 1.0 / 3, 1.0 / 3}, 0.144315607677787308},
              {{0.459292588292723143, 0.459292588292723143, 0.081414823414553712},
               0.095091634267284681},
              {{0.170569307751760147, 0.170569307751760147, 0.658861384496479705},
               0.103217370534718157},
              {{0.050547228317030964, 0.050547228317030964, 0.898905543365938070},
               0.032458497623198067},
              {{0.008394777409957607, 0.728492392955404282, 0.263112829634638109},
               0.027230314174434995},
          })},
      {10, symmetric_rule<3>({
               {{1.0 / 3, 1.0 / 3, 1.0 / 3}, 0.081743329146286135},
               {{0.032055373216943499, 0.032055373216943499, 0.935889253566113000},
                0.013352968813149555},
               {{0.142161101056564508, 0.142161101056564508, 0.715677797886870982},
                0.045957963604744762},
               {{0.807930600922879096, 0.163701733737182425, 0.028367665339938477},
                0.025297757707288408},
               {{0.530054118927343947, 0.148132885783820466, 0.321812995288835586},
                0.063904906396423998},
               {{0.601233328683459308, 0.029619889488729739, 0.369146781827810951},
                0.034184648162959410},
           })},
      {12, symmetric_rule<3>({
               {{0.488203750945541551, 0.488203750945541551, 0.023592498108916896},
                0.024266838081452033},
               {{0.440111648658593111, 0.440111648658593111, 0.119776702682813777},
                0.049918334928060942},
               {{0.271462507014926084, 0.271462507014926084, 0.457074985970147830},
                0.062541213195902760},
               {{0.109257827659354290, 0.109257827659354290, 0.781484344681291418},
                0.028486052068877544},
               {{0.024646363436335594, 0.024646363436335594, 0.950707273127328810},
                0.007931642509973638},
               {{0.116296019677926586, 0.255454228638517346, 0.628249751683556066},
                0.043227363659414210},
               {{0.127279717233589368, 0.851337792510240041, 0.021382490256170589},
                0.015083677576511438},
               {{0.291655679738340960, 0.023034156355267139, 0.685310163906391899},
                0.021783585038607557},
           })},
  };
  return rules;
}

const std::vector<ExactRule>& tetrahedron_rules() {
  static const std::vector<ExactRule> rules{
      {1, symmetric_rule<4>({{{0.25, 0.25, 0.25, 0.25}, 1}})},
      {2, symmetric_rule<4>({
              {{0.138196601125010515, 0.138196601125010515, 0.138196601125010515,
                0.585410196624968454},
               0.25},
          })},
      {5, walkington_rule()},
      {6, symmetric_rule<4>({
              {{0.040673958534611353, 0.040673958534611353, 0.040673958534611353,
                0.877978124396165940},
               0.010077211055320642},
              {{0.214602871259152029, 0.214602871259152029, 0.214602871259152029,
                0.356191386222543912},
               0.039922750258167492},
              {{0.322337890142275510, 0.322337890142275510, 0.322337890142275510,
                0.032986329573173468},
               0.055357181543654722},
              {{0.063661001875017525, 0.063661001875017525, 0.603005664791649141,
                0.269672331458315808},
               0.048214285714285714},
          })},
      {8, symmetric_rule<4>({
              {{0.185348453378205233, 0.185348453378205233, 0.185348453378205233,
                0.443954639865384299},
               0.051379448421235536},
              {{0.109107046528974343, 0.109107046528974343, 0.109107046528974343,
                0.672678860413076968},
               0.026928016017757431},
              {{0.314118806059586352, 0.314118806059586352, 0.314118806059586352,
                0.057643581821240943},
               0.042069986059939844},
              {{0.042757281786591688, 0.042757281786591688, 0.042757281786591688,
                0.871728154640224934},
               0.007730526846034437},
              {{0.435403141895014922, 0.435403141895014922, 0.064596858104985077,
                0.064596858104985077},
               0.036388483217004532},
              {{0.204086809621538947, 0.204086809621538947, 0.007427946298374305,
                0.584398434458547800},
               0.015281574635244695},
              {{0.021394284140638148, 0.021394284140638148, 0.240231525363438065,
                0.716979906355285638},
               0.007154857974597288},
          })},
  };
  return rules;
}

Quadrature simplex_rule(int corners, int degree) {
  if (corners == 2) return gauss_rule(degree / 2 + 1);
  if (corners != 3 && corners != 4)
    throw InvalidArgument(fmt::format(
        "exact_rule: a factor with {} corners; cells are products of segments, triangles and "
        "tetrahedra",
        corners));
  const auto& rules = corners == 3 ? triangle_rules() : tetrahedron_rules();
  for (const ExactRule& r : rules)
    if (r.degree >= degree) return r.rule;
  throw InvalidArgument(
      fmt::format("exact_rule: degree {} of a {}, {} is the highest; composite_rule() makes rules "
                  "more accurate",
                  degree, corners == 3 ? "triangle" : "tetrahedron", rules.back().degree));
}

}  // namespace

int highest_exactness(const Factors& cell) {
  int degree = std::numeric_limits<int>::max();
  for (const int corners : cell) {
    if (corners == 3) degree = std::min(degree, triangle_rules().back().degree);
    if (corners == 4) degree = std::min(degree, tetrahedron_rules().back().degree);
  }
  return degree;
}

Quadrature exact_rule(const Factors& cell, int degree) {
  require_at_least("exact_rule: the degree", degree, 0);
  if (cell.empty()) throw InvalidArgument("exact_rule: the cell has no factors");
  Quadrature rule = simplex_rule(cell.front(), degree);
  for (std::size_t k = 1; k < cell.size(); ++k)
    rule = product_rule(rule, simplex_rule(cell[k], degree));
  return rule;
}

Quadrature ElementSpace::default_rule(RestJacobian) const {
  throw InvalidArgument("this element space has no default quadrature rule: name one");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
