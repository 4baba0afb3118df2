// Compares the time of a term of a lambda with that of the same term differentiated by hand, and of
// the same lambda recorded for several elements at once; also times a density of tetrahedra. Each
// has an energy, a gradient and a linearization, assembly included (Google Benchmark). Only ratios
// of lines of one run are meaningful.
//
// Sample run:
//   build/release/bench/majorant_terms_bench
#include <benchmark/benchmark.h>

#include <array>
#include <random>

#include "majorant/elements/bernstein_space.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/detail/packed_symmetric.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/terms/local_term.h"

namespace majorant {
namespace {

constexpr Index kPoints = 20000;
constexpr double kEdge = 1.0 / kPoints;

Cells runs_of(Index nodes) {
  Cells cells(kPoints - nodes + 1, nodes);
  for (Index e = 0; e < cells.rows(); ++e)
    for (Index i = 0; i < nodes; ++i) cells(e, i) = e + i;
  return cells;
}

// Returns the term (|d| - L)^2 / L.
std::shared_ptr<const EnergyTerm> springs() {
  return make_term<2, 2>("springs", runs_of(2), [](Index, const auto& z) {
    const auto stretch = (z.col(1) - z.col(0)).norm() - kEdge;
    return stretch * stretch / kEdge;
  });
}

// Returns the term (turning angle)^2 / (2 L).
std::shared_ptr<const EnergyTerm> bending() {
  return make_term<3, 2>("bending", runs_of(3), [](Index, const auto& z) {
    using std::atan2;
    const auto a = (z.col(1) - z.col(0)).eval(), b = (z.col(2) - z.col(1)).eval();
    const auto angle = atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
    return angle * angle / (2 * kEdge);
  });
}

class ByHand : public EnergyTerm {
 public:
  explicit ByHand(Index nodes) : element_dofs_{runs_of(nodes), 2} {}
  std::string_view name() const override { return "by hand"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override {
    return c == Curvature::Exact || c == Curvature::Projected;
  }

 protected:
  Vector2 edge(VecIn x, Index e, Index i) const {
    const Index a = element_dofs_.nodes(e, i), b = element_dofs_.nodes(e, i + 1);
    return x.segment<2>(2 * b) - x.segment<2>(2 * a);
  }
  ElementDofs element_dofs_;
};

// The spring term with its projected Hessian in closed form.
class SpringsByHand final : public ByHand {
 public:
  SpringsByHand() : ByHand(2) {}
  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const double stretch = edge(x, batch.elements[p], 0).norm() - kEdge;
      f[p] = stretch * stretch / kEdge;
    }
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState&,
             Workspace&, LocalSystem& out) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Vector2 d = edge(x, batch.elements[p], 0);
      const double r = d.norm(), across = curvature.clamped(1 - kEdge / r);
      const Vector2 t = d / r;
      const Eigen::Matrix2d along = t * t.transpose(),
                            h = 2 / kEdge *
                                (along + across * (Eigen::Matrix2d::Identity() - along));
      out.value[p] = (r - kEdge) * (r - kEdge) / kEdge;
      for (int i = 0, k = 0; i < 4; ++i) {
        const double sign = i < 2 ? -1 : 1;
        out.gradient[to_size(i * LocalSystem::stride) + p] =
            sign * 2 * (r - kEdge) / kEdge * t[i % 2];
        for (int j = 0; out.hessian && j <= i; ++j, ++k)
          out.hessian[to_size(k * LocalSystem::stride) + p] =
              sign * (j < 2 ? -1 : 1) * h(i % 2, j % 2);
      }
    }
  }
};

