// Compares derivatives of solutions of eight kinds of problems, three sizes each, with extrapolated
// central differences of whole solves (Richardson), along random directions in all data at once;
// and forward with adjoint derivatives by their products.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <functional>
#include <string>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/rest_sensitivity.h"
#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/hessian_factor.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/sensitivity.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"
#include "majorant/framework/terms/parameter_blocks.h"
#include "random.h"

namespace majorant {
namespace eight_sensitivities {

// The data of a problem: right-hand sides of its rows, weights and parameters of its terms (empty:
// none), rest positions (no rows: none).
struct Data {
  Vec right_hand_sides, weights;
  std::vector<Vec> parameters;
  RowMatrix positions;

  Data moved(double t, const Data& by) const {
    Data out = *this;
    out.right_hand_sides += t * by.right_hand_sides;
    out.weights += t * by.weights;
    for (std::size_t k = 0; k < parameters.size(); ++k) out.parameters[k] += t * by.parameters[k];
    out.positions += t * by.positions;
    return out;
  }
};

struct Kind {
  std::string name;
  Data data;
  std::function<Problem(const Data&)> make;
  Vec start = {};    // full unknowns
  Cells cells = {};  // of the rest positions
  std::vector<TermId> densities = {};
  bool is_free = false;  // free up to motions of the plane
  std::vector<TermId> barriers = {};
};
using Sized = std::function<Kind(Index n)>;

Eigen::MatrixXd motions_of_the_plane(VecIn x) {
  Eigen::MatrixXd v = Eigen::MatrixXd::Zero(x.size(), 3);
  for (Index k = 0; k < x.size(); k += 2) {
    v(k, 0) = v(k + 1, 1) = 1;
    v(k, 2) = -x[k + 1];
    v(k + 1, 2) = x[k];
  }
  return v;
}

// Returns the solution after exact Newton steps to the last digits; steps of free maps have least
// norm.
Vec polished(const Problem& problem, Vec y, bool is_free) {
  for (int k = 0; k < 12; ++k) {
    Vec step;
    if (is_free) {
      Vec gradient, values;
      Evaluator evaluator(problem);
      evaluator.linearize(y, Curvature::Exact, gradient, values);
      Eigen::MatrixXd h = evaluator.hessian(y);
      const Eigen::MatrixXd v = motions_of_the_plane(y);
      h += v * v.transpose();
      step = h.ldlt().solve(gradient);
    } else {
      const HessianFactor factor(problem, y);
      step = factor.solve(factor.gradient());
    }
    y -= step;
    if (step.norm() <= 1e-14 * y.norm()) break;
  }
  return y;
}

BarrierResult solved(const Kind& kind, const Problem& problem) {
  const Vec y0 = problem.reduce(kind.start);
  if (!kind.barriers.empty()) {
    BarrierOptions options;
    options.tolerance = 1e-4;
    BarrierResult r = BarrierMinimizer(kind.barriers, options).run(problem, y0, nullptr);
    r.blocking.clear();
    return r;
  }
  BarrierResult r;
  static_cast<SolveResult&>(r) = NewtonMinimizer().minimize(problem, y0, nullptr);
  return r;
}

// Returns the problem with the final weights of barriers.
Problem with_barriers(const Kind& kind, const Problem& problem, double mu) {
  TermChanges changes;
  for (const TermId id : kind.barriers) changes.emplace_back(id, TermChange{.weight = mu});
  return problem.with(std::move(changes));
}

// Returns dx* along `by` from six solves: central differences at h, h/2 and h/4, extrapolated
// twice.
Vec extrapolated(const Kind& kind, const Vec& near, const Data& by, double mu) {
  const double h = 4e-3;
  const auto x = [&](double t) {
    const Problem problem = with_barriers(kind, kind.make(kind.data.moved(t, by)), mu);
    Vec y = problem.reduce(near);
    if (!kind.is_free) {  // unconstrained motions would drift
      const SolveResult r = NewtonMinimizer().minimize(problem, y, nullptr);
      EXPECT_EQ(r.status, Status::Converged) << r.message;
      y = r.y;
    }
    return problem.expand(polished(problem, y, kind.is_free));
  };
  const auto difference = [&](double step) { return Vec((x(step) - x(-step)) / (2 * step)); };
  const Vec d1 = difference(h), d2 = difference(h / 2), d3 = difference(h / 4);
  const Vec e1 = (4 * d2 - d1) / 3, e2 = (4 * d3 - d2) / 3;
  return (16 * e2 - e1) / 15;
}

Data direction(const Data& at, unsigned seed) {
  test::Random random(seed);
  Data d = at;
  d.right_hand_sides = random.vector(at.right_hand_sides.size());
  d.weights = at.weights.cwiseProduct(random.vector(at.weights.size()));
  for (std::size_t k = 0; k < at.parameters.size(); ++k)
    d.parameters[k] = at.parameters[k].cwiseAbs().cwiseProduct(
        random.vector(static_cast<Index>(at.parameters[k].size())));
  for (Index k = 0; k < at.positions.size(); ++k) d.positions.data()[k] = 0.3 * random.uniform();
  return d;
}

void expect_derivatives(const Kind& kind, unsigned seed) {
  SCOPED_TRACE(kind.name);
  const Problem first = kind.make(kind.data);
  const BarrierResult r = solved(kind, first);
  ASSERT_EQ(r.status, Status::Converged) << r.message;
  const double mu = r.phases.empty() ? 0 : r.phases.back().mu;
  const Problem problem = with_barriers(kind, first, mu);
  SensitivityOptions options;
  if (kind.is_free)
    options.null_space = [](const Problem&, VecIn y) { return motions_of_the_plane(y); };
  const Sensitivity s(problem, r, options);
  EXPECT_LT(s.error(), 1e-8);
  const Data by = direction(kind.data, seed);
  Sensitivity::Change change;
  change.right_hand_sides = by.right_hand_sides;
  const auto ids = problem.terms();
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (static_cast<Index>(k) < by.weights.size())
      change.weights.emplace_back(ids[k], by.weights[static_cast<Index>(k)]);
    if (k < by.parameters.size() && by.parameters[k].size() > 0)
      change.parameters.emplace_back(ids[k], by.parameters[k]);
  }
  std::optional<RestSensitivity> rest;
  if (by.positions.rows() > 0) {
    rest.emplace(problem, s, kind.densities, kind.data.positions, kind.cells);
    change.gradient = rest->gradient(by.positions);
  }
  const Vec dx = s.forward(change);
  Vec expected = extrapolated(kind, s.point(), by, mu);
  if (kind.is_free) {  // of least norm: without the component along motions
    const Eigen::MatrixXd v = motions_of_the_plane(s.point());
    expected -= v * (v.transpose() * v).ldlt().solve(v.transpose() * expected);
  }
  EXPECT_GT(expected.norm(), 1e-3);
  EXPECT_LE((dx - expected).norm(), 1e-7 * expected.norm());

