// This file is compiled once for each instruction set (cmake/kernels.cmake names the function). It
// must not instantiate inline code that other files share.
#include "majorant/framework/terms/internal/tape_kernels.h"

#include <xsimd/xsimd.hpp>

namespace majorant::detail {
namespace {

using Batch = xsimd::batch<double>;
constexpr int kWidth = static_cast<int>(Batch::size);
constexpr int kParts = kLanes / kWidth;

// A number for each lane, in registers.
struct Number {
  Batch part[kParts];
};

inline Number load(const Lanes& x) {
  Number r;
  for (int i = 0; i < kParts; ++i) r.part[i] = Batch::load_aligned(x.data() + i * kWidth);
  return r;
}
inline void store(Lanes& x, const Number& r) {
  for (int i = 0; i < kParts; ++i) r.part[i].store_aligned(x.data() + i * kWidth);
}
inline Number constant(double c) {
  Number r;
  for (int i = 0; i < kParts; ++i) r.part[i] = Batch(c);
  return r;
}
inline Number operator+(Number a, const Number& b) {
  for (int i = 0; i < kParts; ++i) a.part[i] += b.part[i];
  return a;
}
inline Number operator-(Number a, const Number& b) {
  for (int i = 0; i < kParts; ++i) a.part[i] -= b.part[i];
  return a;
}
inline Number operator*(Number a, const Number& b) {
  for (int i = 0; i < kParts; ++i) a.part[i] *= b.part[i];
  return a;
}
inline Number operator-(Number a) {
  for (int i = 0; i < kParts; ++i) a.part[i] = -a.part[i];
  return a;
}
inline Number fused(const Number& a, const Number& b, Number c) {  // a b + c
  for (int i = 0; i < kParts; ++i) c.part[i] = xsimd::fma(a.part[i], b.part[i], c.part[i]);
  return c;
}
inline void add_product(Lanes& sum, const Number& a, const Number& b) {
  store(sum, fused(a, b, load(sum)));
}

inline int entry(int i, int j) { return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i; }

class Derivatives {
 public:
  Derivatives(const TapeView& tape, const TapeScratch& scratch) : tape_(tape), s_(scratch) {}

  // Computes the derivatives of the result by all nodes, and the gradient. If gradient is null, the
  // derivatives are those that weight second derivatives.
  void adjoints(Lanes* gradient) const {
    const Number zero = constant(0), one = constant(1);
    for (int k = 0; gradient && k < tape_.unknowns; ++k) store(gradient[k], zero);
    for (int n = 0; n <= tape_.result; ++n) store(s_.adjoint[n], zero);
    store(s_.adjoint[tape_.result], one);
    for (int n = tape_.result; n >= 0; --n) {
      const TapeNode& node = tape_.nodes[n];
      const Lanes* c = tape_.numbers + node.numbers;
      const Number w = load(s_.adjoint[n]);
      switch (node.kind) {
        case TapeNode::Constant:
          break;
        case TapeNode::Unknown:
          if (gradient) store(gradient[node.a], w);
          break;
        case TapeNode::Shifted:
          add(node.a, w);
          break;
        case TapeNode::Damped:
          add(node.a, gradient ? w : w * load(c[0]));
          break;
        case TapeNode::Sum:
          add(node.a, w);
          add(node.b, w);
          break;
        case TapeNode::Difference:
          add(node.a, w);
          add(node.b, -w);
          break;
        case TapeNode::Negative:
          add(node.a, -w);
          break;
        case TapeNode::Scaled:
        case TapeNode::Function:
          add_product(s_.adjoint[node.a], w, load(c[0]));
          break;
        case TapeNode::Product:
          add_product(s_.adjoint[node.a], w, load(tape_.values[node.b]));
          add_product(s_.adjoint[node.b], w, load(tape_.values[node.a]));
          break;
        case TapeNode::Choice:
        case TapeNode::Function2:
          add_product(s_.adjoint[node.a], w, load(c[0]));
          add_product(s_.adjoint[node.b], w, load(c[1]));
          break;
      }
    }
  }

