#include "majorant/energies/rest_sensitivity.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

// The largest relative difference between the measures of rest shapes and those of the positions.
constexpr double kSameMeasure = 1e-9;

// Return the corner at which tangents begin, and those at which they end, as in flat_simplices().
Index first_corner(Index dim) { return dim == 2 ? 2 : 0; }
Index end_of_tangent(Index dim, Index tangent) { return dim == 2 ? tangent : tangent + 1; }

using Small = RestSensitivity::Small;

// The decomposition T = Q R of the tangents T of an element. Q is the identity if there are as many
// tangents as coordinates; then, and only then, rest shapes may rotate with their frame.
struct Frame {
  Small q, r, inverse;  // of r
  bool turns;           // the frame rotates with the element

  explicit Frame(const Small& tangents)
      : q(tangents), r(tangents), turns(tangents.rows() != tangents.cols()) {
    const Eigen::Index dim = tangents.cols();
    if (turns) {
      r = Small::Zero(dim, dim);
      for (Eigen::Index k = 0; k < dim; ++k) {
        for (Eigen::Index j = 0; j < k; ++j) {
          r(j, k) = q.col(j).dot(q.col(k));
          q.col(k) -= r(j, k) * q.col(j);
        }
        r(k, k) = q.col(k).norm();
        q.col(k) /= r(k, k);
      }
    }
    inverse = r.inverse();
  }

  // Returns the change of the reference coordinates of the corners, R^-1 dR, for a change of T.
  Small coordinates(const Small& change) const {
    if (!turns) return inverse * change;
    // dR = K R with K upper triangular: Q^T dT R^-1 without its skew part, which rotates the frame.
    Small k = q.transpose() * change * inverse;
    for (Eigen::Index i = 0; i < k.rows(); ++i)
      for (Eigen::Index j = 0; j < i; ++j) {
        k(j, i) += k(i, j);
        k(i, j) = 0;
      }
    return inverse * k * r;
  }
};

}  // namespace

RestSensitivity::RestSensitivity(const Problem& problem, const Sensitivity& sensitivity,
                                 std::vector<TermId> terms, RowMatrix positions, Cells cells)
    : sensitivity_(sensitivity),
      positions_(std::move(positions)),
      cells_(std::move(cells)),
      dim_(static_cast<Index>(cells_.cols()) - 1) {
  require_size("RestSensitivity: the sensitivity's point", sensitivity.point().size(),
               problem.full_size());
  if (positions_.cols() > 3)
    throw InvalidArgument(
        fmt::format("RestSensitivity: positions of {} coordinates", positions_.cols()));
  const RestShapes flat = flat_simplices(positions_, cells_);
  for (const TermId id : terms) {
    const auto* density = dynamic_cast<const DensityTerm*>(&problem.term(id));
    if (!density)
      throw InvalidArgument(
          fmt::format("RestSensitivity: term '{}' is no density, it has no rest shapes",
                      problem.term(id).name()));
    const RestShapes& rest = density->rest();
    const ElementDofs& dofs = density->element_dofs();
    if (rest.curved() || dofs.nodes.cols() != rest.dim + 1)
      throw Error(ErrorKind::Unsupported,
                  fmt::format("RestSensitivity: term '{}' has {} nodes an element of dimension {}; "
                              "rest positions are data of simplices of degree 1",
                              density->name(), dofs.nodes.cols(), rest.dim));
    if (rest.dim != dim_ || dofs.element_count() != cells_.rows())
      throw InvalidArgument(fmt::format(
          "RestSensitivity: {} cells of {} corners for {} elements of dimension {} of "
          "term '{}'",
          cells_.rows(), cells_.cols(), dofs.element_count(), rest.dim, density->name()));
    for (Index e = 0; e < flat.measure.size(); ++e)
      if (!(std::abs(flat.measure[e] - rest.measure[e]) <= kSameMeasure * rest.measure[e]))
        throw InvalidArgument(fmt::format(
            "RestSensitivity: element {} of term '{}' has measure {:g} at rest, not the "
            "{:g} of these positions",
            e, density->name(), rest.measure[e], flat.measure[e]));
    terms_.push_back(differentiated(problem, id));
  }
}

RestSensitivity::Small RestSensitivity::tangents(Index element, const RowMatrix& points) const {
  Small out(points.cols(), dim_);
  for (Index k = 0; k < dim_; ++k)
    out.col(k) = (points.row(cells_(element, end_of_tangent(dim_, k))) -
                  points.row(cells_(element, first_corner(dim_))))
                     .transpose();
  return out;
}