  const Vec slope = test::Random(seed + 100).vector(dx.size());
  const Sensitivity::Derivative back = s.adjoint(slope);
  double product = 0;
  if (by.right_hand_sides.size() > 0) product += back.right_hand_sides.dot(by.right_hand_sides);
  for (Index k = 0; k < by.weights.size(); ++k) product += back.weights[to_size(k)] * by.weights[k];
  for (std::size_t k = 0; k < by.parameters.size(); ++k)
    if (by.parameters[k].size() > 0) product += back.parameters[k].dot(by.parameters[k]);
  if (rest) product += rest->adjoint(back).cwiseProduct(by.positions).sum();
  EXPECT_NEAR(product, slope.dot(dx), 1e-8 * slope.norm() * dx.norm());
}

// Returns a bumpy sheet of n by n vertices.
RowMatrix bumpy(Index n) {
  RowMatrix p(n * n, 3);
  for (Index k = 0; k < n * n; ++k) {
    const double x = static_cast<double>(k % n) / (n - 1), y = static_cast<double>(k / n) / (n - 1);
    p.row(k) << 2 * x, 2 * y, 0.4 * std::sin(3 * x + 1) * std::cos(2 * y);
  }
  return p;
}
Cells triangles(Index n) {
  Cells f(2 * (n - 1) * (n - 1), 3);
  Index t = 0;
  for (Index j = 0; j + 1 < n; ++j)
    for (Index i = 0; i + 1 < n; ++i) {
      const Index a = i + n * j;
      f.row(t++) << a, a + 1, a + n + 1;
      f.row(t++) << a, a + n + 1, a + n;
    }
  return f;
}
Vec flat(const RowMatrix& positions) {
  Vec x(2 * positions.rows());
  for (Index k = 0; k < positions.rows(); ++k)
    x.segment<2>(2 * k) << positions(k, 0), positions(k, 1);
  return x;
}

Kind flattening(Index n, bool is_free) {
  Kind kind;
  kind.name = is_free ? "free flattening" : "flattening with pins";
  kind.cells = triangles(n);
  kind.data.positions = bumpy(n);
  kind.data.weights = Vec{{1, 0.3}};
  kind.start = flat(kind.data.positions);
  kind.densities = {TermId(0), TermId(1)};
  kind.is_free = is_free;
  if (!is_free) kind.data.right_hand_sides = Vec{{0, 0, 2.2, 0.1, 0.2, 2.1}};
  const auto space = std::make_shared<const BezierTriangleSpace>(kind.cells, n * n, 1);
  kind.make = [space, n, is_free, cells = kind.cells](const Data& data) {
    const RestShapes rest = flat_simplices(data.positions, cells);
    ProblemBuilder builder(2 * n * n);
    builder.add(symmetric_dirichlet()(space, rest), data.weights[0]);
    builder.add(find_energy("arap")->make(space, rest), data.weights[1]);
    const Vec& b = data.right_hand_sides;
    if (!is_free)
      builder.add(FixedPoints(
          {{0, b.segment<2>(0)}, {n - 1, b.segment<2>(2)}, {n * n - n, b.segment<2>(4)}}));
    return builder.build();
  };
  return kind;
}

Kind tetrahedra(Index n) {
  Kind kind;
  kind.name = "tetrahedra";
  const Index nodes = 4 * (n + 1);
  RowMatrix p(nodes, 3);
  for (Index k = 0; k < nodes; ++k) p.row(k) << 0.7 * (k / 4), k % 2, k / 2 % 2;
  kind.cells.resize(6 * n, 4);
  for (Index i = 0; i < n; ++i) {
    const Index path[6][2] = {{1, 2}, {2, 4}, {4, 1}, {2, 1}, {4, 2}, {1, 4}};  // axes, as bits
    for (int t = 0; t < 6; ++t) {
      const auto corner = [&](Index bits) {  // x, y, z of a cube are bits 4, 1, 2
        return 4 * (i + bits / 4) + bits % 4;
      };
      const Index a = path[t][0], b = path[t][1];
      kind.cells.row(6 * i + t) << corner(0), corner(a), corner(a + b), corner(7);
      Eigen::Matrix3d edges;
      for (int c = 0; c < 3; ++c)
        edges.col(c) =
            (p.row(kind.cells(6 * i + t, c + 1)) - p.row(kind.cells(6 * i + t, 0))).transpose();
      if (edges.determinant() < 0) std::swap(kind.cells(6 * i + t, 1), kind.cells(6 * i + t, 2));
    }
  }
  kind.data.positions = p;
  kind.data.weights = Vec{{1.3}};
  kind.data.parameters = {Vec::LinSpaced(6 * n, 1, 2)};
  kind.data.right_hand_sides.resize(24);
  kind.start.resize(3 * nodes);
  for (Index k = 0; k < nodes; ++k)
    kind.start.segment<3>(3 * k) << 1.15 * p(k, 0), p(k, 1) + 0.1 * p(k, 0), p(k, 2);
  kind.data.right_hand_sides << kind.start.head(12), kind.start.tail(12);
  kind.densities = {TermId(0)};
  const auto space = std::make_shared<const BezierTetrahedronSpace>(kind.cells, nodes, 1);
  kind.make = [space, nodes, cells = kind.cells](const Data& data) {
    const auto rubber = density<3, 3>(
        "rubber",
        [](const auto& J, double k) {
          using std::log;
          const auto l = log(J.determinant());
          return k * (0.5 * J.squaredNorm() - l + l * l);
        },
        data.parameters[0]);
    ProblemBuilder builder(3 * nodes);
    builder.add(make_energy(space, flat_simplices(data.positions, cells), rubber), data.weights[0]);
    std::vector<FixedUnknown> held;
    for (Index k = 0; k < 12; ++k) held.push_back({k, data.right_hand_sides[k]});
    for (Index k = 0; k < 12; ++k)
      held.push_back({3 * nodes - 12 + k, data.right_hand_sides[12 + k]});
    builder.add(FixedUnknowns(held));
    return builder.build();
  };
  return kind;
}

Cells grid_edges(Index n) {
  Cells edges(2 * n * (n - 1), 2);
  Index e = 0;
  for (Index k = 0; k < n * n; ++k) {
    if (k % n + 1 < n) edges.row(e++) << k, k + 1;
    if (k / n + 1 < n) edges.row(e++) << k, k + n;
  }
  return edges;
}

// Returns a sheet of springs, perhaps with bending, held at two corners under gravity. data: a row
// of length and stiffness for each spring, or all lengths as one list.
Kind sheet(Index n, bool bends) {
  Kind kind;
  kind.name = bends ? "cloth" : "data of lambdas";
  const Cells edges = grid_edges(n);
  kind.start.resize(3 * n * n);
  for (Index k = 0; k < n * n; ++k)
    kind.start.segment<3>(3 * k) << k % n, k / n,
        -0.2 * std::sin(3.0 * (k % n) / (n - 1)) * (k / n + 1) / n;
  kind.data.weights = Vec{{2, 1}};
  if (bends) {
    Vec rows(2 * edges.rows());
    for (Index e = 0; e < edges.rows(); ++e) rows.segment<2>(2 * e) << 1.05, 1 + 0.1 * (e % 3);
    kind.data.parameters = {rows, Vec::Constant(1, 0.5)};
  } else {
    kind.data.parameters = {Vec::Constant(edges.rows(), 1.05), Vec::Constant(1, 0.5)};
  }
  const Index corners[] = {0, n - 1, n * (n - 1), n * n - 1};
  kind.data.right_hand_sides.resize(12);
  for (Index c = 0; c < 4; ++c)
    kind.data.right_hand_sides.segment<3>(3 * c) = kind.start.segment<3>(3 * corners[c]);
  kind.make = [=](const Data& data) {
    const auto spring = [](const auto& z, double length) {
      const auto stretch = (z.col(1) - z.col(0)).squaredNorm() / (length * length) - 1.0;
      return stretch * stretch;
    };
    Cells bent(2 * n * (n - 2), 3);
    Index e = 0;
    for (Index k = 0; k < n * n; ++k) {
      if (k % n + 2 < n) bent.row(e++) << k, k + 1, k + 2;
      if (k / n + 2 < n) bent.row(e++) << k, k + n, k + 2 * n;
    }
    ProblemBuilder builder(3 * n * n);
    if (bends)
      builder.add(
          make_term<2, 3>(
              "springs", edges,
              [=](Index, const auto& z, const auto& d) { return d[1] * spring(z, d[0]); },
              RowMatrix(Eigen::Map<const RowMatrix>(data.parameters[0].data(), edges.rows(), 2))),
          data.weights[0]);
    else
      builder.add(make_term<2, 3>(
                      "springs", edges,
                      [=](Index i, const auto& z, const auto& l) { return spring(z, l[i]); },
                      data.parameters[0]),
                  data.weights[0]);
    builder.add(make_term<3, 3>(
                    "bending", bent,
                    [](Index, const auto& z, const auto& k) {
                      return k[0] * (z.col(0) - 2.0 * z.col(1) + z.col(2)).squaredNorm();
                    },
                    data.parameters[1]),
                data.weights[1]);
    Vec load = Vec::Zero(3 * n * n);
    for (Index k = 0; k < n * n; ++k) load[3 * k + 2] = 0.1;
    builder.add(linear_term("load", load), 1);
    std::vector<FixedUnknown> held;
    for (Index c = 0; c < 4; ++c)
      for (Index k = 0; k < 3; ++k)
        held.push_back({3 * corners[c] + k, data.right_hand_sides[3 * c + k]});
    builder.add(FixedUnknowns(held));
    return builder.build();
  };
  return kind;
}

// Returns cameras that observe points. Observations are data; the first camera and one coordinate
// of the second fix the frame and the scale.
Kind bundle_adjustment(Index n) {
  Kind kind;
  kind.name = "bundle adjustment";
  const Index cameras = 3, points = 4 * n;
  test::Random random(5);
  Vec x(6 * cameras + 3 * points);
  for (Index c = 0; c < cameras; ++c)
    x.segment<6>(6 * c) << 0.1, 0.4 * (c - 0.8), 0.05 * (c + 1), 0.1 * c, -0.1 * c, 5;
  for (Index k = 6 * cameras; k < x.size(); ++k) x[k] = random.uniform();
  const auto image = [](const auto& z) {
    using T = std::decay_t<decltype(z[0] + 0.0)>;
    using std::cos, std::sin, std::sqrt;
    const Eigen::Matrix<T, 3, 1> w(z[0], z[1], z[2]), p(z[6], z[7], z[8]);
    const T angle2 = w.squaredNorm(), angle = sqrt(angle2);
    const T c = cos(angle), s = sin(angle) / angle, k = (1.0 - c) / angle2;
    const Eigen::Matrix<T, 3, 1> q =
        p * c + w.cross(p) * s + w * (w.dot(p) * k) + Eigen::Matrix<T, 3, 1>(z[3], z[4], z[5]);
    return Eigen::Matrix<T, 2, 1>(q[0] / q[2], q[1] / q[2]);
  };
  Cells blocks(cameras * points, 9);
  Vec seen(2 * blocks.rows());
  for (Index e = 0; e < blocks.rows(); ++e) {
    for (Index k = 0; k < 6; ++k) blocks(e, k) = 6 * (e % cameras) + k;
    for (Index k = 0; k < 3; ++k) blocks(e, 6 + k) = 6 * cameras + 3 * (e / cameras) + k;
    Vec z(9);
    for (Index k = 0; k < 9; ++k) z[k] = x[blocks(e, k)];
    seen.segment<2>(2 * e) = image(z) + 0.01 * Vector2(random.uniform(), random.uniform());
  }
  kind.start = x;
  kind.data.parameters = {seen};
  kind.data.weights = Vec{{1.5}};
  kind.data.right_hand_sides = x.head(10);
  kind.make = [=](const Data& data) {
    ProblemBuilder builder(x.size());
    builder.add(
        make_least_squares<9>(
            "images", blocks,
            [=](Index, const auto& z, const auto& d) {
              auto r = image(z);
              r[0] -= d[0];
              r[1] -= d[1];
              return r;
            },
            RowMatrix(Eigen::Map<const RowMatrix>(data.parameters[0].data(), blocks.rows(), 2))),
        data.weights[0]);
    std::vector<FixedUnknown> held;
    for (Index k = 0; k < 10; ++k) held.push_back({k, data.right_hand_sides[k]});
    builder.add(FixedUnknowns(held));
    return builder.build();
  };
  return kind;
}

// Returns a planar rod that is pushed together, with one bending stiffness as parameter.
Kind elastica(Index n) {
  Kind kind;
  kind.name = "elastica";
  const Index nodes = 6 * n;
  kind.start.resize(2 * nodes);
  for (Index k = 0; k < nodes; ++k) {
    const double t = static_cast<double>(k) / (nodes - 1);
    kind.start.segment<2>(2 * k) << 0.9 * (nodes - 1) * t,
        0.2 * nodes * std::pow(std::sin(EIGEN_PI * t), 2);
  }
  kind.data.right_hand_sides.resize(8);
  kind.data.right_hand_sides << 0, 0, 1, 0, 0.85 * (nodes - 1) - 1, 0.3, 0.85 * (nodes - 1), 0.3;
  kind.start.head(4) = kind.data.right_hand_sides.head(4);
  kind.start.tail(4) = kind.data.right_hand_sides.tail(4);
  kind.data.weights = Vec{{40, 3}};
  kind.data.parameters = {Vec::Ones(1), Vec::Ones(1)};
  kind.make = [nodes](const Data& data) {
    Cells pairs(nodes - 1, 2), triples(nodes - 2, 3);
    for (Index e = 0; e + 1 < nodes; ++e) pairs.row(e) << e, e + 1;
    for (Index e = 0; e + 2 < nodes; ++e) triples.row(e) << e, e + 1, e + 2;
    ProblemBuilder builder(2 * nodes);
    builder.add(make_term<2, 2>(
                    "stretch", pairs,
                    [](Index, const auto& z, const auto& length) {
                      const auto s = (z.col(1) - z.col(0)).squaredNorm() - length[0] * length[0];
                      return s * s;
                    },
                    data.parameters[0]),
                data.weights[0]);
    builder.add(make_term<3, 2>(
                    "bending", triples,
                    [](Index, const auto& z, const auto& k) {
                      return k[0] * (z.col(0) - 2.0 * z.col(1) + z.col(2)).squaredNorm();
                    },
                    data.parameters[1]),
                data.weights[1]);
    const Vec& b = data.right_hand_sides;
    builder.add(FixedPoints({{0, b.segment<2>(0)},
                             {1, b.segment<2>(2)},
                             {nodes - 2, b.segment<2>(4)},
                             {nodes - 1, b.segment<2>(6)}}));
    return builder.build();
  };
  return kind;
}

// Returns a chain over a floor, with the barrier of the last phase.
Kind bounded(Index n) {
  Kind kind;
  kind.name = "bounds";
  const Index size = 8 * n;
  kind.start = Vec::Constant(size, 0.5);
  kind.start.head(1) << 1;
  kind.start.tail(1) << 1;
  kind.data.right_hand_sides = Vec{{1, 1}};
  kind.data.weights = Vec{{1, 1}};
  kind.data.parameters = {Vec::Ones(1), Vec::LinSpaced(size, 0.02, 0.04)};
  kind.barriers = {TermId(2)};
  kind.make = [size](const Data& data) {
    Cells pairs(size - 1, 2), single(size, 1);
    for (Index e = 0; e < size; ++e) single(e, 0) = e;
    for (Index e = 0; e + 1 < size; ++e) pairs.row(e) << e, e + 1;
    ProblemBuilder builder(size);
    builder.add(make_term<2>(
                    "chain", pairs,
                    [](Index, const auto& z, const auto& k) {
                      const auto d = z[1] - z[0];
                      return k[0] * d * d + 0.1 * d * d * d * d;
                    },
                    data.parameters[0]),
                data.weights[0]);
    const RowMatrix loads = data.parameters[1];
    builder.add(
        make_term<1>(
            "load", single, [](Index, const auto& z, const auto& f) { return f[0] * z[0]; }, loads),
        data.weights[1]);
    const double none = std::numeric_limits<double>::infinity();
    const Bounds floor(Vec::Zero(size), Vec::Constant(size, none));
    builder.add(floor.barrier(), 1);
    builder.add(floor.checker());
    builder.add(
        FixedUnknowns({{0, data.right_hand_sides[0]}, {size - 1, data.right_hand_sides[1]}}));
    return builder.build();
  };
  return kind;
}

class EightSensitivities : public testing::TestWithParam<std::pair<const char*, Sized>> {};

TEST_P(EightSensitivities, AgreeWithDifferencesOfSolves) {
  unsigned seed = 1;
  for (const Index n : {3, 4, 6}) expect_derivatives(GetParam().second(n), seed++);
}

INSTANTIATE_TEST_SUITE_P(
    OfProblems, EightSensitivities,
    testing::Values(std::pair{"pins", Sized([](Index n) { return flattening(n, false); })},
                    std::pair{"free", Sized([](Index n) { return flattening(n, true); })},
                    std::pair{"cloth", Sized([](Index n) { return sheet(n, true); })},
                    std::pair{"tetrahedra", Sized(tetrahedra)},
                    std::pair{"bundle_adjustment", Sized(bundle_adjustment)},
                    std::pair{"elastica", Sized(elastica)}, std::pair{"bounds", Sized(bounded)},
                    std::pair{"lambda_data", Sized([](Index n) { return sheet(n + 4, false); })}),
    [](const auto& problem) { return std::string(problem.param.first); });

}  // namespace eight_sensitivities
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