  // Computes the gradient of each node: a list of the unknowns on which it depends, and the
  // derivatives by these.
  void gradients() const {
    int derivatives = 0, unknowns = 0;  // used so far
    for (int n = 0; n <= tape_.result; ++n) {
      const TapeNode& node = tape_.nodes[n];
      const Lanes* c = tape_.numbers + node.numbers;
      s_.first[n] = derivatives;
      s_.list[n] = unknowns;
      Lanes* d = s_.derivative + derivatives;
      switch (node.kind) {
        case TapeNode::Constant:
          s_.length[n] = 0;
          break;
        case TapeNode::Shifted:
        case TapeNode::Damped:
          s_.first[n] = s_.first[node.a];
          s_.list[n] = s_.list[node.a];
          s_.length[n] = s_.length[node.a];
          continue;
        case TapeNode::Unknown:
          s_.unknown[unknowns++] = node.a;
          s_.length[n] = 1;
          store(*d, constant(1));
          break;
        case TapeNode::Sum:
          unknowns += combine(
              n, d, [](const Number& x) { return x; }, [](const Number& y) { return y; },
              [](const Number& x, const Number& y) { return x + y; });
          break;
        case TapeNode::Difference:
          unknowns += combine(
              n, d, [](const Number& x) { return x; }, [](const Number& y) { return -y; },
              [](const Number& x, const Number& y) { return x - y; });
          break;
        case TapeNode::Negative:
          each(n, d, [](const Number& x) { return -x; });
          break;
        case TapeNode::Scaled:
        case TapeNode::Function: {
          const Number f = load(c[0]);
          each(n, d, [&](const Number& x) { return f * x; });
          break;
        }
        case TapeNode::Product:
        case TapeNode::Choice:
        case TapeNode::Function2: {
          const bool is_product = node.kind == TapeNode::Product;
          const Number f = load(is_product ? tape_.values[node.b] : c[0]),
                       g = load(is_product ? tape_.values[node.a] : c[1]);
          unknowns += combine(
              n, d, [&](const Number& x) { return f * x; }, [&](const Number& y) { return g * y; },
              [&](const Number& x, const Number& y) { return fused(f, x, g * y); });
          break;
        }
      }
      derivatives += s_.length[n];
    }
  }

  void hessian(Lanes* h) const {
    const Number zero = constant(0);
    for (int k = 0; k < tape_.unknowns * (tape_.unknowns + 1) / 2; ++k) store(h[k], zero);
    for (int n = 0; n <= tape_.result; ++n) {
      const TapeNode& node = tape_.nodes[n];
      const Lanes* c = tape_.numbers + node.numbers;
      const Number w = load(s_.adjoint[n]);
      switch (node.kind) {
        case TapeNode::Product:
          if (node.a == node.b)
            add_square(w + w, node.a, h);
          else
            add_pair(w, node.a, node.b, h);
          break;
        case TapeNode::Function:
          add_square(w * load(c[1]), node.a, h);
          break;
        case TapeNode::Function2:
          add_square(w * load(c[2]), node.a, h);
          add_pair(w * load(c[3]), node.a, node.b, h);
          add_square(w * load(c[4]), node.b, h);
          break;
        default:
          break;
      }
    }
  }

 private:
  void add(std::int32_t node, const Number& x) const {
    store(s_.adjoint[node], load(s_.adjoint[node]) + x);
  }

  template <class F>
  void each(int n, Lanes* d, const F& f) const {
    const std::int32_t a = tape_.nodes[n].a;
    const Lanes* x = s_.derivative + s_.first[a];
    s_.list[n] = s_.list[a];
    s_.length[n] = s_.length[a];
    for (int k = 0; k < s_.length[n]; ++k) store(d[k], f(load(x[k])));
  }