// A map x of an element has the energy m W(J), J = X M. Moving corner b of the rest shape by N_ab
// along tangent a changes M by -N M and m by m tr N, and thus the gradient g by
//     tr N g - H (X N) - (g N^T as forces at the corners).
RestSensitivity::Term RestSensitivity::differentiated(const Problem& problem, TermId id) const {
  const EnergyTerm& term = problem.term(id);
  const TermState& state = problem.state(id);
  const Vec& x = sensitivity_.point();
  Term out{id, Vec::Constant(cells_.rows(), state.weight), {}, term.element_dofs()};
  if (state.element_weight.size() > 0) out.weights.array() *= state.element_weight.array();
  const ElementDofs& dofs = out.dofs;
  const Index n = dofs.local_size(), block = dofs.block, first = first_corner(dim_);
  const auto coordinates = static_cast<Index>(positions_.cols());
  out.by_tangents.resize(cells_.rows(), n * dim_ * coordinates);
  const ColoredBatches& plan = ProblemParts::plan(problem, id);
  constexpr std::size_t stride = LocalSystem::stride;
  const int threads = ThreadCount::current();
  std::vector<Workspace> kernels(to_size(threads)), memories(to_size(threads));
  const auto visit = [&](Index c, int thread) {
    const ElementBatch batch = plan.batch(c);
    LocalSystem local;
    local.value = memories[to_size(thread)].reserve(to_size(1 + n + n * (n + 1) / 2) * stride);
    local.gradient = local.value + stride;
    local.hessian = local.gradient + to_size(n) * stride;
    term.local(x, batch, Curvature::Exact, state, kernels[to_size(thread)], local);
    Eigen::MatrixXd by_coordinates;
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      const auto g = [&](Index k) { return local.gradient[to_size(k) * stride + p]; };
      const auto h = [&](Index i, Index j) {
        const Index low = std::max(i, j), high = std::min(i, j);
        return local.hessian[to_size(low * (low + 1) / 2 + high) * stride + p];
      };
      by_coordinates.resize(n, dim_ * dim_);
      for (Index a = 0; a < dim_; ++a)
        for (Index b = 0; b < dim_; ++b) {
          auto slope = by_coordinates.col(dim_ * a + b);
          const Index to = block * end_of_tangent(dim_, a), at = block * end_of_tangent(dim_, b);
          for (Index i = 0; i < n; ++i) {
            slope[i] = a == b ? g(i) : 0;
            for (Index k = 0; k < block; ++k) {
              const double tangent = x[block * dofs.nodes(e, end_of_tangent(dim_, a)) + k] -
                                     x[block * dofs.nodes(e, first) + k];
              slope[i] -= h(i, at + k) * tangent;
            }
          }
          for (Index k = 0; k < block; ++k) {
            slope[to + k] -= g(at + k);
            slope[block * first + k] += g(at + k);
          }
        }
      const Frame frame(tangents(e, positions_));
      for (Index a = 0; a < dim_; ++a)
        for (Index k = 0; k < coordinates; ++k) {
          Small unit = Small::Zero(coordinates, dim_);
          unit(k, a) = 1;
          const Small moved = frame.coordinates(unit);
          auto slope = out.by_tangents.row(e).segment(n * (coordinates * a + k), n);
          slope.setZero();
          for (Index i = 0; i < dim_; ++i)
            for (Index j = 0; j < dim_; ++j)
              slope += moved(i, j) * by_coordinates.col(dim_ * i + j).transpose();
        }
    }
  };
  parallel_tasks(plan.batch_count(), visit, threads);
  return out;
}

Vec RestSensitivity::gradient(const RowMatrix& change) const {
  if (change.rows() != positions_.rows() || change.cols() != positions_.cols())
    throw InvalidArgument(
        fmt::format("RestSensitivity: a change of {} by {} numbers, the positions "
                    "have {} by {}",
                    change.rows(), change.cols(), positions_.rows(), positions_.cols()));
  require_finite_rows("RestSensitivity: the change", change);
  Vec sum = Vec::Zero(sensitivity_.point().size());
  for (const Term& term : terms_)
    for (Index e = 0; e < cells_.rows(); ++e) {
      const Small moved = tangents(e, change);
      const Index n = term.dofs.local_size();
      for (Index k = 0; k < n; ++k) {
        double entry = 0;
        for (Index t = 0; t < moved.size(); ++t)
          entry += moved.data()[t] * term.by_tangents(e, n * t + k);
        sum[term.unknown(e, k)] += term.weights[e] * entry;
      }
    }
  return sum;
}

Vec RestSensitivity::forward(const RowMatrix& change) const {
  return sensitivity_.forward(Sensitivity::Change{.gradient = gradient(change)});
}

RowMatrix RestSensitivity::adjoint(const Sensitivity::Derivative& derivative) const {
  const Vec& u = derivative.adjoint_state;
  require_size("RestSensitivity::adjoint: the adjoint state", u.size(),
               sensitivity_.point().size());
  RowMatrix out = RowMatrix::Zero(positions_.rows(), positions_.cols());
  for (const Term& term : terms_)
    for (Index e = 0; e < cells_.rows(); ++e) {
      const Index n = term.dofs.local_size();
      Small slopes(positions_.cols(), dim_);
      for (Index t = 0; t < slopes.size(); ++t) {
        double slope = 0;
        for (Index k = 0; k < n; ++k)
          slope -= term.by_tangents(e, n * t + k) * u[term.unknown(e, k)];
        slopes.data()[t] = term.weights[e] * slope;
      }
      for (Index k = 0; k < dim_; ++k) {
        out.row(cells_(e, end_of_tangent(dim_, k))) += slopes.col(k).transpose();
        out.row(cells_(e, first_corner(dim_))) -= slopes.col(k).transpose();
      }
    }
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
