#include "majorant/framework/internal/affine_presolve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

__extension__ typedef __int128 Wide;

// An exact fraction in lowest terms, positive denominator.
class Rational {
 public:
  Rational(long numerator = 0) : num_(numerator) {}
  bool zero() const { return num_ == 0; }
  bool unit() const { return den_ == 1 && (num_ == 1 || num_ == -1); }
  double value() const { return static_cast<double>(num_) / static_cast<double>(den_); }
  long numerator() const { return num_; }
  long denominator() const { return den_; }
  Rational negative_quotient(const Rational& d) const {
    return make(-Wide(num_) * d.den_, Wide(den_) * d.num_);
  }
  Rational over(const Rational& d) const { return make(Wide(num_) * d.den_, Wide(den_) * d.num_); }
  Rational times(const Rational& o) const { return make(Wide(num_) * o.num_, Wide(den_) * o.den_); }
  Rational plus(const Rational& o) const {
    return make(Wide(num_) * o.den_ + Wide(o.num_) * den_, Wide(den_) * o.den_);
  }

 private:
  static Rational make(Wide n, Wide d) {
    Wide a = n < 0 ? -n : n, b = d < 0 ? -d : d;
    while (b != 0) {
      const Wide r = a % b;
      a = b;
      b = r;
    }
    if (d < 0) a = -a;
    n /= a;
    d /= a;
    const Wide limit = std::numeric_limits<long>::max();
    if (n > limit || n < -limit || d > limit)
      throw Error(ErrorKind::Unsupported,
                  "constraints: exact coefficients leave 64 bits; use smaller integers");
    Rational r;
    r.num_ = static_cast<long>(n);
    r.den_ = static_cast<long>(d);
    return r;
  }
  long num_ = 0, den_ = 1;
};

// An affine expression sum coefficient * x[unknown] + constant; std::map keeps runs deterministic.
struct Expression {
  std::map<Index, Rational> terms;
  double constant = 0;

  // Integer coefficients without a common factor.
  void make_primitive() {
    long gcd = 0, lcm = 1;
    for (const auto& term : terms) {
      gcd = std::gcd(gcd, term.second.numerator());
      lcm =
          Rational(lcm)
              .times(Rational(term.second.denominator() / std::gcd(lcm, term.second.denominator())))
              .numerator();
    }
    if (gcd == 1 && lcm == 1) return;
    const Rational factor = Rational(lcm).over(Rational(gcd));
    for (auto& term : terms) term.second = term.second.times(factor);
    constant *= factor.value();
  }

  void add(const Expression& other, const Rational& factor) {
    for (const auto& [unknown, c] : other.terms) {
      auto [it, fresh] = terms.try_emplace(unknown, 0);
      it->second = it->second.plus(c.times(factor));
      if (it->second.zero()) terms.erase(it);
    }
    constant += factor.value() * other.constant;
  }
};

bool is_integer(double c) {
  return std::abs(c) <= ConstraintRows::kLargestInteger && c == std::trunc(c);
}

bool has_integers_only(const ConstraintRows& rows, std::size_t r) {
  return std::all_of(rows.begin(r), rows.end(r),
                     [](const auto& e) { return is_integer(e.coefficient); });
}

[[noreturn]] void refuse_contradiction(const ConstraintRows& rows, std::size_t r, double residual) {
  throw Error(ErrorKind::Unsupported,
              fmt::format("constraints contradict each other: row '{}' is off by {:g}; remove it "
                          "or change its target",
                          rows.label(r), residual));
}

using Expressions = std::unordered_map<Index, AffineExpression>;

// Finds rows +-x = number whose x no other row has.
class SingletonRows {
 public:
  SingletonRows(Index full_size, const ConstraintRows& rows) : full_size_(full_size), rows_(rows) {
    mentions_.resize(to_size(full_size + rows.auxiliary_count()), 0);
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (auto e = rows.begin(r); e != rows.end(r); ++e) ++mentions_[unknown(*e)];
  }
  bool contains(std::size_t r) const {
    const auto e = rows_.begin(r);
    return rows_.end(r) - e == 1 && std::abs(e->coefficient) == 1 && mentions_[unknown(*e)] == 1;
  }
  void solve(SolvedUnknowns& solved) const {
    solved.fixed.assign(mentions_.size(), 0);
    solved.fixed_to = Vec::Zero(static_cast<Eigen::Index>(mentions_.size()));
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (contains(r)) {
        const ConstraintRows::Entry& e = *rows_.begin(r);
        solved.fixed[unknown(e)] = 1;
        solved.fixed_to[unknown(e)] += e.coefficient * rows_.rhs(r);
      }
  }