// The bending term: the angle is the difference of the directions of two edges. Its projected
// Hessian has no closed form.
class BendingByHand final : public ByHand {
 public:
  BendingByHand() : ByHand(3) {}
  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const double turn = angle(edge(x, batch.elements[p], 0), edge(x, batch.elements[p], 1));
      f[p] = turn * turn / (2 * kEdge);
    }
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState&,
             Workspace&, LocalSystem& out) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Vector2 a = edge(x, batch.elements[p], 0), b = edge(x, batch.elements[p], 1);
      const double turn = angle(a, b);
      const Vector2 ga = direction_gradient(a), gb = direction_gradient(b);
      const Eigen::Matrix2d ha = direction_hessian(a), hb = direction_hessian(b);
      double g[6], h[21];
      for (int c = 0; c < 2; ++c) {
        g[c] = ga[c];
        g[2 + c] = -ga[c] - gb[c];
        g[4 + c] = gb[c];
      }
      for (int i = 0, k = 0; i < 6; ++i)
        for (int j = 0; j <= i; ++j, ++k) {
          const int m = i / 2, n = j / 2, r = i % 2, c = j % 2;
          const double from_a = m < 2 && n < 2 ? (m == n ? -1 : 1) * ha(r, c) : 0;
          const double from_b = m > 0 && n > 0 ? (m == n ? 1 : -1) * hb(r, c) : 0;
          h[k] = (g[i] * g[j] + turn * (from_a + from_b)) / kEdge;
        }
      if (curvature.projection_weight > 0) clamp_eigenvalues(6, curvature.projection_weight, h);
      out.value[p] = turn * turn / (2 * kEdge);
      for (int i = 0; i < 6; ++i)
        out.gradient[to_size(i * LocalSystem::stride) + p] = turn * g[i] / kEdge;
      for (int k = 0; out.hessian && k < 21; ++k)
        out.hessian[to_size(k * LocalSystem::stride) + p] = h[k];
    }
  }

 private:
  static double angle(const Vector2& a, const Vector2& b) {
    return std::atan2(cross(a, b), a.dot(b));
  }
  static Vector2 direction_gradient(const Vector2& d) {
    return Vector2(-d[1], d[0]) / d.squaredNorm();
  }
  static Eigen::Matrix2d direction_hessian(const Vector2& d) {
    const double r4 = d.squaredNorm() * d.squaredNorm(), s = d[1] * d[1] - d[0] * d[0];
    return Eigen::Matrix2d{{2 * d[0] * d[1], s}, {s, -2 * d[0] * d[1]}} / r4;
  }
};

enum class Quantity { Value, Gradient, Exact, Projected };
constexpr std::pair<Quantity, const char*> kQuantities[] = {{Quantity::Value, "/value"},
                                                            {Quantity::Gradient, "/gradient"},
                                                            {Quantity::Exact, "/exact"},
                                                            {Quantity::Projected, "/projected"}};

