// Certificates of every element space through its public interface: they are never wrong, they are
// strong, and steps stay inside them. Tables: element_suite_test.cpp.
#include <gtest/gtest.h>

#include "element_maps.h"

namespace majorant {
namespace {

using test::ElementCase;
using test::Random;
using test::Rational;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kDepth = 6;  // bisections per reference dimension

class Certificate : public testing::TestWithParam<ElementCase> {
 protected:
  const BernsteinSpace& space() const { return *space_; }
  int dim() const { return space_->reference_dim(); }
  int n() const { return GetParam().degree; }
  int depth() const { return kDepth * dim(); }
  double scale() const { return 1.0 / (n() * dim()); }  // of significant perturbations
  // Returns the identity of the mesh, every unknown moved by at most `amplitude`.
  Vec perturbed(double amplitude, Random& random) const {
    const Vec x = test::unknowns(space_->node_positions(GetParam().mesh.vertices));
    return x + amplitude * random.vector(static_cast<Index>(x.size()));
  }
  ContractionTable samples(int m) const {
    const Factors& factors = space_->element().factors;
    return space_->tabulate(test::rule_at(factors, test::lattice_coordinates(factors, m)));
  }
  std::shared_ptr<const BernsteinSpace> space_ = GetParam().space();
  // det J of straight cells is linear or bilinear: its corners determine its sign.
  const bool straight_is_exact_ = !test::is_spatial_product(space_->element());
  const bool linear_ = GetParam().degree == 1 && straight_is_exact_;
  const bool costly_ = GetParam().degree > 1 && !straight_is_exact_;
  Index few_ = std::min<Index>(space_->element_count(), costly_ ? 3 : 12);
};

TEST_P(Certificate, StraightMeshesAreCertified) {
  Random random(1);
  const Vec x = perturbed(0, random);
  const ContractionTable t = samples(4);
  for (Index e = 0; e < space().element_count(); ++e) {
    const PositivityProof proof = space().certify(e, x, 0);
    EXPECT_EQ(proof.result, ProofStatus::Proven);
    const double lowest = test::sampled_det(space(), t, x, e);
    EXPECT_LE(proof.lower_bound, lowest + 1e-12);
    EXPECT_GE(proof.lower_bound, straight_is_exact_ ? lowest - 1e-12 : 0.9 * lowest);
  }
}

// On maps of small to very large perturbations.
TEST_P(Certificate, IsNeverWrongAndBoundsAreClose) {
  Random random(2);
  const ContractionTable t = samples(dim() == 2 ? 24 : 10);
  int certified = 0, refused = 0, bisected = 0;
  for (int trial = 0; trial < 32; ++trial) {
    const Vec x = perturbed(scale() * (0.1 + 0.1 * trial), random);
    for (Index e = 0; e < few_; ++e) {
      const double lowest = test::sampled_det(space(), t, x, e);
      for (const int depth : {0, 3, this->depth()}) {
        const PositivityProof proof = space().certify(e, x, depth);
        ASSERT_LE(proof.lower_bound, lowest + 1e-12);
        ASSERT_LE(proof.depth, depth);
        if (proof.result == ProofStatus::Proven) {
          ASSERT_GT(lowest, -1e-12);
        }
        if (proof.result == ProofStatus::Violated) {
          ASSERT_LE(proof.lower_bound, 1e-12);
        }
      }
      const PositivityProof proof = space().certify(e, x, depth());
      (proof.result == ProofStatus::Proven ? certified : refused) += 1;
      bisected += proof.result == ProofStatus::Proven && proof.depth > 0;
      // Clearly positive determinants are certified.
      if (lowest > 0.05) {
        EXPECT_EQ(proof.result, ProofStatus::Proven) << "minimum " << lowest;
      }
    }
  }
  EXPECT_GT(certified, 10);
  EXPECT_GT(refused, 5);
  EXPECT_TRUE(linear_ || bisected > 0);
}

// Maps that are degenerate up to rounding: certified maps must be positive in exact arithmetic.
class ExactCertificate : public Certificate {
 public:
  static bool is_cheap(const ElementCase& c) {  // the size of polynomials grows rapidly
    const auto space = c.space();
    if (space->reference_dim() == 2) return c.degree <= 3;
    return c.degree <= (test::is_spatial_product(space->element()) ? 1 : 2);
  }
};
TEST_P(ExactCertificate, NearlyDegenerateMapsAgreeWithIt) {
  Random random(3);
  const Factors& factors = space().element().factors;
  std::vector<std::vector<Rational>> points;
  for (const auto& x : test::lattice_coordinates(factors, 4)) {
    points.emplace_back();
    for (const double c : x) points.back().emplace_back(c);
  }
  int certified = 0, negative = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Vec x = perturbed(0.02 * scale(), random);
    const double height = trial % 4 == 0 ? 0 : std::pow(10.0, -12 - trial % 6);
    for (Index k = dim() - 1; k < x.size(); k += dim())  // degenerate, on a skew line or plane
      x[k] = x[k - 1] / 3 + height * x[k];
    const PositivityProof proof = space().certify(0, x, 8);
    const test::ExactPolynomial det =
        test::exact_det(space().element(), test::control_points(space(), x, 0));
    Rational lowest = det(points.front());
    for (const auto& p : points) lowest = std::min(lowest, det(p));
    EXPECT_LE(Rational(proof.lower_bound), lowest);
    if (proof.result == ProofStatus::Proven) {
      EXPECT_GT(lowest, 0);
    }
    certified += proof.result == ProofStatus::Proven;
    negative += lowest <= 0;
  }
  EXPECT_GT(negative, 0);
  EXPECT_GT(certified, 5);
}

TEST_P(Certificate, NonfiniteMapsAreNotCertified) {
  Random random(4);
  for (const double bad : {std::nan(""), kInfinity, -kInfinity})
    for (int k = 0; k < dim() * space().nodes_per_element(); ++k) {
      Vec x = perturbed(0, random);
      x[dim() * space().cells()(0, k / dim()) + k % dim()] = bad;
      EXPECT_NE(space().certify(0, x, 3).result, ProofStatus::Proven);
      EXPECT_EQ(space().largest_step(0, x, Vec::Ones(x.size()), 1, 3), 0);
    }
}

TEST_P(Certificate, StepsStayInsideAndGoFar) {
  Random random(5);
  const ContractionTable t = samples(dim() == 2 ? 16 : 8);
  int limited = 0, improved = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Vec x = perturbed(0.1 * scale(), random);
    const Vec d = random.vector(static_cast<Index>(x.size()));
    for (Index e = 0; e < few_; ++e) {
      ASSERT_EQ(space().certify(e, x, depth()).result, ProofStatus::Proven);
      const double quick = space().largest_step(e, x, d, 2, 0),
                   step = space().largest_step(e, x, d, 2, depth());
      ASSERT_GE(step, quick);
      ASSERT_GT(quick, 0);
      improved += step > quick;
      for (const double s : {0.25, 0.5, 0.75, 0.9, 0.999})
        ASSERT_EQ(space().certify(e, x + s * step * d, depth() + 2).result, ProofStatus::Proven)
            << "at " << s << " of the step " << step;
      if (step == 2) continue;
      ++limited;
      EXPECT_NE(space().certify(e, x + 1.001 * step * d, depth()).result, ProofStatus::Proven);
      EXPECT_LT(test::sampled_det(space(), t, x + 1.05 * step * d, e), 0.06);
      EXPECT_EQ(space().largest_step(e, x, d, 0.5 * step, depth()), 0.5 * step);
    }
  }
  EXPECT_GT(limited, 20);
  EXPECT_TRUE(linear_ || improved > 5);
}