 private:
  Index unknown(const ConstraintRows::Entry& e) const {
    return row_position(e.unknown, full_size_);
  }

  Index full_size_;
  const ConstraintRows& rows_;
  std::vector<Index> mentions_;  // by row_position()
};

// Gauss-Jordan on integer rows: after every row, `solved` expresses eliminated unknowns by free
// ones.
class IntegerRows {
 public:
  IntegerRows(Index full_size, const ConstraintRows& rows, const SingletonRows& lone)
      : full_size_(full_size), rows_(rows) {
    for (std::size_t r = 0; r < rows.size(); ++r) scale_ = std::max(scale_, std::abs(rows.rhs(r)));
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (!lone.contains(r) && has_integers_only(rows, r)) eliminate(r);
  }
  Expressions solved() const {
    Expressions rounded;
    for (const auto& [unknown, e] : solved_) {
      AffineExpression& out = rounded[unknown];
      out.constant = e.constant;
      for (const auto& [u, c] : e.terms) out.terms.emplace_hint(out.terms.end(), u, c.value());
    }
    return rounded;
  }

 private:
  void eliminate(std::size_t r) {
    Expression row;
    row.constant = -rows_.rhs(r);
    for (auto e = rows_.begin(r); e != rows_.end(r); ++e) {
      const Index unknown = row_position(e->unknown, full_size_);
      Expression term;
      if (auto known = solved_.find(unknown); known != solved_.end())
        term = known->second;
      else
        term.terms.emplace(unknown, Rational(1));
      row.add(term, Rational(static_cast<long>(e->coefficient)));
    }
    if (row.terms.empty()) return check_redundant(r, row.constant);
    row.make_primitive();
    auto pivot = std::find_if(row.terms.begin(), row.terms.end(),
                              [](const auto& t) { return t.second.unit(); });
    if (pivot == row.terms.end()) pivot = row.terms.begin();
    solve_for(pivot->first, pivot->second, std::move(row));
  }

  void solve_for(Index unknown, Rational pivot, Expression row) {
    row.terms.erase(unknown);
    Expression solution;
    solution.add(row, Rational(1).negative_quotient(pivot));
    for (const Index user : users_[unknown]) {
      Expression& e = solved_.at(user);
      const auto it = e.terms.find(unknown);
      if (it == e.terms.end()) continue;
      const Rational factor = it->second;
      e.terms.erase(it);
      e.add(solution, factor);
      register_user(user, solution);
    }
    users_.erase(unknown);
    register_user(unknown, solution);
    solved_.emplace(unknown, std::move(solution));
  }

  void register_user(Index user, const Expression& e) {
    for (const auto& term : e.terms) users_[term.first].insert(user);
  }

  void check_redundant(std::size_t r, double residual) const {
    if (std::abs(residual) <= kFollows * scale_) return;
    refuse_contradiction(rows_, r, residual);
  }

  Index full_size_;
  const ConstraintRows& rows_;
  double scale_ = 0;
  std::unordered_map<Index, Expression> solved_;
  std::unordered_map<Index, std::unordered_set<Index>>
      users_;  // free unknown -> solved that use it
};

// The rows with other coefficients, which follow those of integers.
class RealRows {
 public:
  RealRows(Index full_size, const ConstraintRows& rows, Expressions solved)
      : full_size_(full_size), rows_(rows), solved_(std::move(solved)) {
    std::vector<std::size_t> own;
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (!has_integers_only(rows, r)) own.push_back(r);
    if (own.empty()) return;
    for (const auto& [unknown, e] : solved_) register_user(unknown, e);
    for (const std::size_t r : own) eliminate(r);
  }
  Expressions take() { return std::move(solved_); }

 private:
  // The rest of a row after subtracting those before it, and the largest subtracted numbers.
  struct Rest {
    AffineExpression row;
    double largest_product = 0, largest_constant = 0;
    std::vector<Index> used;  // solved unknowns
  };

