#include "majorant/parametrization/fields/cross_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/fields/internal/cone_optimization.h"
#include "majorant/parametrization/fields/internal/curvature_field.h"
#include "majorant/parametrization/fields/internal/trivial_connection.h"

namespace majorant {
namespace {

using Complex = std::complex<double>;

constexpr int kSymmetry = 4;
constexpr double kNotAligned = 10;  // no angle in (-pi, pi]
// Inverse iteration: the shift as a part of 1 / area, far below the eigenvalues that curvature
// causes; it makes the matrix of a flat surface definite; chosen, not tuned.
constexpr double kShift = 1e-5;
// Of inverse iteration: a bound; chosen, not tuned.
constexpr int kMaxIterations = 60;
// 1 - cosine of two iterates: angles are then good to its square root; the field is relaxed
// afterwards.
constexpr double kConverged = 1e-9;
// Noise added to the start, so that it misses no eigenvector; chosen, not tuned.
constexpr double kStartNoise = 0.1;

// Per face the angle it is fixed to, or kNotAligned.
Vec fixed_angles(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                 const std::vector<char>& aligned) {
  Vec angle = Vec::Constant(mesh.face_count(), kNotAligned);
  if (aligned.empty()) return angle;
  Vec longest = Vec::Zero(mesh.face_count());
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (!aligned[h] && (o < 0 || !aligned[o])) continue;
    const double length =
        (mesh.positions().row(mesh.to_vertex(h)) - mesh.positions().row(mesh.from_vertex(h)))
            .norm();
    if (length <= longest[face_of(h)]) continue;
    longest[face_of(h)] = length;
    angle[face_of(h)] = std::remainder(geometry.edge_direction[h], 4 * kQuarter);
  }
  return angle;
}

// The energy of CrossFieldOptions as a real system in (re, im) of the faces that are not fixed.
class PowerSystem {
 public:
  PowerSystem(const SurfaceMesh& mesh, const FieldGeometry& geometry, const Vec& fixed,
              double mass_weight)
      : fixed_(fixed),
        mass_(geometry.face_area / mesh.area()),
        row_(to_size(mesh.face_count()), -1) {
    for (Index f = 0; f < mesh.face_count(); ++f)
      if (fixed[f] == kNotAligned) row_[f] = free_++;
    assemble(mesh, geometry, mass_weight);
  }

  bool has_fixed() const { return free_ < static_cast<Index>(row_.size()); }

  // z of all faces that minimizes the energy for the data term sum (mass_weight) |z - q|^2; of
  // fixed faces the fixed value. data: mass times q.
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
  void assemble(const SurfaceMesh& mesh, const FieldGeometry& geometry, double mass_weight) {
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
      // z of the neighbour o / 3 as seen from the face of h is e^{-4 i transport[h]} z.
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
    if (free_ > 0) system_ = field_system(2 * free_, 2, entries);
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

// Curvature directions and a little noise that depends on the number of the face only: where
// several fields are equally smooth (round spheres), the one that follows curvature is found.
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

// The eigenvector of the smallest eigenvalue, by inverse iteration.
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

void require_valid(const SurfaceMesh& mesh, const CrossFieldOptions& options) {
  if (!(options.curvature_weight >= 0) || !std::isfinite(options.curvature_weight))
    throw InvalidArgument("smoothest_cross_field: curvature_weight must be >= 0");
  if (!(options.cone_cost >= 0) || !std::isfinite(options.cone_cost))
    throw InvalidArgument("smoothest_cross_field: cone_cost must be >= 0");
  if (!options.aligned.empty() && options.aligned.size() != to_size(mesh.half_edge_count()))
    throw InvalidArgument("smoothest_cross_field: aligned must have 3 #F entries");
}

}  // namespace

CrossField smoothest_cross_field(const SurfaceMesh& mesh, const CrossFieldOptions& options) {
  require_valid(mesh, options);
  const FieldGeometry geometry(mesh);
  const Vec fixed = fixed_angles(mesh, geometry, options.aligned);
  // Masses are parts of the area and edge weights have no unit, so eigenvalues are in 1 / area.
  const double pull = options.curvature_weight * options.curvature_weight;
  const PowerSystem system(mesh, geometry, fixed, std::max(pull, kShift));
  const std::vector<Complex> curvature = principal_directions(mesh, geometry);
  std::vector<Complex> z;
  if (pull > 0 || system.has_fixed())
    z = system.solve(times_mass(system.mass(), curvature, pull));
  else
    z = smallest_eigenvector(system, start_vector(curvature), options.stop);
  Vec angle(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f)
    angle[f] = z[f] == Complex(0) ? 0.0 : std::arg(z[f]) / kSymmetry;
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (fixed[f] != kNotAligned) angle[f] = fixed[f];
  FieldConnection field = nearest_matching(mesh, geometry, angle);
  std::vector<char> is_fixed(to_size(mesh.face_count()), 0);
  Vec hold(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    is_fixed[f] = fixed[f] != kNotAligned;
    hold[f] = is_fixed[f] ? std::numeric_limits<double>::infinity()
                          : pull * system.mass()[f] * std::abs(curvature[f]);
  }
  options.stop.poll();
  optimize_cones(mesh, geometry, is_fixed, field);
  options.stop.poll();
  if (pull == 0 && !system.has_fixed()) {
    lower_cone_energy(mesh, geometry, options.cone_cost, field, options.stop);
    relax_and_round_turning(mesh, geometry, field);
  } else {
    Relaxation(mesh, geometry, hold).apply(field.angle, field.rotation);
  }
  return cross_field(mesh, geometry, field);
}

std::vector<Index> cone_vertices(const CrossField& field) {
  std::vector<Index> cones;
  for (std::size_t v = 0; v < field.quarter_turns.size(); ++v)
    if (field.quarter_turns[v] != 0 && field.quarter_turns[v] != 4)
      cones.push_back(static_cast<Index>(v));
  return cones;
}

void comb(const SurfaceMesh& mesh, const std::vector<char>& is_cut, CrossField& field) {
  if (is_cut.size() != to_size(mesh.half_edge_count()) || field.turns.size() != is_cut.size())
    throw InvalidArgument("comb: is_cut and field.turns must have 3 #F entries");
  const auto turn = [&](Index f, int quarters) {  // the branch of f becomes the one `quarters` on
    field.angle[f] = std::remainder(field.angle[f] + quarters * kQuarter, 4 * kQuarter);
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const Index o = mesh.opposite(h);
      if (o < 0) continue;
      field.turns[h] = (field.turns[h] - quarters + 8) % 4;
      field.turns[o] = (4 - field.turns[h]) % 4;
    }
  };
  std::vector<char> seen(to_size(mesh.face_count()), 0);
  for (Index start = 0; start < mesh.face_count(); ++start) {
    if (seen[start]) continue;
    seen[start] = 1;
    std::vector<Index> queue{start};
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (Index h = 3 * queue[next]; h < 3 * queue[next] + 3; ++h) {
        const Index o = mesh.opposite(h);
        if (o < 0 || is_cut[h] || seen[face_of(o)]) continue;
        seen[face_of(o)] = 1;
        queue.push_back(face_of(o));
        turn(face_of(o), -field.turns[h]);
      }
  }
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) >= 0 && !is_cut[h] && field.turns[h] != 0)
      throw Error(ErrorKind::Usage,
                  fmt::format("{}edge ({}, {}): the field cannot be combed, the cut surface has "
                              "a cone inside or is not simply connected",
                              message_prefix(mesh), user_vertex(mesh, mesh.from_vertex(h)),
                              user_vertex(mesh, mesh.to_vertex(h))));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
