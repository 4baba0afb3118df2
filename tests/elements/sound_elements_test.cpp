// Certificates against exact arithmetic, on thousands of difficult elements. A certified element
// has det J > 0 at every point of a lattice, for every scale and position.
#include <gtest/gtest.h>

#include <numeric>

#include "element_maps.h"

namespace majorant {
namespace {

using test::ElementCase;
using test::Random;
using Integer = boost::multiprecision::cpp_int;

constexpr int kBisections = 12;
constexpr int kTrials = 24;  // of each kind, for each element

Integer power(Integer x, int e) { return e == 0 ? Integer(1) : x * power(x, e - 1); }

// The sign of det J at lattice points in integer arithmetic: gradients of the basis functions at
// integer coordinates, and control points times a power of two for each component.
class ExactDet {
 public:
  explicit ExactDet(const BernsteinElement& element)
      : dim_(static_cast<std::size_t>(element.dim())) {
    const std::vector<Exponents> nodes = element.lattice(element.degrees());
    const int m = element.dim() == 2 ? 8 : 4;
    for (const auto& point : test::lattice_coordinates(element.factors, m)) {
      std::vector<Integer> gradients;
      for (const Exponents& e : nodes)
        for (const auto& [plus, minus] : element.derivatives)
          gradients.push_back(derivative(element.factors, e, point, m, plus) -
                              derivative(element.factors, e, point, m, minus));
      points_.push_back(gradients);
    }
  }

  bool is_positive(const std::vector<double>& control) const {
    const std::vector<Integer> c = integers(control);
    return std::all_of(points_.begin(), points_.end(), [&](const std::vector<Integer>& gradients) {
      std::vector<Integer> j(dim_ * dim_);
      for (std::size_t k = 0; k * dim_ < c.size(); ++k)
        for (std::size_t row = 0; row < dim_; ++row)
          for (std::size_t d = 0; d < dim_; ++d)
            j[dim_ * row + d] += c[dim_ * k + row] * gradients[dim_ * k + d];
      if (dim_ == 2) return j[0] * j[3] > j[1] * j[2];
      return j[0] * (j[4] * j[8] - j[5] * j[7]) + j[1] * (j[5] * j[6] - j[3] * j[8]) +
                 j[2] * (j[3] * j[7] - j[4] * j[6]) >
             0;
    });
  }

 private:
  static Integer derivative(const Factors& factors, const Exponents& e,
                            const std::vector<double>& point, int m, int by) {
    Integer value(static_cast<long long>(test::exact_weight(factors, e)));
    for (std::size_t q = 0; q < point.size(); ++q) {
      const bool lowered = static_cast<int>(q) == by;
      if (lowered && e[q] == 0) return 0;
      if (lowered) value *= e[q];
      value *= power(Integer(std::lround(point[q] * m)), e[q] - (lowered ? 1 : 0));
    }
    return value;
  }
  std::vector<Integer> integers(const std::vector<double>& control) const {
    constexpr int kDigits = 53;
    std::vector<Integer> out(control.size());
    for (std::size_t component = 0; component < dim_; ++component) {
      int lowest = std::numeric_limits<int>::max();
      for (std::size_t k = component; k < control.size(); k += dim_)
        if (control[k] != 0) lowest = std::min(lowest, std::ilogb(control[k]));
      for (std::size_t k = component; k < control.size(); k += dim_) {
        int exponent = 0;
        // 53 bits, also of a denormal number
        const double fraction = std::frexp(control[k], &exponent);
        if (fraction == 0) continue;
        out[k] = static_cast<long long>(std::ldexp(fraction, kDigits));
        out[k] <<= exponent - 1 - lowest;
      }
    }
    return out;
  }