  static void add(AffineExpression& to, const AffineExpression& from, double factor) {
    for (const auto& [unknown, c] : from.terms) add(to, unknown, factor * c);
    to.constant += factor * from.constant;
  }
  // Drops coefficients that cancel to within rounding.
  static void add(AffineExpression& to, Index unknown, double c) {
    const auto [it, fresh] = to.terms.try_emplace(unknown, 0);
    const double size = std::max(std::abs(it->second), std::abs(c));
    it->second += c;
    if (std::abs(it->second) <= kCancelled * size) to.terms.erase(it);
  }

  Rest substitute(std::size_t r) const {
    Rest rest;
    rest.row.constant = -rows_.rhs(r);
    rest.largest_constant = std::abs(rows_.rhs(r));
    for (auto e = rows_.begin(r); e != rows_.end(r); ++e) {
      if (e->coefficient == 0) continue;
      if (!std::isfinite(e->coefficient))
        throw InvalidArgument(fmt::format("constraint row '{}': a coefficient is {}",
                                          rows_.label(r), e->coefficient));
      const Index unknown = row_position(e->unknown, full_size_);
      rest.largest_product = std::max(rest.largest_product, std::abs(e->coefficient));
      const auto known = solved_.find(unknown);
      if (known == solved_.end()) {
        add(rest.row, unknown, e->coefficient);
        continue;
      }
      rest.used.push_back(unknown);
      add(rest.row, known->second, e->coefficient);
      for (const auto& term : known->second.terms)
        rest.largest_product =
            std::max(rest.largest_product, std::abs(e->coefficient * term.second));
      rest.largest_constant =
          std::max(rest.largest_constant, std::abs(e->coefficient * known->second.constant));
    }
    return rest;
  }

  void eliminate(std::size_t r) {
    Rest rest = substitute(r);
    const auto smaller = [](const auto& a, const auto& b) {
      return std::abs(a.second) < std::abs(b.second);
    };
    const auto largest = std::max_element(rest.row.terms.begin(), rest.row.terms.end(), smaller);
    const double left =
        largest == rest.row.terms.end() ? 0 : std::abs(largest->second) / rest.largest_product;
    if (left <= kFollows) {
      if (std::abs(rest.row.constant) > kSameTarget * rest.largest_constant)
        refuse_contradiction(rows_, r, rest.row.constant);
      return;
    }
    if (left < kNearlyFollows) refuse_doubtful(r, rest, left);
    solve_for(r, largest->first, largest->second, std::move(rest.row));
  }

  void solve_for(std::size_t r, Index unknown, double pivot, AffineExpression row) {
    row.terms.erase(unknown);
    AffineExpression solution;
    add(solution, row, -1 / pivot);
    for (const Index user : users_[unknown]) {
      AffineExpression& e = solved_.at(user);
      const auto it = e.terms.find(unknown);
      if (it == e.terms.end()) continue;
      const double factor = it->second;
      e.terms.erase(it);
      add(e, solution, factor);
      register_user(user, solution);
    }
    users_.erase(unknown);
    register_user(unknown, solution);
    solved_.emplace(unknown, std::move(solution));
    row_of_.emplace(unknown, r);
  }

  void register_user(Index user, const AffineExpression& e) {
    for (const auto& term : e.terms) users_[term.first].insert(user);
  }

  [[noreturn]] void refuse_doubtful(std::size_t r, const Rest& rest, double left) const {
    std::string others;
    for (const Index unknown : rest.used)
      if (const auto row = row_of_.find(unknown); row != row_of_.end())
        others += fmt::format("{}'{}'", others.empty() ? ": " : ", ", rows_.label(row->second));
    throw Error(ErrorKind::Unsupported,
                fmt::format("constraint row '{}' nearly follows from rows before it{}: {:.1g} of "
                            "it is left, too little to tell from rounding; remove it, or make it "
                            "follow to the last digit",
                            rows_.label(r), others, left));
  }

  // A sum below this part of the larger of two numbers counts as 0: a few roundings.
  static constexpr double kCancelled = 1e-15;

  Index full_size_;
  const ConstraintRows& rows_;
  Expressions solved_;
  std::unordered_map<Index, std::set<Index>> users_;  // free unknown -> solved that use it
  std::unordered_map<Index, std::size_t> row_of_;     // solved unknown -> row
};

}  // namespace

SolvedUnknowns solve_rows(Index full_size, const ConstraintRows& rows) {
  const SingletonRows lone(full_size, rows);
  SolvedUnknowns solved;
  lone.solve(solved);
  solved.others = RealRows(full_size, rows, IntegerRows(full_size, rows, lone).solved()).take();
  return solved;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