// The order of cells has no effect, the first corner of a cell only a rounding effect.
TEST_P(Certificate, RenumberingChangesNothing) {
  Random random(6);
  const ElementCase& sample = GetParam();
  const Cells& cells = sample.mesh.cells;
  Cells reversed = cells.colwise().reverse(), rotated = cells;
  const std::vector<int>& rotation = sample.rotations.back();
  for (Index e = 0; e < cells.rows(); ++e)
    for (Index k = 0; k < cells.cols(); ++k)
      rotated(e, k) = cells(e, rotation[static_cast<std::size_t>(k)]);
  const auto other = sample.space(reversed), turned = sample.space(rotated);
  const RowMatrix nodes = space().node_positions(sample.mesh.vertices);
  // A smooth nonlinear map, evaluated at positions: the same map for all three spaces.
  const auto image = [&](const BernsteinSpace& s) {
    RowMatrix p = s.node_positions(sample.mesh.vertices);
    for (Index i = 0; i < p.rows(); ++i)
      for (Index c = 0; c < p.cols(); ++c)
        p(i, c) += 0.3 * std::sin(p.row(i).sum() * (1.0 + double(c))) / double(n());
    return test::unknowns(p);
  };
  const Vec x = image(space()), y = image(*other), z = image(*turned);
  for (Index e = 0; e < space().element_count(); ++e) {
    const Index back = space().element_count() - 1 - e;
    for (const int depth : {0, 4}) {
      const PositivityProof a = space().certify(e, x, depth), b = other->certify(back, y, depth);
      EXPECT_EQ(a.result, b.result);
      EXPECT_EQ(a.lower_bound, b.lower_bound);
    }
    EXPECT_NEAR(space().certify(e, x, 0).lower_bound, turned->certify(e, z, 0).lower_bound, 1e-12);
  }
}

// Tables exist for every supported degree.
class CertificateOfTables : public Certificate {};
TEST_P(CertificateOfTables, TheHighestDegreeWorks) {
  const ElementCase& sample = GetParam();
  const auto high =
      sample.make(sample.mesh.cells, space().vertex_count(), space().element().max_degree);
  Random random(7);
  const Vec straight = test::unknowns(high->node_positions(sample.mesh.vertices));
  const Vec d = random.vector(static_cast<Index>(straight.size()));
  const Factors& factors = high->element().factors;
  const ContractionTable t =
      high->tabulate(test::rule_at(factors, test::lattice_coordinates(factors, 5)));
  for (Index e = 0; e < 3; ++e) {
    EXPECT_EQ(high->certify(e, straight, 0).result, ProofStatus::Proven);
    const double step = high->largest_step(e, straight, d, 1, 6);
    ASSERT_GT(step, 0);
    const Vec x = straight + 0.9 * step * d;
    const PositivityProof proof = high->certify(e, x, 8);
    EXPECT_EQ(proof.result, ProofStatus::Proven);
    EXPECT_LE(proof.lower_bound, test::sampled_det(*high, t, x, e));
  }
}

INSTANTIATE_TEST_SUITE_P(All, Certificate, testing::ValuesIn(test::all_elements()),
                         test::case_name);
INSTANTIATE_TEST_SUITE_P(LowDegrees, ExactCertificate,
                         testing::ValuesIn(test::elements_where(ExactCertificate::is_cheap)),
                         test::case_name);
INSTANTIATE_TEST_SUITE_P(Elements, CertificateOfTables,
                         testing::ValuesIn(test::elements_where([](const auto& c) {
                           return c.degree == 1;
                         })),
                         test::case_name);

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
