// Lambdas that are called for several elements at a time: derivatives, branches, domain, bits.
#include "majorant/framework/terms/detail/tape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>

#include "majorant/framework/detail/packed_symmetric.h"
#include "majorant/framework/terms/dual_matrix.h"
#include "majorant/framework/terms/equality.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/internal/tape_kernels.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/list_term.h"
#include "majorant/framework/terms/local_term.h"
#include "majorant/framework/terms/parameter_blocks.h"
#include "random.h"

namespace majorant {
namespace {

using detail::kLanes;
using detail::Lanes;
using std::abs, std::acos, std::asin, std::atan, std::atan2, std::cos, std::cosh, std::exp;
using std::hypot, std::log, std::max, std::min, std::norm, std::pow, std::sin, std::sinh;
using std::sqrt, std::tan, std::tanh;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Returns elements that share no nodes.
Cells apart(Index count, Index nodes) {
  Cells cells(count, nodes);
  for (Index k = 0; k < cells.size(); ++k) cells.data()[k] = static_cast<int>(k);
  return cells;
}

struct Evaluation {
  Vec value;
  RowMatrix gradient, hessian;  // a row an element
};

// Evaluates these elements in batches of `size`, in the order of the list.
Evaluation evaluated(const EnergyTerm& term, const Vec& x, const std::vector<Index>& elements,
                     BlendedCurvature curvature = Curvature::Exact, std::size_t size = 128,
                     const TermState& state = {}) {
  constexpr std::size_t stride = LocalSystem::stride;
  const std::size_t n = to_size(term.element_dofs().local_size()), entries = n * (n + 1) / 2;
  const auto count = static_cast<Index>(elements.size());
  Evaluation all{Vec(count), RowMatrix(count, n), RowMatrix(count, entries)};
  Workspace workspace, local;
  for (std::size_t from = 0; from < elements.size(); from += size) {
    const std::span<const Index> some(elements.data() + from,
                                      std::min(size, elements.size() - from));
    double* memory = local.reserve((1 + n + entries) * stride);
    std::fill_n(memory, (1 + n + entries) * stride, -1.0);  // marks unwritten numbers
    LocalSystem out{memory, memory + stride, memory + (1 + n) * stride};
    term.local(x, {0, some}, curvature, state, workspace, out);
    for (std::size_t p = 0; p < some.size(); ++p) {
      const auto row = static_cast<Index>(from + p);
      all.value[row] = out.value[p];
      for (std::size_t k = 0; k < n; ++k)
        all.gradient(row, static_cast<Index>(k)) = out.gradient[k * stride + p];
      for (std::size_t k = 0; k < entries; ++k)
        all.hessian(row, static_cast<Index>(k)) = out.hessian[k * stride + p];
    }
  }
  return all;
}

std::vector<Index> first_elements(Index count) {
  std::vector<Index> all(to_size(count));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void expect_near(const RowMatrix& a, const RowMatrix& b) {
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-13 * (1 + b.cwiseAbs().maxCoeff()));
}

// Compares f(z), recorded for several elements, with the lambda of dual numbers.
template <int N, int Block, class F>
void expect_as_by_duals(const F& f, const Vec& x, Index count) {
  const auto recorded = make_term<N, Block>("recorded", apart(count, N), f);
  const auto by_duals =
      make_term<N, Block>("by duals", apart(count, N), [f](Index, const auto& z) { return f(z); });
  const auto a = evaluated(*recorded, x, first_elements(count)),
             b = evaluated(*by_duals, x, first_elements(count));
  expect_near(a.value, b.value);
  expect_near(a.gradient, b.gradient);
  expect_near(a.hessian, b.hessian);
}

TEST(Tape, DerivativesOfEveryFunction) {
  constexpr Index kCount = 150;  // more than one batch, with an incomplete last group
  test::Random random(1);
  const Vec x = random.vector(3 * kCount, 0.1, 0.9);
  const auto agree = [&](const auto& f) { expect_as_by_duals<3, 1>(f, x, kCount); };
  agree([](const auto& z) {
    return z[0] * z[1] - z[1] * z[1] + (2.0 - z[2]) * (z[0] - 1.0) - -z[0];
  });
  agree(
      [](const auto& z) { return sqrt(z[0] * z[1]) / z[2] + log(z[0] + 1.0) * exp(z[1] - z[2]); });
  agree([](const auto& z) { return sin(z[0]) * cos(z[1]) + tan(z[2] * z[0]) / 3.0; });
  agree([](const auto& z) { return asin(z[0]) * acos(z[1]) + atan(z[2] * z[0]); });
  agree([](const auto& z) { return sinh(z[0]) * cosh(z[1]) - tanh(z[2] * z[0]); });
  agree([](const auto& z) { return pow(z[0], 2.5) + pow(1.5, z[1]) * pow(z[2], z[0] + z[1]); });
  agree([](const auto& z) { return atan2(z[0], z[1]) * hypot(z[1], z[2]) + atan2(z[0], 2.0); });
  agree([](const auto& z) { return abs(z[0] - z[1]) * min(z[1], z[2]) * max(0.5, z[0] * z[2]); });
  agree([](const auto& z) { return passive(z[0]) * z[1] * z[1] + pow(passive(z[2]), 2.0); });
  agree([](const auto& z) {
    using T = typename std::decay_t<decltype(z)>::Scalar;
    const std::complex<T> a(z[0], z[1]), b(z[1], z[2]);
    return norm(a * a * a - b);
  });
}

TEST(Tape, MatricesWithDataOfElements) {
  constexpr Index kCount = 77;
  test::Random random(2);
  Vec x = random.vector(12 * kCount, -0.2, 0.2);
  for (Index e = 0; e < kCount; ++e)
    for (int k = 0; k < 3; ++k) x[12 * e + 3 * (k + 1) + k] += 1;
  RowMatrix data(kCount, 10);
  for (Index k = 0; k < data.size(); ++k) data.data()[k] = k % 10 % 4 == 0 ? 1.2 : 0.1;
  const auto f = [](const auto& z, const auto& rest) {
    const auto edges = (z.template rightCols<3>().colwise() - z.col(0)).eval();
    const auto F = (edges * rest.template head<9>().reshaped(Eigen::fix<3>, Eigen::fix<3>)).eval();
    return rest[9] * (F.squaredNorm() + F.inverse().squaredNorm() + log(F.determinant()));
  };
  const auto recorded = make_term<4, 3>("recorded", apart(kCount, 4), f, data);
  const auto by_duals = make_term<4, 3>(
      "by duals", apart(kCount, 4),
      [f](Index, const auto& z, const auto& rest) { return f(z, rest); }, data);
  for (const BlendedCurvature curvature :
       {BlendedCurvature(Curvature::Exact), BlendedCurvature(Curvature::Projected),
        BlendedCurvature::projected(0.3), BlendedCurvature::projected(2)}) {
    const auto a = evaluated(*recorded, x, first_elements(kCount), curvature),
               b = evaluated(*by_duals, x, first_elements(kCount), curvature);
    expect_near(a.gradient, b.gradient);
    expect_near(a.hessian, b.hessian);
  }
}

TEST(Tape, AVectorOfDataIsThatOfAllElements) {
  const auto term = make_term<1, 2>(
      "sum", apart(11, 1),
      [](const auto& z, const auto& w) { return w[0] * z.squaredNorm() + w[1]; }, Vec{{3.0, 0.5}});
  const auto all = evaluated(*term, Vec::Ones(22), first_elements(11));
  EXPECT_EQ(all.value, Vec::Constant(11, 6.5));
  EXPECT_EQ(all.hessian, RowMatrix(Eigen::RowVector3d(6, 0, 6).replicate(11, 1)));
}

// Elements of a group may take different branches.
TEST(Tape, BranchesThatElementsDoNotShare) {
  constexpr Index kCount = 100;
  test::Random random(3);
  const Vec x = random.vector(2 * kCount);
  expect_as_by_duals<2, 1>(
      [](const auto& z) {
        using T = typename std::decay_t<decltype(z)>::Scalar;
        if (z[0] < z[1] && !(z[0] > 0.0)) return T(z[0] * z[0] * exp(z[1]));
        return z[1] >= 0.3 ? T(z[1] * z[0]) : T(sin(z[1]));
      },
      x, kCount);
}

// Elements of 2 to 14 corners, some of equal size in a row.
TEST(Tape, ListsOfAnySize) {
  ElementLists lists;
  Index next = 0;
  for (int e = 0; e < 140; ++e) {
    lists.emplace_back();
    for (int k = 0; k < 2 + e / 3 * 5 % 13; ++k) lists.back().push_back(next++);
  }
  const auto count = static_cast<Index>(lists.size());
  test::Random random(7);
  const Vec x = random.vector(3 * next);
  const auto f = [](const auto& z, const auto& factor) {
    const auto center = (z.rowwise().sum() * (1.0 / static_cast<double>(z.cols()))).eval();
    auto energy = (z.colwise() - center).squaredNorm() * factor[0];
    for (Index k = 1; k < z.cols(); ++k) {
      energy += sqrt(1.0 + z.col(k).dot(z.col(k - 1)) * z(0, k));
      if (z(0, k) > z(1, k)) energy += factor[0] * z(0, k) * z(1, k - 1);
    }
    return energy;
  };
  const RowMatrix factors = random.vector(count, 1, 2);
  const Vec one = Vec::Constant(1, 1.5);
  const auto compare = [&](const auto& data) {
    const auto recorded = make_term<3>("recorded", lists, f, data);
    const auto by_duals = make_term<3>(
        "by duals", lists, [f](Index, const auto& z, const auto& row) { return f(z, row); }, data);
    for (const Curvature curvature : {Curvature::Exact, Curvature::Projected}) {
      const auto a = evaluated(*recorded, x, first_elements(count), curvature),
                 b = evaluated(*by_duals, x, first_elements(count), curvature);
      for (Index e = 0; e < count; ++e) {
        if (!std::isfinite(b.value[e])) {
          EXPECT_EQ(a.value[e], b.value[e]);
          continue;
        }
        expect_near(a.gradient.row(e), b.gradient.row(e));
        expect_near(a.hessian.row(e), b.hessian.row(e));
      }
    }
  };
  compare(factors);
  compare(one);
}

// The branch that an element does not take may have infinite value and derivatives.
TEST(Tape, OnlySelectedNumbersCount) {
  constexpr Index kCount = 20;
  Vec x = Vec::LinSpaced(kCount, -1, 1);
  x[4] = 0;
  const auto root = [](const auto& z) {
    return select(z[0] > 0.0, sqrt(z[0]) * log(z[0]) * pow(z[0], 1.5), z[0] * z[0]);
  };
  const auto all =
      evaluated(*make_term<1>("root", apart(kCount, 1), root), x, first_elements(kCount));
  for (Index e = 0; e < kCount; ++e) {
    const auto s = root(std::array{Dual2<double, 1>::variable(x[e], 0)});
    EXPECT_NEAR(all.value[e], s.v, 1e-14) << x[e];
    EXPECT_NEAR(all.gradient(e, 0), s.d[0], 1e-13) << x[e];
    EXPECT_NEAR(all.hessian(e, 0), s.h[0], 1e-12) << x[e];
  }
}

TEST(Tape, OutsideOfTheDomainElementByElement) {
  constexpr Index kCount = 24;
  Vec x = Vec::LinSpaced(kCount, 0.5, 2);
  const auto term = make_term<1>("log", apart(kCount, 1), [](const auto& z) { return log(z[0]); });
  const auto inside = evaluated(*term, x, first_elements(kCount), Curvature::Projected);
  x[3] = -1;
  x[17] = 0;
  const auto all = evaluated(*term, x, first_elements(kCount), Curvature::Projected);
  for (Index e = 0; e < kCount; ++e) {
    if (e == 3) {
      EXPECT_EQ(all.value[e], kInfinity);
    } else if (e == 17) {
      EXPECT_EQ(all.value[e], -kInfinity);
    } else {
      EXPECT_EQ(all.value[e], inside.value[e]);
      EXPECT_EQ(all.gradient(e, 0), inside.gradient(e, 0));
      EXPECT_EQ(all.hessian(e, 0), inside.hessian(e, 0));
    }
  }
}

// The bits of an element do not depend on its group, since threads group elements differently.
TEST(Tape, SameBitsInEveryGroup) {
  constexpr Index kCount = 60;
  test::Random random(4);
  const Vec x = random.vector(6 * kCount);
  const auto term = make_term<3, 2>("any", apart(kCount, 3), [](const auto& z) {
    const auto a = (z.col(1) - z.col(0)).eval(), b = (z.col(2) - z.col(1)).eval();
    auto energy = a.squaredNorm() * atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
    if (a[0] > 0.2) energy += b[1] * b[1] * a[0];
    return energy;
  });
  auto elements = first_elements(kCount);
  const auto all = evaluated(*term, x, elements, Curvature::Projected);
  std::reverse(elements.begin() + 5, elements.end());
  for (const std::size_t size : {1, 3, 7, 50}) {
    const auto some = evaluated(*term, x, elements, Curvature::Projected, size);
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const auto row = static_cast<Index>(k);
      EXPECT_EQ(some.value[row], all.value[elements[k]]);
      EXPECT_EQ(RowMatrix(some.gradient.row(row)), RowMatrix(all.gradient.row(elements[k])));
      EXPECT_EQ(RowMatrix(some.hessian.row(row)), RowMatrix(all.hessian.row(elements[k])));
    }
  }
}

TEST(Tape, ConstantsHaveNoDerivatives) {
  const auto term = make_term<2>("one", apart(3, 2), [](const auto& z) {
    using T = typename std::decay_t<decltype(z)>::Scalar;
    return T(passive(z[0]) * 0.0 + 1.0);
  });
  const auto all = evaluated(*term, Vec::Ones(6), first_elements(3), Curvature::Projected);
  EXPECT_EQ(all.value, Vec::Ones(3));
  EXPECT_EQ(all.gradient, RowMatrix(RowMatrix::Zero(3, 2)));
  EXPECT_EQ(all.hessian, RowMatrix(RowMatrix::Zero(3, 3)));
}

// Expects that both differ by rounding only, with every supported curvature.
void expect_same_term(const EnergyTerm& recorded, const EnergyTerm& by_duals, const Vec& x,
                      const TermState& state = {}) {
  const auto elements = first_elements(recorded.element_dofs().element_count());
  for (const BlendedCurvature curvature :
       {BlendedCurvature(Curvature::Exact), BlendedCurvature(Curvature::Projected),
        BlendedCurvature(Curvature::Reweighted), BlendedCurvature::projected(0.4),
        BlendedCurvature::projected(1.7)}) {
    ASSERT_EQ(recorded.supports(curvature.model), by_duals.supports(curvature.model));
    if (!recorded.supports(curvature.model)) continue;
    const auto a = evaluated(recorded, x, elements, curvature, 128, state),
               b = evaluated(by_duals, x, elements, curvature, 128, state);
    expect_near(a.value, b.value);
    expect_near(a.gradient, b.gradient);
    expect_near(a.hessian, b.hessian);
  }
}

TEST(Tape, ConstraintsAreThoseOfTheirLambda) {
  constexpr Index kCount = 37;
  test::Random random(7);
  const Vec x = random.vector(6 * kCount, -1, 1);
  const auto g = [](const auto& z) {
    return z.col(0).dot(z.col(1)) - sin(z(0, 2)) * z(1, 2) + 0.3 * z(1, 0);
  };
  const auto numbered = [g](Index, const auto& z) { return g(z); };
  const Cells nodes = apart(kCount, 3);
  TermState state;
  state.parameters = random.vector(2 * kCount, -2, 3);
  const auto held = equality<3, 2>("g", nodes, g);
  EXPECT_NE(dynamic_cast<const EqualityTerm*>(held.get()), nullptr);
  expect_same_term(*held, *equality<3, 2>("g", nodes, numbered), x, state);

  const auto recorded = inequality<3, 2>("g", nodes, g);
  const auto by_duals = inequality<3, 2>("g", nodes, numbered);
  expect_same_term(*recorded.penalty(), *by_duals.penalty(), x);
  const auto a = recorded.checker(), b = by_duals.checker();
  EXPECT_EQ(a->check(x).blocking, b->check(x).blocking);
  EXPECT_FALSE(a->check(x).blocking.empty());
  EXPECT_EQ(a->check(x).margin, b->check(x).margin);
  expect_same_term(*a->relaxed(x)->barrier(), *b->relaxed(x)->barrier(), x);
  const auto violation = [&](const BarrierChecker& checker) {
    return dynamic_cast<const ViolationMeasure&>(checker).violation(0.2);
  };
  expect_same_term(*violation(*a), *violation(*b), x);
}

TEST(Tape, ResidualsHaveTheCurvatureOfTheirLoss) {
  constexpr Index kCount = 29;
  test::Random random(8);
  const Vec x = random.vector(4 * kCount, -1, 1);
  const auto f = [](const auto& z, const auto& to) {
    return std::array{z[0] * exp(z[1]) - to[0], z[2] * z[2] - to[1] * z[3], z[0] - z[3]};
  };
  const auto numbered = [f](Index, const auto& z, const auto& to) { return f(z, to); };
  const RowMatrix rows = random.vector(2 * kCount).reshaped<Eigen::RowMajor>(kCount, 2);
  const Vec shared = random.vector(2);
  for (const RobustLoss& loss : {RobustLoss(), huber_loss(0.3), cauchy_loss(0.5), tukey_loss(2)}) {
    expect_same_term(*make_least_squares<4>("f", apart(kCount, 4), f, rows, loss),
                     *make_least_squares<4>("f", apart(kCount, 4), numbered, rows, loss), x);
    expect_same_term(*make_least_squares<4>("f", apart(kCount, 4), f, shared, loss),
                     *make_least_squares<4>("f", apart(kCount, 4), numbered, shared, loss), x);
  }
  const auto one = [](const auto& z) { return z[0] * z[1] - sqrt(z[0] * z[0] + 1.0); };
  const auto single = make_least_squares<2>("one", apart(kCount, 2), one);
  expect_same_term(*single,
                   *make_least_squares<2>("one", apart(kCount, 2),
                                          [one](Index, const auto& z) { return one(z); }),
                   x.head(2 * kCount));
  Vec residuals;
  RowMatrix jacobian;
  dynamic_cast<const ResidualTerm&>(*single).residuals(x, 3, {}, residuals, &jacobian);
  EXPECT_EQ(residuals, Vec::Constant(1, one(x.segment<2>(6))));
  EXPECT_EQ(jacobian(0, 1), x[6]);
}

TEST(Tape, BlocksOfDifferentSizes) {
  constexpr Index kCount = 21;
  const Vec x = test::Random(9).vector(5 * kCount, -1, 1);
  Cells first(kCount, 2);
  for (Index e = 0; e < kCount; ++e) first.row(e) << 5 * e, 5 * e + 3;
  const ParameterBlocks<3, 2> blocks(first);
  const auto f = [](const auto& a, const auto& b) {
    return (a.template head<2>() * b[0] - b).eval();
  };
  expect_same_term(*make_least_squares("f", blocks, f, cauchy_loss(0.4)),
                   *make_least_squares(
                       "f", blocks, [f](Index, const auto& a, const auto& b) { return f(a, b); },
                       cauchy_loss(0.4)),
                   x);
  const auto energy = [](const auto& a, const auto& b) { return cos(a.sum()) * b.squaredNorm(); };
  expect_same_term(
      *make_term("e", blocks, energy),
      *make_term("e", blocks,
                 [energy](Index, const auto& a, const auto& b) { return energy(a, b); }),
      x);
}

// Returns a matrix per lane: random ones, and some with special eigenvalues or blocks.
std::vector<Eigen::MatrixXd> matrices_of(int n, test::Random& random) {
  std::vector<Eigen::MatrixXd> all;
  for (int i = 0; i < kLanes; ++i) {
    Eigen::MatrixXd m = random.vector(n * n).reshaped(n, n);
    m = (m + m.transpose()).eval();
    if (i == 1) m = -Eigen::MatrixXd::Identity(n, n);
    if (i == 2) m = 1e150 * m;
    if (i == 3) m = 1e-150 * m.col(0) * -m.col(0).transpose();
    if (i == 4) m = Eigen::MatrixXd(m.diagonal().asDiagonal());
    if (i == 5)
      m.topRightCorner(n / 2, n - n / 2).setZero(), m.bottomLeftCorner(n - n / 2, n / 2).setZero();
    if (i == 6) m(0, 0) = std::numeric_limits<double>::quiet_NaN();
    if (i == 7) m = m * m;
    all.push_back(m);
  }
  return all;
}

TEST(TapeKernels, ClampAsEigenvaluesOneByOne) {
  test::Random random(5);
  for (const auto* kernels : detail::all_tape_kernels())
    for (int n = 1; n <= 30; ++n) {
      const auto matrices = matrices_of(n, random);
      const auto entries = to_size(n * (n + 1) / 2);
      std::vector<Lanes> packed(entries), memory(kernels->clamp_memory(to_size(n)));
      for (int i = 0; i < kLanes; ++i)
        for (int r = 0, k = 0; r < n; ++r)
          for (int c = 0; c <= r; ++c, ++k) packed[to_size(k)][i] = matrices[to_size(i)](r, c);
      const auto before = packed;
      const unsigned clamped = 0b01111110;
      EXPECT_EQ(kernels->clamp(n, 0.7, clamped, packed.data(), memory.data()), 0u) << n;
      for (int i = 0; i < kLanes; ++i) {
        std::vector<double> one(entries);
        for (std::size_t k = 0; k < entries; ++k) one[k] = before[k][i];
        const double size = std::abs(*std::max_element(
            one.begin(), one.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
        if (clamped >> i & 1) clamp_eigenvalues(n, 0.7, one.data());
        for (std::size_t k = 0; k < entries; ++k)
          EXPECT_LE(std::abs(packed[k][i] - one[k]), i == 6 ? 0.0 : 1e-14 * n * size)
              << kernels->name << " " << n << " " << i;
      }
    }
}

TEST(TapeKernels, IndefiniteAsOneByOne) {
  test::Random random(6);
  for (const auto* kernels : detail::all_tape_kernels())
    for (int n = 1; n <= 12; ++n) {
      auto matrices = matrices_of(n, random);
      matrices[0] = Eigen::MatrixXd::Zero(n, n);
      std::vector<Lanes> packed(to_size(n * (n + 1) / 2));
      unsigned expected = 0;
      for (int i = 0; i < kLanes; ++i) {
        std::vector<double> one;
        for (int r = 0; r < n; ++r)
          for (int c = 0; c <= r; ++c) one.push_back(matrices[to_size(i)](r, c));
        for (std::size_t k = 0; k < packed.size(); ++k) packed[k][i] = one[k];
        if (!is_semidefinite(n, one.data())) expected |= 1u << i;
      }
      EXPECT_EQ(kernels->indefinite(n, kZeroPivot, packed.data()), expected) << kernels->name;
    }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
