#include "density.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "kept.h"
#include "majorant/energies/density.h"
#include "majorant/energies/detail/contraction_kernel.h"

namespace majorant::python {
namespace {

constexpr int kSize = 4, kPacked = 10;  // entries of J (2 by 2), of the lower triangle of H

// What the kernels come by, in the order in which they do: the same in all of them.
struct Points {
  std::vector<double> J;            // #q by 4
  std::vector<double> value, g, H;  // #q, #q by 4, #q by 4 by 4
  mutable std::size_t next = 0;     // point to be answered
  std::size_t count() const { return J.size() / kSize; }
};

// Shared by both: J is its own coordinates.
struct OfJacobian {
  static constexpr int rows = 2, dims = 2, size = kSize;
  static constexpr bool defines(Curvature c) {
    return c == Curvature::Projected || c == Curvature::Exact;
  }
  template <class T>
  static void to_coordinates(const T (&J)[size], T (&z)[size]) {
    for (int r = 0; r < size; ++r) z[r] = J[r];
  }
  template <class T>
  static void gradient_to_jacobian(const T* g, T* out) {
    for (int r = 0; r < size; ++r) out[r] = g[r];
  }
  template <class T>
  static void curvature_to_jacobian(const T* k, T* out) {
    for (int r = 0; r < kPacked; ++r) out[r] = k[r];
  }
};

struct Recorder : OfJacobian {
  Points* points;

  template <class T>
  T value(const T (&z)[kSize]) const {
    double lanes[kSize][T::size];
    for (int r = 0; r < kSize; ++r) z[r].store_unaligned(lanes[r]);
    for (std::size_t lane = 0; lane < T::size; ++lane)
      for (int r = 0; r < kSize; ++r) points->J.push_back(lanes[r][lane]);
    return T(0.0);
  }
  template <Curvature, class T>
  void model(const T (&z)[kSize], double, PointModel<T, kSize>& m) const {
    m.f = value(z);
    for (T& g : m.g) g = T(0.0);
    for (T& k : m.k) k = T(0.0);
  }
};

struct Player : OfJacobian {
  const Points* points;

  template <class T>
  static T lanes_of(const double* first, int step) {
    double lanes[T::size];
    for (std::size_t lane = 0; lane < T::size; ++lane)
      lanes[lane] = first[lane * static_cast<std::size_t>(step)];
    return T::load_unaligned(lanes);
  }
  template <class T>
  T value(const T (&)[kSize]) const {
    const T f = T::load_unaligned(points->value.data() + points->next);
    points->next += T::size;
    return f;
  }
  template <Curvature C, class T>
  void model(const T (&z)[kSize], double clamp, PointModel<T, kSize>& m) const {
    const std::size_t q = points->next;
    m.f = value(z);
    for (int r = 0; r < kSize; ++r) m.g[r] = lanes_of<T>(points->g.data() + q * kSize + r, kSize);
    for (int i = 0, k = 0; i < kSize; ++i)
      for (int j = 0; j <= i; ++j, ++k)
        m.k[k] = lanes_of<T>(points->H.data() + q * kSize * kSize + i * kSize + j, kSize * kSize);
    if constexpr (C != Curvature::Exact) detail::project(clamp, m);
  }
};

using Arch = xsimd::default_arch;
const DensityKernels kRecord = kernel::make_kernels<Arch, Recorder>();
const DensityKernels kPlay = kernel::make_kernels<Arch, Player>();

struct PythonDensity {
  std::shared_ptr<const Kept> density;
  bool needs_positive_determinant;
};

void copy_into(std::vector<double>& out, const py::handle& array, std::size_t count) {
  const auto numbers = py::cast<Doubles>(array);  // of the right size: Density has seen to it
  out.assign(numbers.data(), numbers.data() + count);
}

// Asks Python. Outside of its domain a density is +inf.
void answer(const PythonDensity& density, Points& points, bool models) {
  const py::gil_scoped_acquire lock;
  const std::size_t n = points.count();
  py::array_t<double> J({static_cast<py::ssize_t>(n), py::ssize_t{2}, py::ssize_t{2}},
                        points.J.data());
  const py::handle callee = density.density->get();
  copy_into(points.value, callee.attr("evaluate")(J), n);
  for (std::size_t q = 0; q < n; ++q) {
    const double* j = points.J.data() + q * kSize;
    const bool inside = !density.needs_positive_determinant || j[0] * j[3] - j[1] * j[2] > 0;
    if (!inside || std::isnan(points.value[q]))
      points.value[q] = std::numeric_limits<double>::infinity();
  }
  if (!models) return;
  const py::tuple derivatives = callee.attr("differentiate")(J);
  copy_into(points.g, derivatives[0], n * kSize);
  copy_into(points.H, derivatives[1], n * kSize * kSize);
}

Points recorded(const ContractionView& table, const ChunkView& chunk, double* scratch) {
  Points points;
  Recorder recorder{{}, &points};
  double f[ChunkView::stride];
  kRecord.values(&recorder, table, chunk, scratch, f);
  return points;
}

void values(const void* object, const ContractionView& table, const ChunkView& chunk,
            double* scratch, double* f) {
  Points points = recorded(table, chunk, scratch);
  answer(*static_cast<const PythonDensity*>(object), points, false);
  const Player player{{}, &points};
  kPlay.values(&player, table, chunk, scratch, f);
}

void local(const void* object, const ContractionView& table, const ChunkView& chunk,
           BlendedCurvature curvature, double* scratch, double* f, double* gradient,
           double* hessian) {
  Points points = recorded(table, chunk, scratch);
  answer(*static_cast<const PythonDensity*>(object), points, true);
  const Player player{{}, &points};
  kPlay.local(&player, table, chunk, curvature, scratch, f, gradient, hessian);
}

void star(const void* object, const StarView& view, double vx, double vy, StarModel& out) {
  Points points;
  const Recorder recorder{{}, &points};
  kRecord.star(&recorder, view, vx, vy, out);
  answer(*static_cast<const PythonDensity*>(object), points, true);
  const Player player{{}, &points};
  kPlay.star(&player, view, vx, vy, out);
}

Barrier barrier_named(const std::string& name) {
  if (name == "none") return Barrier::None;
  return name == "strong" ? Barrier::Strong : Barrier::Weak;
}

FreeScale free_scale_named(const std::string& name) {
  if (name == "arbitrary") return FreeScale::Arbitrary;
  return name == "collapses" ? FreeScale::Collapses : FreeScale::Determined;
}

}  // namespace

EnergyFactory python_energy(const py::object& density) {
  DensityTraits traits;
  traits.name = density.attr("name").cast<std::string>();
  traits.curvatures = {Curvature::Projected, Curvature::Exact};
  traits.barrier = barrier_named(density.attr("barrier").cast<std::string>());
  traits.free_scale = free_scale_named(density.attr("free_scale").cast<std::string>());
  const bool positive = density.attr("domain").cast<std::string>() == "positive";
  const auto object = std::make_shared<const PythonDensity>(
      PythonDensity{std::make_shared<const Kept>(density), positive});
  const DensityKernels kernels{2, 2, &values, &local, kPlay.scratch_size, &star};
  return {traits, [=](std::shared_ptr<const ElementSpace> space, const RestShapes& rest,
                      const std::vector<Quadrature>& rules) {
            return std::make_shared<const DensityTerm>(traits, std::move(space), rest, rules,
                                                       object, kernels);
          }};
}

}  // namespace majorant::python
