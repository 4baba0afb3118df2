#include "majorant/parametrization/fields/internal/smoothest_directions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "majorant/parametrization/fields/internal/aligned_edges.h"

namespace majorant {
namespace {

using Complex = std::complex<double>;

constexpr int kSymmetry = 4;
// The shift of inverse iteration as a fraction of 1 / area. It makes the matrix of a flat surface
// definite and is far below the eigenvalues that curvature causes. Chosen, not tuned.
constexpr double kShift = 1e-5;
// Upper bound on inverse iterations. Chosen, not tuned.
constexpr int kMaxIterations = 60;
// The iteration ends if 1 - cosine of two iterates is below this. Angles are then good to its
// square root, and the field is relaxed afterwards.
constexpr double kConverged = 1e-9;
// The amplitude of the noise added to the start, so that it is orthogonal to no eigenvector.
// Chosen, not tuned.
constexpr double kStartNoise = 0.1;

// The energy as a real system in (re, im) of the faces that are not fixed.
class PowerSystem {
 public:
  PowerSystem(const SurfaceMesh& mesh, const FieldGeometry& geometry, const Vec& fixed,
              double mass_weight, const StopCheck& stop)
      : fixed_(fixed),
        mass_(geometry.face_area / mesh.area()),
        row_(to_size(mesh.face_count()), -1) {
    for (Index f = 0; f < mesh.face_count(); ++f)
      if (fixed[f] == kNotAligned) row_[f] = free_++;
    assemble(mesh, geometry, mass_weight, stop);
  }

  bool has_fixed() const { return free_ < static_cast<Index>(row_.size()); }

  // Returns the z of all faces that minimizes the energy with the data term sum (mass_weight) |z -
  // q|^2; fixed faces have their fixed values. data: mass times q.
  std::vector<Complex> solve(const std::vector<Complex>& data) const {
    Vec rhs = rhs_;
    for (std::size_t f = 0; f < row_.size(); ++f)
      if (row_[f] >= 0) rhs.segment<2>(2 * row_[f]) += Vector2(data[f].real(), data[f].imag());
    const Vec x = free_ > 0 ? system_->solve(rhs) : Vec();
    std::vector<Complex> z;
    for (std::size_t f = 0; f < row_.size(); ++f)
      z.push_back(row_[f] >= 0 ? Complex(x[2 * row_[f]], x[2 * row_[f] + 1])
                               : std::polar(1.0, kSymmetry * fixed_[static_cast<Index>(f)]));
    return z;
  }
  const Vec& mass() const { return mass_; }  // #F, sums to 1

 private:
  void assemble(const SurfaceMesh& mesh, const FieldGeometry& geometry, double mass_weight,
                const StopCheck& stop) {
    rhs_ = Vec::Zero(2 * free_);
    std::vector<SparseSpd::Entry> entries;
    for (Index f = 0; f < mesh.face_count(); ++f)
      for (int k = 0; k < 2; ++k)
        if (const Index r = row_[f]; r >= 0)
          entries.push_back({2 * r + k, 2 * r + k, mass_weight * mass_[f]});
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      const Index o = mesh.opposite(h), r = row_[face_of(h)];
      if (o < 0 || r < 0) continue;
      const double w = geometry.weight[h];
      for (int k = 0; k < 2; ++k) entries.push_back({2 * r + k, 2 * r + k, w});
      // The face of h sees the z of its neighbour o / 3 as e^{-4 i transport[h]} z.
      const Complex turn = std::polar(1.0, -kSymmetry * geometry.transport[h]);
      const Index c = row_[face_of(o)];
      if (c < 0) {
        const Complex z = w * turn * std::polar(1.0, kSymmetry * fixed_[face_of(o)]);
        rhs_.segment<2>(2 * r) += Vector2(z.real(), z.imag());
      } else if (c < r) {
        entries.push_back({2 * r, 2 * c, -w * turn.real()});
        entries.push_back({2 * r, 2 * c + 1, w * turn.imag()});
        entries.push_back({2 * r + 1, 2 * c, -w * turn.imag()});
        entries.push_back({2 * r + 1, 2 * c + 1, -w * turn.real()});
      }
    }
    if (free_ > 0) system_ = field_system(2 * free_, 2, entries, Ordering::Amd, stop);
  }

  const Vec& fixed_;
  Vec mass_, rhs_;
  std::vector<Index> row_;
  Index free_ = 0;
  std::optional<SparseSpd> system_;
};

Complex inner(const Vec& mass, const std::vector<Complex>& a, const std::vector<Complex>& b) {
  Complex sum = 0;
  for (std::size_t f = 0; f < a.size(); ++f)
    sum += mass[static_cast<Index>(f)] * std::conj(a[f]) * b[f];
  return sum;
}

std::vector<Complex> times_mass(const Vec& mass, const std::vector<Complex>& z, double factor) {
  std::vector<Complex> out(z);
  for (std::size_t f = 0; f < z.size(); ++f) out[f] *= factor * mass[static_cast<Index>(f)];
  return out;
}

// Returns the curvature directions plus noise that depends on the number of the face only. If
// several fields are equally smooth, as on round spheres, the iteration then finds the one that
// follows curvature.
std::vector<Complex> start_vector(std::vector<Complex> curvature) {
  unsigned state = 1;
  const auto noise = [&] {
    state = state * 1664525u + 1013904223u;  // Numerical Recipes' generator
    return kStartNoise * (static_cast<double>(state >> 8) / double(1 << 24) - 0.5);
  };
  for (Complex& z : curvature) {
    const double re = noise(), im = noise();
    z += Complex(re, im);
  }
  return curvature;
}

// Returns the eigenvector of the smallest eigenvalue, by inverse iteration.
std::vector<Complex> smallest_eigenvector(const PowerSystem& system, std::vector<Complex> z,
                                          const StopCheck& stop) {
  const Vec& mass = system.mass();
  const auto normalize = [&](std::vector<Complex>& x) {
    const double norm = std::sqrt(inner(mass, x, x).real());
    for (Complex& value : x) value /= norm;
  };
  normalize(z);
  for (int k = 0; k < kMaxIterations; ++k) {
    stop.poll();
    std::vector<Complex> next = system.solve(times_mass(mass, z, 1));
    normalize(next);
    const double cosine = std::abs(inner(mass, z, next));
    z = std::move(next);
    if (1 - cosine < kConverged) break;
  }
  return z;
}

}  // namespace

std::vector<Complex> smoothest_directions(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                          const Vec& fixed, const std::vector<Complex>& data,
                                          double pull, const StopCheck& stop) {
  // Masses are fractions of the area and edge weights have no unit, so eigenvalues are in 1 / area.
  const PowerSystem system(mesh, geometry, fixed, std::max(pull, kShift), stop);
  if (pull == 0 && !system.has_fixed())
    return smallest_eigenvector(system, start_vector(data), stop);
  return system.solve(times_mass(system.mass(), data, pull));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
