#include "majorant/framework/internal/elimination.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>

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

// Auxiliary unknowns are numbered after the full ones.
Index position(Index unknown, Index full_size) {
  return unknown >= 0 ? unknown : full_size - 1 - unknown;
}

// Gauss-Jordan: `solved` expresses eliminated unknowns by free ones only, after every row.
class Eliminator {
 public:
  Eliminator(Index full_size, const ConstraintRows& rows) : full_size_(full_size), rows_(rows) {
    for (std::size_t r = 0; r < rows.size(); ++r) scale_ = std::max(scale_, std::abs(rows.rhs(r)));
    for (std::size_t r = 0; r < rows.size(); ++r) eliminate(r);
  }
  const std::unordered_map<Index, Expression>& solved() const { return solved_; }

 private:
  void eliminate(std::size_t r) {
    Expression row;
    row.constant = -rows_.rhs(r);
    for (auto e = rows_.begin(r); e != rows_.end(r); ++e) {
      const Index unknown = position(e->unknown, full_size_);
      Expression term;
      if (auto known = solved_.find(unknown); known != solved_.end())
        term = known->second;
      else
        term.terms.emplace(unknown, Rational(1));
      row.add(term, Rational(e->coefficient));
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
    if (std::abs(residual) <= 1e-12 * scale_) return;
    throw Error(ErrorKind::Unsupported,
                fmt::format("constraints contradict each other: row '{}' is off by {:g}; remove it "
                            "or change its target",
                            rows_.label(r), residual));
  }

  Index full_size_;
  const ConstraintRows& rows_;
  double scale_ = 0;
  std::unordered_map<Index, Expression> solved_;
  std::unordered_map<Index, std::unordered_set<Index>>
      users_;  // free unknown -> solved that use it
};

}  // namespace

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
  const Eliminator eliminator(full_size, rows);
  const auto& solved = eliminator.solved();
  const Index all = full_size + auxiliary_size_;
  std::vector<Index> reduced(at(all), -1);
  for (Index i = 0; i < all; ++i) {
    if (solved.count(i)) continue;
    reduced[at(i)] = static_cast<Index>(free_.size());
    free_.push_back(i);
  }
  offset_ = Vec::Zero(full_size);
  starts_.push_back(0);
  for (Index i = 0; i < full_size; ++i) {
    if (const auto it = solved.find(i); it != solved.end()) {
      for (const auto& [unknown, c] : it->second.terms)
        entries_.push_back({reduced[at(unknown)], c.value()});
      offset_[i] = it->second.constant;
    } else {
      entries_.push_back({reduced[at(i)], 1.0});
    }
    starts_.push_back(entries_.size());
  }
  define_auxiliaries(rows);
}

void Elimination::define_auxiliaries(const ConstraintRows& rows) {
  std::vector<char> known(at(auxiliary_size_), 0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const ConstraintRows::Entry* open = nullptr;
    int open_count = 0;
    for (auto e = rows.begin(r); e != rows.end(r); ++e)
      if (e->unknown < 0 && !known[at(-1 - e->unknown)]) {
        open = e;
        ++open_count;
      }
    if (open_count != 1 || open->coefficient == 0) continue;
    const auto scale = static_cast<double>(open->coefficient);
    Definition d{-1 - open->unknown, rows.rhs(r) / scale, {}};
    for (auto e = rows.begin(r); e != rows.end(r); ++e)
      if (e != open)
        d.terms.push_back(
            {position(e->unknown, full_size()), -static_cast<double>(e->coefficient) / scale});
    known[at(d.auxiliary)] = 1;
    definitions_.push_back(std::move(d));
  }
}

bool Elimination::begins_like(const Elimination& other, Index full_unknowns) const {
  if (full_unknowns > full_size() || full_unknowns > other.full_size()) return false;
  const auto rows = full_unknowns + 1;
  return std::equal(starts_.begin(), starts_.begin() + rows, other.starts_.begin()) &&
         std::equal(begin(0), begin(full_unknowns), other.begin(0));
}

void Elimination::expand(VecIn y, Vec& x) const {
  x = offset_;
  for (Index i = 0; i < full_size(); ++i)
    for (auto e = begin(i); e != end(i); ++e) x[i] += e->coefficient * y[e->reduced];
}

void Elimination::expand_direction(VecIn dy, Vec& dx) const {
  dx.setZero(full_size());
  for (Index i = 0; i < full_size(); ++i)
    for (auto e = begin(i); e != end(i); ++e) dx[i] += e->coefficient * dy[e->reduced];
}

void Elimination::restrict_gradient(VecIn gx, Vec& gy) const {
  gy.setZero(reduced_size());
  for (Index i = 0; i < full_size(); ++i)
    for (auto e = begin(i); e != end(i); ++e) gy[e->reduced] += e->coefficient * gx[i];
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

// Conjugate gradients on Z^T Z y = Z^T (x - c), preconditioned by the columns' lengths: Z is well
// conditioned, and every y satisfies the constraints.
Vec Elimination::project(VecIn x) const {
  double residual = 0;
  Vec y = reduce(x, &residual);
  if (reduced_size() == 0 || residual <= 1e-14 * x.cwiseAbs().maxCoeff()) return y;
  Vec scale = Vec::Zero(reduced_size());
  for (const Entry& e : entries_) scale[e.reduced] += e.coefficient * e.coefficient;
  Vec image, gradient, product;
  expand(y, image);
  restrict_gradient(x - image, gradient);
  Vec step = gradient.cwiseQuotient(scale), direction = step;
  double slope = gradient.dot(step);
  const double enough = 1e-20 * slope;
  for (int k = 0; k < 1000 && slope > enough; ++k) {
    expand_direction(direction, image);
    const double length = slope / image.squaredNorm();
    y += length * direction;
    restrict_gradient(image, product);
    gradient -= length * product;
    step = gradient.cwiseQuotient(scale);
    const double before = std::exchange(slope, gradient.dot(step));
    direction = step + (slope / before) * direction;
  }
  return y;
}

}  // namespace majorant