  // Returns the length of a new list of unknowns, or 0 if an operand's list can be reused.
  template <class First, class Second, class Both>
  int combine(int n, Lanes* d, const First& first, const Second& second, const Both& both) const {
    const std::int32_t a = tape_.nodes[n].a, b = tape_.nodes[n].b;
    const Lanes *x = s_.derivative + s_.first[a], *y = s_.derivative + s_.first[b];
    const std::int32_t count_a = s_.length[a], count_b = s_.length[b];
    if (s_.list[a] == s_.list[b]) {
      s_.list[n] = s_.list[a];
      s_.length[n] = count_a;
      for (int k = 0; k < count_a; ++k) store(d[k], both(load(x[k]), load(y[k])));
      return 0;
    }
    const std::int32_t *p = s_.unknown + s_.list[a], *q = s_.unknown + s_.list[b];
    std::int32_t* r = s_.unknown + s_.list[n];
    int i = 0, j = 0, k = 0;
    for (; i < count_a || j < count_b; ++k) {
      if (j == count_b || (i < count_a && p[i] < q[j])) {
        r[k] = p[i];
        store(d[k], first(load(x[i++])));
      } else if (i == count_a || q[j] < p[i]) {
        r[k] = q[j];
        store(d[k], second(load(y[j++])));
      } else {
        r[k] = p[i];
        store(d[k], both(load(x[i++]), load(y[j++])));
      }
    }
    s_.length[n] = k;
    return k;
  }

  // Adds w g g^T to h.
  void add_square(const Number& w, std::int32_t node, Lanes* h) const {
    const std::int32_t* list = s_.unknown + s_.list[node];
    const Lanes* g = s_.derivative + s_.first[node];
    for (int i = 0; i < s_.length[node]; ++i) {
      const Number x = w * load(g[i]);
      Lanes* row = h + list[i] * (list[i] + 1) / 2;
      for (int j = 0; j <= i; ++j) add_product(row[list[j]], x, load(g[j]));
    }
  }

  // Adds w (g_a g_b^T + g_b g_a^T) to h.
  void add_pair(const Number& w, std::int32_t a, std::int32_t b, Lanes* h) const {
    const std::int32_t *list_a = s_.unknown + s_.list[a], *list_b = s_.unknown + s_.list[b];
    const Lanes *x = s_.derivative + s_.first[a], *y = s_.derivative + s_.first[b];
    for (int i = 0; i < s_.length[a]; ++i) {
      const Number wx = w * load(x[i]);
      for (int j = 0; j < s_.length[b]; ++j) {
        Lanes& sum = h[entry(list_a[i], list_b[j])];
        const Number product = wx * load(y[j]);
        store(sum, load(sum) + (list_a[i] == list_b[j] ? product + product : product));
      }
    }
  }

  const TapeView& tape_;
  const TapeScratch& s_;
};

void differentiate(const TapeView& tape, const TapeScratch& scratch, Lanes* gradient,
                   Lanes* hessian) {
  const Derivatives derivatives(tape, scratch);
  derivatives.adjoints(gradient);
  if (!hessian) return;
  if (tape.is_damped) derivatives.adjoints(nullptr);
  derivatives.gradients();
  derivatives.hessian(hessian);
}

unsigned indefinite_part(int size, double zero_pivot, Lanes* packed, int part) {
  const auto at = [&](int i, int j) { return packed[i * (i + 1) / 2 + j].data() + part * kWidth; };
  const auto number = [&](int i, int j) { return Batch::load_aligned(at(i, j)); };
  Batch largest(0.0);
  for (int i = 0; i < size; ++i) largest = xsimd::max(number(i, i), largest);
  const Batch zero = Batch(zero_pivot) * largest;
  auto fails = Batch(0.0) != Batch(0.0);
  for (int c = 0; c < size; ++c) {
    const Batch pivot = number(c, c);
    const auto positive = pivot > zero;
    fails = fails | !(pivot >= -zero);  // NaN, too
    const Batch inverse = xsimd::select(positive, Batch(1.0) / pivot, Batch(0.0));
    for (int i = c + 1; i < size; ++i) {
      const Batch x = number(i, c), factor = x * inverse;
      fails = fails | !(positive | (xsimd::abs(x) <= zero));
      for (int j = c + 1; j <= i; ++j)
        xsimd::fnma(factor, number(j, c), number(i, j)).store_aligned(at(i, j));
    }
  }
  bool failed[kWidth];
  fails.store_unaligned(failed);
  unsigned lanes = 0;
  for (int i = 0; i < kWidth; ++i) lanes |= unsigned{failed[i]} << i;
  return lanes;
}

unsigned indefinite(int size, double zero_pivot, Lanes* packed) {
  unsigned lanes = 0;
  for (int part = 0; part < kParts; ++part)
    lanes |= indefinite_part(size, zero_pivot, packed, part) << (part * kWidth);
  return lanes;
}

// Eigenvalues and eigenvectors of symmetric matrices, one a lane of a batch: Householder's
// reflections, then QR steps with Wilkinson's shifts ([GV13] 8.3). In lanes that have converged,
// and in leading blocks that are split off, rotations have the angle 0.
class SymmetricMatrices {
 public:
  // memory: n (n + 3) numbers, of which part `part` is used.
  SymmetricMatrices(int n, Lanes* memory, int part) : n_(n), memory_(memory), part_(part) {}

