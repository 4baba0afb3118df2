// The history of L-BFGS [LN89]: the last pairs s = change of y, q = change of g, and the inverse
// Hessian B that they and a metric define. L-BFGS (first_order.h) and Newton's method on a kept
// factor (newton.h) use it.
//
//   History history(8, 1e-10);
//   Vec y, last_y, g, last_g, p;
//   const std::unique_ptr<LinearSolver> solver = make_direct_solver();
//   history.start(last_y, last_g);
//   history.visit(y, g);
//   history.apply([&](const Vec& r, Vec& p) { solver->solve(r, p); }, -g, p);   // p = -B g
#pragma once

#include <deque>
#include <utility>
#include <vector>

#include "majorant/framework/partition.h"

namespace majorant {

class History {
 public:
  // Keeps `capacity` pairs, 0: none; skips those with s.q <= cautious |s| |q|, so that B stays
  // positive definite [LF01].
  History(int capacity, double cautious) : capacity_(capacity), cautious_(cautious) {}

  bool empty() const { return pairs_.empty(); }
  // Forgets all pairs; the next pair still begins at the last visited point.
  void clear() { pairs_.clear(); }
  // Forgets all pairs and the point, and frees their memory. start() must come before the next
  // visit().
  void release() {
    clear();
    y_ = g_ = Vec();
  }
  // Forgets all pairs and begins at y with the gradient g. partition: of both; it must outlive the
  // history.
  void start(const Vec& y, const Vec& g) {
    static const Partition whole;
    start(y, g, whole);
  }
  void start(const Vec& y, const Vec& g, const Partition& partition) {
    clear();
    partition_ = &partition;
    y_ = y;
    g_ = g;
  }
  // Adds the pair from the last point to y, whose gradient is g.
  void visit(const Vec& y, const Vec& g) {
    add(y - y_, g - g_);
    y_ = y;
    g_ = g;
  }

  // Computes p = B r by the two loops of [LN89]. solve(r, p): p = M^-1 r, M the metric.
  template <class Solve>
  void apply(const Solve& solve, Vec r, Vec& p) const {
    std::vector<double> alpha(pairs_.size());
    for (std::size_t k = pairs_.size(); k-- > 0;) {
      alpha[k] = dot(pairs_[k].s, r) / pairs_[k].sq;
      r -= alpha[k] * pairs_[k].q;
    }
    solve(r, p);
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      p += (alpha[k] - dot(pairs_[k].q, p) / pairs_[k].sq) * pairs_[k].s;
  }

 private:
  struct Pair {
    Vec s, q;
    double sq;
  };

  void add(Vec s, Vec q) {
    const double sq = dot(s, q);
    if (capacity_ <= 0 || !(sq > cautious_ * partition_->norm(s) * partition_->norm(q))) return;
    if (pairs_.size() == to_size(capacity_)) pairs_.pop_front();
    pairs_.push_back({std::move(s), std::move(q), sq});
  }

  double dot(const Vec& a, const Vec& b) const { return partition_->dot(a, b); }

  int capacity_;
  double cautious_;
  const Partition* partition_ = nullptr;
  std::deque<Pair> pairs_;
  Vec y_, g_;  // of the last point
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