  std::size_t dim_;
  std::vector<std::vector<Integer>> points_;  // by node, then direction
};

using Control = std::vector<double>;  // D numbers per control point

// Modifications of a straight element.
struct Kind {
  const char* name;
  void (*spoil)(Control& c, int dim, double scale, int trial, Random& random);
};

void perturb(Control& c, int, double scale, int trial, Random& random) {
  for (double& x : c) x += scale * (0.15 + 0.3 * (trial % 12)) * random.uniform();
}

void flatten(Control& c, int dim, double scale, int trial, Random& random) {
  perturb(c, dim, scale, 0, random);
  const double height = trial % 6 == 0 ? 0 : std::pow(10.0, -11 - trial % 6);
  const auto d = static_cast<std::size_t>(dim);
  for (std::size_t k = d - 1; k < c.size(); k += d) c[k] = c[k - 1] / 3 + height * c[k];
}

// Rounds to small integers: det J is often exactly zero somewhere.
void snap(Control& c, int dim, double scale, int trial, Random& random) {
  const double unit = scale * dim;  // between control points
  for (double& x : c) x = std::round((x + 0.4 * unit * (trial % 6) * random.uniform()) / unit);
}

void nudge(Control& c, int dim, double scale, int trial, Random& random) {
  snap(c, dim, scale, trial, random);
  double& x = c[static_cast<std::size_t>(random.integer(0, static_cast<int>(c.size()) - 1))];
  x = std::nextafter(x, random.uniform());
}

template <void (*shape)(Control&, int, double, int, Random&), int low, int high>
void rescale(Control& c, int dim, double scale, int trial, Random& random) {
  shape(c, dim, scale, trial, random);
  const int exponent = random.integer(low, high);
  for (double& x : c) x = std::ldexp(x, exponent);
}

void stretch(Control& c, int dim, double scale, int trial, Random& random) {
  perturb(c, dim, scale, trial, random);
  std::vector<int> exponents;
  for (int d = 0; d < dim; ++d) exponents.push_back(random.integer(-600, 600));
  for (std::size_t k = 0; k < c.size(); ++k)
    c[k] = std::ldexp(c[k], exponents[k % static_cast<std::size_t>(dim)]);
}

void move_far(Control& c, int dim, double scale, int trial, Random& random) {
  perturb(c, dim, scale, trial, random);
  for (double& x : c) x += std::ldexp(1.0, 30 + 2 * (trial % 12));
}

void mix_scales(Control& c, int, double, int, Random& random) {
  for (double& x : c) x = std::ldexp(x + random.uniform(), random.integer(-40, 40));
}

const Kind kKinds[] = {
    {"perturbed", perturb},
    {"nearly flat", flatten},
    {"small integers", snap},
    {"one ulp off", nudge},
    {"tiny", rescale<perturb, -540, -300>},
    {"tiny and flat", rescale<flatten, -540, -300>},
    {"denormal", rescale<snap, -1074, -1070>},
    {"at the edge of underflow", rescale<snap, -545, -345>},
    {"huge", rescale<perturb, 300, 1020>},
    {"stretched", stretch},
    {"far away", move_far},
    {"mixed scales", mix_scales},
};

class Sound : public testing::TestWithParam<ElementCase> {};

TEST_P(Sound, CertifiedMapsArePositiveExactly) {
  const auto space = GetParam().space();
  const int dim = space->reference_dim();
  const ExactDet exact(space->element());
  const Vec straight = test::unknowns(space->node_positions(GetParam().mesh.vertices));
  const double scale = 1.0 / (GetParam().degree * dim);
  const bool large = test::is_spatial_product(space->element()) && GetParam().degree > 2;
  const int trials = large ? kTrials / 4 : kTrials;
  Random random(1);
  int positives = 0, negatives = 0;
  for (const Kind& kind : kKinds) {
    int valid = 0, inverted = 0, proven = 0;
    for (int trial = 0; trial < trials; ++trial) {
      const Index e = random.integer(0, static_cast<int>(space->element_count()) - 1);
      Control c = test::control_points(*space, straight, e);
      kind.spoil(c, dim, scale, trial, random);
      Vec x = straight;
      for (int k = 0; k < space->nodes_per_element(); ++k)
        for (int d = 0; d < dim; ++d)
          x[dim * space->cells()(e, k) + d] = c[static_cast<std::size_t>(dim * k + d)];
      const PositivityProof proof = space->certify(e, x, kBisections);
      const bool positive = exact.is_positive(c), certified = proof.result == ProofStatus::Proven;
      (positive ? valid : inverted) += 1;
      proven += positive && certified;
      EXPECT_TRUE(positive || !certified) << kind.name << ", trial " << trial;
      EXPECT_TRUE(!certified || proof.lower_bound > 0);
    }
    // Within the range of doubles, few are refused.
    const bool usual = kind.spoil == perturb || kind.spoil == flatten || kind.spoil == move_far;
    EXPECT_TRUE(!usual || 10 * proven >= 7 * valid)
        << kind.name << ": " << proven << " of " << valid;
    positives += valid;
    negatives += inverted;
  }
  EXPECT_GT(positives, 2 * trials);
  EXPECT_GT(negatives, 2 * trials);
}

INSTANTIATE_TEST_SUITE_P(All, Sound, testing::ValuesIn(test::all_elements()), test::case_name);

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