  void set(int i, int j, const Batch& x) const {
    x.store_aligned(a(i, j));
    x.store_aligned(a(j, i));
  }
  Batch value(int k) const { return get(d(k)); }
  Batch vector(int i, int k) const { return get(a(i, k)); }

  // Decomposes matrices whose entries are at most 1. Returns whether all lanes have converged.
  bool decompose() const {
    reflect();
    collect_reflections();
    constexpr int kMostSteps = 30;  // for an eigenvalue; two are usual
    int steps = 0;
    for (int last = n_ - 1; last > 0;) {
      const Batch begin = split(last);
      if (xsimd::all(begin == Batch(last))) {
        --last;
        continue;
      }
      if (++steps > kMostSteps * n_) return false;
      step(begin, last);
    }
    return true;
  }

 private:
  static Batch get(const double* x) { return Batch::load_aligned(x); }
  double* at(int k) const { return memory_[k].data() + part_ * kWidth; }
  double* a(int i, int j) const { return at(j * n_ + i); }  // later of the eigenvectors
  double* d(int i) const { return at(n_ * n_ + i); }        // the diagonal
  double* e(int i) const { return at(n_ * (n_ + 1) + i); }  // next to the diagonal
  double* w(int i) const { return at(n_ * (n_ + 2) + i); }  // scratch, then factors of reflections

  // Makes the matrix tridiagonal. Column k becomes the vector of its reflection, w(k) the factor.
  void reflect() const {
    constexpr double kNoLength = 1e-290;  // squared: its inverse is finite
    for (int k = 0; k + 2 < n_; ++k) {
      Batch below(0.0);
      for (int i = k + 2; i < n_; ++i) below = xsimd::fma(get(a(i, k)), get(a(i, k)), below);
      const Batch first = get(a(k + 1, k)), norm = xsimd::sqrt(xsimd::fma(first, first, below));
      const Batch image = xsimd::select(first > Batch(0.0), -norm, norm), head = first - image;
      const Batch length = xsimd::fma(head, head, below);
      const auto reflects = (below > Batch(0.0)) & (length > Batch(kNoLength));
      const Batch factor = xsimd::select(reflects, Batch(2.0) / length, Batch(0.0));
      xsimd::select(reflects, image, first).store_aligned(e(k));
      head.store_aligned(a(k + 1, k));
      // A becomes A - v w^T - w v^T with p = factor A v, w = p - factor (p.v) v / 2.
      Batch along(0.0);
      for (int i = k + 1; i < n_; ++i) {
        Batch sum(0.0);
        for (int j = k + 1; j < n_; ++j) sum = xsimd::fma(get(a(i, j)), get(a(j, k)), sum);
        sum *= factor;
        sum.store_aligned(w(i));
        along = xsimd::fma(sum, get(a(i, k)), along);
      }
      along *= Batch(0.5) * factor;
      for (int i = k + 1; i < n_; ++i)
        xsimd::fnma(along, get(a(i, k)), get(w(i))).store_aligned(w(i));
      for (int j = k + 1; j < n_; ++j) {
        const Batch vj = get(a(j, k)), wj = get(w(j));
        for (int i = k + 1; i < n_; ++i)
          xsimd::fnma(get(w(i)), vj, xsimd::fnma(get(a(i, k)), wj, get(a(i, j))))
              .store_aligned(a(i, j));
      }
      factor.store_aligned(w(k));
    }
    for (int i = 0; i < n_; ++i) get(a(i, i)).store_aligned(d(i));
    if (n_ > 1) get(a(n_ - 1, n_ - 2)).store_aligned(e(n_ - 2));
  }

