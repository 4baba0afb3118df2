#include "majorant/elements/bezier_triangle_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "majorant/elements/det_coefficients.h"

namespace majorant {
namespace {

constexpr int kMaxLocal = 2 * control_point_count(BezierTriangleSpace::kMaxDegree);
constexpr int kMaxDet = control_point_count(2 * (BezierTriangleSpace::kMaxDegree - 1));

// One side of an edge, in a face.
struct Side {
  Index low, high, face;
  int edge;
};

std::vector<Side> sorted_sides(const Cells& faces) {
  std::vector<Side> sides;
  for (Index f = 0; f < faces.rows(); ++f)
    for (int e = 0; e < 3; ++e) {
      const Index a = faces(f, e), b = faces(f, (e + 1) % 3);
      sides.push_back({std::min(a, b), std::max(a, b), f, e});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  return sides;
}

}  // namespace

LatticeNumbering number_lattice(const Cells& faces, Index vertex_count, int n) {
  const TriangleIndices& ix = TriangleIndices::of_degree(n);
  LatticeNumbering out;
  out.cells.resize(faces.rows(), ix.count());
  out.cells.leftCols(3) = faces;
  out.node_count = vertex_count;
  const std::vector<Side> sides = sorted_sides(faces);
  for (std::size_t k = 0; k < sides.size();) {
    std::size_t end = k;
    while (end < sides.size() && sides[end].low == sides[k].low && sides[end].high == sides[k].high)
      ++end;
    if (end - k > 2) throw std::invalid_argument("number_lattice: edge with three faces");
    for (std::size_t q = k; q < end; ++q) {
      const bool forward = faces(sides[q].face, sides[q].edge) == sides[k].low;
      for (int s = 1; s < n; ++s)
        out.cells(sides[q].face, ix.edge(sides[q].edge)[static_cast<std::size_t>(s)]) =
            out.node_count + (forward ? s - 1 : n - 1 - s);
    }
    if (end - k == 1)
      for (const int local : ix.edge(sides[k].edge))
        out.boundary_nodes.push_back(out.cells(sides[k].face, local));
    out.node_count += n - 1;
    k = end;
  }
  std::sort(out.boundary_nodes.begin(), out.boundary_nodes.end());
  out.boundary_nodes.erase(std::unique(out.boundary_nodes.begin(), out.boundary_nodes.end()),
                           out.boundary_nodes.end());
  for (Index f = 0; f < faces.rows(); ++f)
    for (int k = 3 * n; k < ix.count(); ++k) out.cells(f, k) = out.node_count++;
  return out;
}

BezierTriangleSpace::BezierTriangleSpace(const Cells& faces, Index vertex_count, int degree)
    : faces_(faces), vertex_count_(vertex_count), degree_(degree) {
  if (degree < 1 || degree > kMaxDegree)
    throw std::invalid_argument("BezierTriangleSpace: degree must be 1..8");
  numbering_ = number_lattice(faces, vertex_count, degree);
}

// d_a B^n_i = n B^{n-1}_{i - e_a} (formal barycentric derivatives), and the product of two such is
// one Bernstein polynomial of degree 2n-2 up to a factor.
ContractionTable BezierTriangleSpace::tabulate(const Quadrature& rule) const {
  const int n = degree_;
  const TriangleIndices& ix = TriangleIndices::of_degree(n);
  const TriangleIndices& low = TriangleIndices::of_degree(n - 1);
  const TriangleIndices& product = TriangleIndices::of_degree(2 * n - 2);
  ContractionTable t;
  t.nodes = ix.count();
  t.directions.resize(3, 2);
  t.directions << 1, 0, 0, 1, -1, -1;
  t.weights = rule.weights;
  t.first.resize(rule.size(), low.count());
  t.moment.resize(rule.size(), product.count());
  for (Index l = 0; l < rule.size(); ++l) {
    const Barycentric xi = rule.points.row(l);
    t.first.row(l) = bernstein_values(n - 1, xi);
    t.moment.row(l) = bernstein_values(2 * n - 2, xi);
  }
  const auto lowered = [&](int node, int direction) {
    MultiIndex m = ix.multi(node);
    return --m[static_cast<std::size_t>(direction)] < 0 ? -1 : low.local(m[0], m[1], m[2]);
  };
  for (int i = 0; i < t.nodes; ++i)
    for (int a = 0; a < 3; ++a)
      if (lowered(i, a) >= 0) t.gradient.push_back({i, a, lowered(i, a), double(n)});
  t.pair_starts.push_back(0);
  for (int i = 0; i < t.nodes; ++i)
    for (int j = 0; j <= i; ++j) {
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          const int r = lowered(i, a), s = lowered(j, b);
          if (r < 0 || s < 0) continue;
          const MultiIndex &u = low.multi(r), &v = low.multi(s);
          const int m = product.local(u[0] + v[0], u[1] + v[1], u[2] + v[2]);
          t.hessian.push_back(
              {a, b, m, n * n * low.multinomial(r) * low.multinomial(s) / product.multinomial(m)});
        }
      t.pair_starts.push_back(static_cast<int>(t.hessian.size()));
    }
  return t;
}

void BezierTriangleSpace::gather(Index e, VecIn x, double* local) const {
  for (int k = 0; k < nodes_per_element(); ++k) {
    local[2 * k] = x[2 * numbering_.cells(e, k)];
    local[2 * k + 1] = x[2 * numbering_.cells(e, k) + 1];
  }
}

PositivityProof BezierTriangleSpace::certify(Index e, VecIn x, int max_depth) const {
  const DetCoefficients& det = DetCoefficients::of_degree(degree_);
  double c[kMaxLocal], d[kMaxDet], error[kMaxDet];
  gather(e, x, c);
  if (!std::all_of(c, c + 2 * nodes_per_element(), [](double v) { return std::isfinite(v); }))
    return {Positivity::Violated, -std::numeric_limits<double>::infinity(), 0};
  const auto prove = [&] {
    return certify_positive(det.det_degree(), d, *std::max_element(error, error + det.count()),
                            max_depth);
  };
  det.at_with_error(c, d, error);
  const PositivityProof proof = prove();
  if (proof.result == Positivity::Certified) return proof;
  det.at_with_error_quad(c, d, error);
  return prove();
}

double BezierTriangleSpace::largest_step(Index e, VecIn x, VecIn d, double s, int max_depth) const {
  const DetCoefficients& det = DetCoefficients::of_degree(degree_);
  double cx[kMaxLocal], cd[kMaxLocal], p[3][kMaxDet];
  gather(e, x, cx);
  gather(e, d, cd);
  det.along_line(cx, cd, p[0], p[1], p[2]);
  return largest_positive_step(det.det_degree(), p[0], p[1], p[2], s, max_depth);
}

Vec BezierTriangleSpace::elevate(VecIn x, const BezierTriangleSpace& higher) const {
  const Eigen::MatrixXd e = elevation_matrix(degree_);
  Vec out = Vec::Zero(2 * higher.node_count());
  for (Index f = 0; f < numbering_.cells.rows(); ++f)
    for (Index q = 0; q < e.rows(); ++q)
      for (int c = 0; c < 2; ++c) {
        double value = 0;
        for (Index p = 0; p < e.cols(); ++p) value += e(q, p) * x[2 * numbering_.cells(f, p) + c];
        out[2 * higher.cells()(f, q) + c] = value;
      }
  // Corner points stay the same doubles.
  for (Index v = 0; v < 2 * vertex_count_; ++v) out[v] = x[v];
  return out;
}

}  // namespace majorant
