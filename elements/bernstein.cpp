#include "majorant/elements/bernstein.h"

#include <cmath>

namespace majorant {
namespace {

double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

// Appends multi-indices of degree n in VTK order, shifted by `offset` in each component.
void append_vtk_order(int n, int offset, std::vector<MultiIndex>& out) {
  const auto push = [&](int i, int j, int k) {
    out.push_back({i + offset, j + offset, k + offset});
  };
  if (n < 0) return;
  if (n == 0) return push(0, 0, 0);
  push(n, 0, 0);
  push(0, n, 0);
  push(0, 0, n);
  for (int s = 1; s < n; ++s) push(n - s, s, 0);
  for (int s = 1; s < n; ++s) push(0, n - s, s);
  for (int s = 1; s < n; ++s) push(s, 0, n - s);
  append_vtk_order(n - 3, offset + 1, out);
}

}  // namespace

int degree_from_control_points(int count) {
  int n = 0;
  while (control_point_count(n) < count) ++n;
  return control_point_count(n) == count ? n : -1;
}

TriangleIndices::TriangleIndices(int n) : degree_(n) {
  append_vtk_order(n, 0, multi_);
  lookup_.assign(to_size((n + 1) * (n + 1)), -1);
  for (int l = 0; l < count(); ++l) {
    const auto [i, j, k] = multi(l);
    lookup_[i * (n + 1) + j] = l;
    multinomial_.push_back(std::round(factorial(n) / (factorial(i) * factorial(j) * factorial(k))));
  }
  for (int s = 0; s <= n; ++s) {
    edges_[0].push_back(local(n - s, s, 0));
    edges_[1].push_back(local(0, n - s, s));
    edges_[2].push_back(local(s, 0, n - s));
  }
}

const TriangleIndices& TriangleIndices::of_degree(int n) {
  static const std::vector<TriangleIndices> tables = [] {
    std::vector<TriangleIndices> all;
    for (int degree = 0; degree <= kMaxDegree; ++degree) all.push_back(TriangleIndices(degree));
    return all;
  }();
  return tables.at(to_size(n));
}

Vec bernstein_values(int n, const Barycentric& xi) {
  const TriangleIndices& ix = TriangleIndices::of_degree(n);
  Vec b(ix.count());
  for (int l = 0; l < ix.count(); ++l) {
    const auto [i, j, k] = ix.multi(l);
    b[l] = ix.multinomial(l) * integer_power(xi[0], i) * integer_power(xi[1], j) *
           integer_power(xi[2], k);
  }
  return b;
}

Eigen::MatrixX2d bernstein_gradients(int n, const Barycentric& xi) {
  const TriangleIndices& ix = TriangleIndices::of_degree(n);
  Eigen::MatrixX2d g = Eigen::MatrixX2d::Zero(ix.count(), 2);
  if (n == 0) return g;
  const TriangleIndices& low = TriangleIndices::of_degree(n - 1);
  const Vec b = bernstein_values(n - 1, xi);
  for (int l = 0; l < ix.count(); ++l) {
    const auto [i, j, k] = ix.multi(l);
    if (i > 0) g(l, 0) += n * b[low.local(i - 1, j, k)];
    if (j > 0) g(l, 1) += n * b[low.local(i, j - 1, k)];
    if (k > 0) g.row(l).array() -= n * b[low.local(i, j, k - 1)];
  }
  return g;
}

Eigen::MatrixXd elevation_matrix(int n) {
  const TriangleIndices& low = TriangleIndices::of_degree(n);
  const TriangleIndices& high = TriangleIndices::of_degree(n + 1);
  Eigen::MatrixXd e = Eigen::MatrixXd::Zero(high.count(), low.count());
  for (int l = 0; l < high.count(); ++l) {
    const auto [i, j, k] = high.multi(l);
    if (i > 0) e(l, low.local(i - 1, j, k)) += i / double(n + 1);
    if (j > 0) e(l, low.local(i, j - 1, k)) += j / double(n + 1);
    if (k > 0) e(l, low.local(i, j, k - 1)) += k / double(n + 1);
  }
  return e;
}

Vec multiply(int m, VecIn a, int n, VecIn b) {
  const TriangleIndices& im = TriangleIndices::of_degree(m);
  const TriangleIndices& in = TriangleIndices::of_degree(n);
  const TriangleIndices& ip = TriangleIndices::of_degree(m + n);
  Vec p = Vec::Zero(ip.count());
  for (int r = 0; r < im.count(); ++r)
    for (int s = 0; s < in.count(); ++s) {
      const MultiIndex &u = im.multi(r), &v = in.multi(s);
      const int t = ip.local(u[0] + v[0], u[1] + v[1], u[2] + v[2]);
      p[t] += im.multinomial(r) * in.multinomial(s) / ip.multinomial(t) * a[r] * b[s];
    }
  return p;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