  // Overwrites the vectors of the reflections with their product. The last reflection comes first,
  // so that vector k, in column k, is read before columns 0 to k are written.
  void collect_reflections() const {
    for (int j = n_ > 1 ? n_ - 2 : 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i) Batch(i == j ? 1.0 : 0.0).store_aligned(a(i, j));
    for (int k = n_ - 3; k >= 0; --k) {
      const Batch factor = get(w(k));
      for (int j = k + 1; j < n_; ++j) {
        Batch sum(0.0);
        for (int i = k + 1; i < n_; ++i) sum = xsimd::fma(get(a(i, k)), get(a(i, j)), sum);
        sum *= factor;
        for (int i = k + 1; i < n_; ++i)
          xsimd::fnma(sum, get(a(i, k)), get(a(i, j))).store_aligned(a(i, j));
      }
      for (int i = 0; i < n_; ++i) Batch(i == k ? 1.0 : 0.0).store_aligned(a(i, k));
    }
  }

  // Sets entries that are negligible relative to the diagonal to 0. Returns the first row of the
  // block that ends at `last`.
  Batch split(int last) const {
    constexpr double kRelative = 1.1e-16, kAbsolute = 1e-18;
    Batch begin(0.0);
    for (int i = 0; i < last; ++i) {
      const Batch size = xsimd::abs(get(d(i))) + xsimd::abs(get(d(i + 1)));
      const auto splits =
          xsimd::abs(get(e(i))) <= xsimd::fma(Batch(kRelative), size, Batch(kAbsolute));
      xsimd::select(splits, Batch(0.0), get(e(i))).store_aligned(e(i));
      begin = xsimd::select(splits, Batch(i + 1), begin);
    }
    return begin;
  }

  void step(const Batch& begin, int last) const {
    const Batch zero(0.0), one(1.0), two(2.0);
    const Batch beside = get(e(last - 1)), end = get(d(last));
    const Batch half = (get(d(last - 1)) - end) * Batch(0.5);
    const Batch root = xsimd::sqrt(xsimd::fma(half, half, beside * beside));
    const Batch divisor = half + xsimd::select(half < zero, -root, root);
    const Batch shift = end - xsimd::select(divisor == zero, zero, beside * beside / divisor);
    Batch x(0.0), z(0.0);
    for (int k = 0; k < last; ++k) {
      const auto starts = begin == Batch(k);
      const auto active = (begin <= Batch(k)) & (begin < Batch(last));
      const Batch dk = get(d(k)), dk1 = get(d(k + 1)), ek = get(e(k));
      x = xsimd::select(starts, dk - shift, x);
      z = xsimd::select(starts, ek, z);
      const Batch squared = xsimd::fma(x, x, z * z), r = xsimd::sqrt(squared);
      const auto turns = active & (squared > zero);
      const Batch inverse = one / xsimd::select(turns, r, one);
      const Batch c = xsimd::select(turns, x * inverse, one);
      const Batch s = xsimd::select(turns, z * inverse, zero);
      if (k > 0) xsimd::select(active & !starts, r, get(e(k - 1))).store_aligned(e(k - 1));
      const Batch cc = c * c, ss = s * s, cs = c * s, mixed = two * cs * ek;
      xsimd::fma(cc, dk, xsimd::fma(ss, dk1, mixed)).store_aligned(d(k));
      xsimd::fma(ss, dk, xsimd::fnma(two * cs, ek, cc * dk1)).store_aligned(d(k + 1));
      x = xsimd::fma(cs, dk1 - dk, (cc - ss) * ek);
      x.store_aligned(e(k));
      if (k + 1 < last) {
        z = s * get(e(k + 1));
        (c * get(e(k + 1))).store_aligned(e(k + 1));
      }
      for (int i = 0; i < n_; ++i) {
        const Batch p = get(a(i, k)), q = get(a(i, k + 1));
        xsimd::fma(c, p, s * q).store_aligned(a(i, k));
        xsimd::fnma(s, p, c * q).store_aligned(a(i, k + 1));
      }
    }
  }

