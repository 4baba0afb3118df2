// A small dense matrix of any scalar: the type of J in lambdas of density<M, D>. Eigen's own
// matrices assume that a scalar compares to one bool and converts from double, which SIMD batches
// do not.
//
//   const auto mips = [](const auto& J) { return J.squaredNorm() / J.determinant(); };
#pragma once

#include <array>
#include <cstddef>

namespace majorant {

template <class T, int R, int C>
class SmallMatrix {
 public:
  T& operator()(int i, int j) { return entries_[static_cast<std::size_t>(i * C + j)]; }
  const T& operator()(int i, int j) const { return entries_[static_cast<std::size_t>(i * C + j)]; }

  T squaredNorm() const {
    T sum = entries_[0] * entries_[0];
    for (std::size_t k = 1; k < entries_.size(); ++k) sum = sum + entries_[k] * entries_[k];
    return sum;
  }
  T trace() const requires(R == C) {
    T sum = entries_[0];
    for (int i = 1; i < R; ++i) sum = sum + (*this)(i, i);
    return sum;
  }
  T determinant() const requires(R == C && R <= 3) {
    const SmallMatrix& a = *this;
    if constexpr (R == 1) return a(0, 0);
    if constexpr (R == 2) return a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0);
    if constexpr (R == 3)
      return a(0, 0) * minor(1, 2, 1, 2) - a(0, 1) * minor(1, 2, 0, 2) +
             a(0, 2) * minor(1, 2, 0, 1);
  }
  // Returns the transposed cofactors: inverse = adjugate / determinant.
  SmallMatrix adjugate() const requires(R == C && (R == 2 || R == 3)) {
    const SmallMatrix& a = *this;
    SmallMatrix out;
    if constexpr (R == 2) {
      out(0, 0) = a(1, 1);
      out(0, 1) = -a(0, 1);
      out(1, 0) = -a(1, 0);
      out(1, 1) = a(0, 0);
    } else {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          out(j, i) = minor((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
    }
    return out;
  }
  SmallMatrix inverse() const requires(R == C && (R == 2 || R == 3)) {
    SmallMatrix out = adjugate();
    const T scale = 1.0 / determinant();
    for (T& entry : out.entries_) entry = entry * scale;
    return out;
  }
  SmallMatrix<T, C, R> transpose() const {
    SmallMatrix<T, C, R> out;
    for (int i = 0; i < R; ++i)
      for (int j = 0; j < C; ++j) out(j, i) = (*this)(i, j);
    return out;
  }

  template <int K>
  friend SmallMatrix<T, R, K> operator*(const SmallMatrix& a, const SmallMatrix<T, C, K>& b) {
    SmallMatrix<T, R, K> out;
    for (int i = 0; i < R; ++i)
      for (int k = 0; k < K; ++k) {
        out(i, k) = a(i, 0) * b(0, k);
        for (int j = 1; j < C; ++j) out(i, k) = out(i, k) + a(i, j) * b(j, k);
      }
    return out;
  }
  friend SmallMatrix operator+(SmallMatrix a, const SmallMatrix& b) {
    for (std::size_t k = 0; k < a.entries_.size(); ++k)
      a.entries_[k] = a.entries_[k] + b.entries_[k];
    return a;
  }
  friend SmallMatrix operator-(SmallMatrix a, const SmallMatrix& b) {
    for (std::size_t k = 0; k < a.entries_.size(); ++k)
      a.entries_[k] = a.entries_[k] - b.entries_[k];
    return a;
  }
  friend SmallMatrix operator*(double c, SmallMatrix a) {
    for (T& entry : a.entries_) entry = c * entry;
    return a;
  }

 private:
  template <class, int, int>
  friend class SmallMatrix;
  T minor(int i0, int i1, int j0, int j1) const {
    return (*this)(i0, j0) * (*this)(i1, j1) - (*this)(i0, j1) * (*this)(i1, j0);
  }
  std::array<T, static_cast<std::size_t>(R* C)> entries_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