void evaluate(benchmark::State& state, const std::shared_ptr<const EnergyTerm>& term, const Vec& y,
              Quantity quantity) {
  const ThreadCount one(1);
  Evaluator evaluator(ProblemBuilder(static_cast<Index>(y.size())).add(term, 1).build());
  Vec g, h;
  const auto run = [&] {
    if (quantity == Quantity::Value) return evaluator.value(y);
    if (quantity == Quantity::Gradient) return evaluator.gradient(y, g);
    const bool exact = quantity == Quantity::Exact;
    return evaluator.linearize(y, exact ? Curvature::Exact : Curvature::Projected, g, h);
  };
  for (auto _ : state) benchmark::DoNotOptimize(run());
  state.counters["ns/element"] = benchmark::Counter(
      term->element_dofs().element_count(),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void bench(const std::string& name, const std::shared_ptr<const EnergyTerm>& term, const Vec& y) {
  for (const auto& [quantity, text] : kQuantities)
    benchmark::RegisterBenchmark((name + text).c_str(), evaluate, term, y, quantity)
        ->Unit(benchmark::kMillisecond);
}

// Returns a wavy line whose edges are `stretch` times as long as at rest.
Vec line(double stretch) {
  Vec y(2 * kPoints);
  Vector2 p(0, 0);
  for (Index i = 0; i < kPoints; ++i) {
    y.segment<2>(2 * i) = p;
    const double angle = std::sin(0.3 * i) + 0.2 * std::cos(1.1 * i);
    p += stretch * kEdge * Vector2(std::cos(angle), std::sin(angle));
  }
  return y;
}

// A box of 9,984 straight tetrahedra with slightly moved vertices.
struct Tetrahedra {
  static constexpr Index kLength = 26, kWidth = 8;
  RowMatrix corners{(kLength + 1) * (kWidth + 1) * (kWidth + 1), 3};
  Cells cells{6 * kLength * kWidth * kWidth, 4};
  Vec moved;

  Tetrahedra() {
    const auto vertex = [](const std::array<Index, 3>& at) {
      return (at[0] * (kWidth + 1) + at[1]) * (kWidth + 1) + at[2];
    };
    std::array<Index, 3> at;
    for (at[0] = 0; at[0] <= kLength; ++at[0])
      for (at[1] = 0; at[1] <= kWidth; ++at[1])
        for (at[2] = 0; at[2] <= kWidth; ++at[2]) corners.row(vertex(at)) << at[0], at[1], at[2];
    constexpr std::size_t kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                           {1, 0, 2}, {2, 1, 0}, {0, 2, 1}};
    Index e = 0;
    for (Index i = 0; i < kLength; ++i)
      for (Index j = 0; j < kWidth; ++j)
        for (Index k = 0; k < kWidth; ++k)
          for (int t = 0; t < 6; ++t, ++e) {
            at = {i, j, k};
            cells(e, 0) = vertex(at);
            for (int corner = 1; corner < 4; ++corner) {
              ++at[kOrders[t][corner - 1]];
              cells(e, corner) = vertex(at);
            }
            if (t >= 3)
              std::swap(cells(e, 1), cells(e, 2));  // odd permutations have negative orientation
          }
    std::mt19937 random(1);
    std::uniform_real_distribution<double> move(-0.05, 0.05);
    moved = Eigen::Map<const Vec>(corners.data(), corners.size());
    for (double& x : moved) x += move(random);
  }
};

// Energies of an element with data. Each term has its own type, since inlining depends on the
// number of terms that call a function.
template <int>
struct SymmetricDirichlet {
  auto operator()(const auto& z, const auto& rest) const {  // inverted rest shape, area
    using Eigen::fix;
    const auto edges = (z.template rightCols<2>().colwise() - z.col(0)).eval();
    const auto J = (edges * rest.template head<4>().reshaped(fix<2>, fix<2>)).eval();
    const auto det = J.determinant();
    return rest[4] * (J.squaredNorm() * (1.0 + 1.0 / (det * det)));
  }
};
template <int>
struct NeoHooke {
  auto operator()(const auto& z, const auto& rest) const {  // inverted rest shape, volume
    using Eigen::fix, std::log;
    const auto edges = (z.template rightCols<3>().colwise() - z.col(0)).eval();
    const auto F = (edges * rest.template head<9>().reshaped(fix<3>, fix<3>)).eval();
    const auto log_J = log(F.determinant());
    return rest[9] * (0.5 * (F.squaredNorm() - 3.0) - log_J + log_J * log_J);
  }
};
template <int>
struct Bar {
  auto operator()(const auto& z, const auto& length) const {
    const auto stretch = (z.col(1) - z.col(0)).norm() - length[0];
    return stretch * stretch;
  }
};

// Measures 20,000 elements that share no nodes: a corner at 0, the others at 1 on each axis, all
// slightly moved. "lambda" is called for one element, "lanes" for several at a time.
template <int N, int Block, template <int> class F>
void bench_data(const std::string& name, const Vec& row) {
  Cells cells(kPoints, N);
  for (Index k = 0; k < cells.size(); ++k) cells.data()[k] = static_cast<int>(k);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> move(0, 0.3);
  Vec y(Block * cells.size());
  for (Index k = 0; k < y.size(); ++k) y[k] = (k / Block % N == k % Block + 1) + move(random);
  const RowMatrix data = row.transpose().replicate(kPoints, 1);
  const auto by_element = [](Index, const auto& z, const auto& d) { return F<0>()(z, d); };
  bench(name + "/lambda", make_term<N, Block>(name, cells, by_element, data), y);
  bench(name + "/lanes", make_term<N, Block>(name, cells, F<1>(), data), y);
}

// Measures |J|^2 + |J^-1|^2 with one quadrature point, the default, and with 14.
void bench_tetrahedra() {
  const Tetrahedra mesh;
  const auto space = std::make_shared<const BezierTetrahedronSpace>(
      mesh.cells, static_cast<Index>(mesh.corners.rows()), 1);
  const RestShapes rest = flat_simplices(mesh.corners, mesh.cells);
  const auto energy = density<3, 3>("symmetric-dirichlet-3d", [](const auto& J) {
    return J.squaredNorm() + J.inverse().squaredNorm();
  });
  bench("tetrahedra", make_energy(space, rest, energy), mesh.moved);
  bench("tetrahedra/14 points", make_energy(space, rest, energy, {walkington_rule()}), mesh.moved);
}

}  // namespace
}  // namespace majorant

int main(int argc, char** argv) {
  using namespace majorant;
  const auto springs_by_hand = std::make_shared<const SpringsByHand>();
  bench("springs/stretched/lambda", springs(), line(1.2));
  bench("springs/stretched/hand", springs_by_hand, line(1.2));
  bench("springs/compressed/lambda", springs(), line(0.8));
  bench("springs/compressed/hand", springs_by_hand, line(0.8));
  bench("bending/lambda", bending(), line(1));
  bench("bending/hand", std::make_shared<const BendingByHand>(), line(1));
  bench_data<3, 2, SymmetricDirichlet>("symmetric-dirichlet", Vec{{1, 0.1, 0.2, 1, 0.5}});
  bench_data<4, 3, NeoHooke>("neo-hooke", Vec{{1, 0.1, 0.2, 0, 1, 0, 0, 0, 1, 0.17}});
  bench_data<2, 3, Bar>("bar", Vec{{0.9}});
  bench_tetrahedra();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
