#include "majorant/framework/elimination.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/internal/affine_presolve.h"
#include "majorant/framework/projection.h"

namespace majorant {

Elimination::Elimination(Index full_size, const ConstraintRows& rows)
    : auxiliary_size_(rows.auxiliary_count()) {
  rows.require_ended();
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (auto e = rows.begin(r); e != rows.end(r); ++e)
      if (e->unknown < -auxiliary_size_ || e->unknown >= full_size)
        throw InvalidArgument(
            fmt::format("constraint row '{}': unknown {} does not exist, there "
                        "are {} and {} auxiliary ones",
                        rows.label(r), e->unknown, full_size, auxiliary_size_));
  const SolvedUnknowns solved = solve_rows(full_size, rows);
  const Index all = full_size + auxiliary_size_;
  std::vector<Index> reduced(to_size(all), -1);
  for (Index i = 0; i < all; ++i) {
    if (solved.fixed[i] || solved.others.count(i)) continue;
    reduced[i] = static_cast<Index>(free_.size());
    free_.push_back(i);
  }
  unknown_.reserve(to_size(full_size));
  for (Index i = 0; i < full_size; ++i) {
    const auto it = solved.others.find(i);
    const bool is_fixed = solved.fixed[i];
    if (!is_fixed && it == solved.others.end()) {
      unknown_.push_back(reduced[i]);
      continue;
    }
    unknown_.push_back(-1 - static_cast<Index>(others_.size()));
    others_.push_back({entries_.size(), is_fixed ? solved.fixed_to[i] : it->second.constant});
    if (is_fixed) continue;
    for (const auto& [unknown, c] : it->second.terms) entries_.push_back({reduced[unknown], c});
  }
  others_.push_back({entries_.size(), 0});
  define_auxiliaries(rows);
}

void Elimination::define_auxiliaries(const ConstraintRows& rows) {
  std::vector<char> known(to_size(auxiliary_size_), 0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const ConstraintRows::Entry* open = nullptr;
    int open_count = 0;
    for (auto e = rows.begin(r); e != rows.end(r); ++e)
      if (e->unknown < 0 && !known[-1 - e->unknown]) {
        open = e;
        ++open_count;
      }
    if (open_count != 1 || open->coefficient == 0) continue;
    const double scale = open->coefficient;
    Definition d{-1 - open->unknown, rows.rhs(r) / scale, {}};
    for (auto e = rows.begin(r); e != rows.end(r); ++e)
      if (e != open)
        d.terms.push_back({row_position(e->unknown, full_size()), -e->coefficient / scale});
    known[d.auxiliary] = 1;
    definitions_.push_back(std::move(d));
  }
}

bool Elimination::begins_like(const Elimination& other, Index full_unknowns) const {
  if (full_unknowns > full_size() || full_unknowns > other.full_size()) return false;
  for (Index i = 0; i < full_unknowns; ++i)
    if (!(row(i) == other.row(i))) return false;
  return true;
}

void Elimination::expand(VecIn y, Vec& x) const {
  x.resize(full_size());
  for (Index i = 0; i < full_size(); ++i) {
    x[i] = offset(i);
    for (const Entry& e : row(i)) x[i] += e.coefficient * y[e.reduced];
  }
}

void Elimination::expand_direction(VecIn dy, Vec& dx) const {
  dx.setZero(full_size());
  for (Index i = 0; i < full_size(); ++i)
    for (const Entry& e : row(i)) dx[i] += e.coefficient * dy[e.reduced];
}

void Elimination::restrict_gradient(VecIn gx, Vec& gy) const {
  gy.setZero(reduced_size());
  for (Index i = 0; i < full_size(); ++i)
    for (const Entry& e : row(i)) gy[e.reduced] += e.coefficient * gx[i];
}

Vec Elimination::reduce(VecIn x, double* residual) const {
  Vec auxiliary = Vec::Zero(auxiliary_size_);
  const auto value = [&](Index i) { return i < full_size() ? x[i] : auxiliary[i - full_size()]; };
  for (const Definition& d : definitions_) {
    auxiliary[d.auxiliary] = d.constant;
    for (const Entry& e : d.terms) auxiliary[d.auxiliary] += e.coefficient * value(e.reduced);
  }
  Vec y(reduced_size());
  for (Index j = 0; j < reduced_size(); ++j) y[j] = value(full_index(j));
  if (residual) {
    Vec back;
    expand(y, back);
    *residual = full_size() ? (back - x).cwiseAbs().maxCoeff() : 0.0;
  }
  return y;
}

// Preconditions with the lengths of the columns, because Z is well conditioned.
Vec Elimination::project(VecIn x) const {
  Vec lengths = Vec::Zero(reduced_size());
  for (Index i = 0; i < full_size(); ++i)
    for (const Entry& e : row(i)) lengths[e.reduced] += e.coefficient * e.coefficient;
  return projection(*this, x, Identity(), lengths);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