  int n_;
  Lanes* memory_;
  int part_;
};

bool clamp_part(int size, double projection_weight, unsigned lanes, Lanes* packed, Lanes* memory,
                int part) {
  const int entries = size * (size + 1) / 2;
  const auto at = [&](int k) { return packed[k].data() + part * kWidth; };
  bool picked[kWidth];
  for (int i = 0; i < kWidth; ++i) picked[i] = lanes >> i & 1;
  const auto clamps = xsimd::batch_bool<double>::load_unaligned(picked);
  Batch largest(0.0), sum(0.0);
  for (int k = 0; k < entries; ++k) {
    const Batch x = xsimd::abs(Batch::load_aligned(at(k)));
    largest = xsimd::max(largest, x);
    sum += x * Batch(0.0);  // NaN if a number is not finite
  }
  const auto finite = sum == Batch(0.0);
  const auto counts = clamps & finite & (largest > Batch(0.0));
  const Batch scale = xsimd::select(counts, largest, Batch(1.0)), inverse = Batch(1.0) / scale;
  const SymmetricMatrices matrices(size, memory, part);
  for (int i = 0, k = 0; i < size; ++i)
    for (int j = 0; j <= i; ++j, ++k)
      matrices.set(i, j, xsimd::select(counts, Batch::load_aligned(at(k)) * inverse, Batch(0.0)));
  if (!matrices.decompose()) return false;
  for (int k = 0; k < entries; ++k)
    xsimd::select(clamps & !finite, Batch(0.0), Batch::load_aligned(at(k))).store_aligned(at(k));
  for (int m = 0; m < size; ++m) {
    const auto negative = counts & (matrices.value(m) < Batch(0.0));
    if (!xsimd::any(negative)) continue;
    const Batch taken =
        xsimd::select(negative, Batch(-projection_weight) * scale * matrices.value(m), Batch(0.0));
    for (int i = 0, k = 0; i < size; ++i) {
      const Batch x = taken * matrices.vector(i, m);
      for (int j = 0; j <= i; ++j, ++k)
        xsimd::fma(x, matrices.vector(j, m), Batch::load_aligned(at(k))).store_aligned(at(k));
    }
  }
  return true;
}

unsigned clamp(int size, double projection_weight, unsigned lanes, Lanes* packed, Lanes* memory) {
  constexpr unsigned kAll = (1u << kWidth) - 1;
  unsigned left = 0;
  for (int part = 0; part < kParts; ++part) {
    const unsigned mine = lanes >> (part * kWidth) & kAll;
    if (mine && !clamp_part(size, projection_weight, mine, packed, memory, part))
      left |= mine << (part * kWidth);
  }
  return left;
}

}  // namespace

extern const TapeKernels MAJORANT_KERNEL_NAME;
const TapeKernels MAJORANT_KERNEL_NAME{MAJORANT_INSTRUCTION_SET, differentiate, indefinite, clamp};

}  // namespace majorant::detail

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
