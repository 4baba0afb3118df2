#include "majorant/parametrization/starts/initial_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "majorant/framework/error.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// The boundary loop that goes to the circle: the longest on the surface.
const std::vector<Index>& outer_loop(const SurfaceMesh& mesh) {
  const auto length = [&](const std::vector<Index>& loop) {
    double sum = 0;
    for (std::size_t k = 0; k < loop.size(); ++k)
      sum += (mesh.positions().row(loop[(k + 1) % loop.size()]) - mesh.positions().row(loop[k]))
                 .norm();
    return sum;
  };
  return *std::max_element(mesh.boundary_loops().begin(), mesh.boundary_loops().end(),
                           [&](const auto& p, const auto& q) { return length(p) < length(q); });
}

void place_boundary(const SurfaceMesh& mesh, Vec& x) {
  const std::vector<Index>& loop = outer_loop(mesh);
  const double radius = std::sqrt(mesh.area() / std::numbers::pi);
  std::vector<double> arc{0.0};
  for (std::size_t k = 0; k < loop.size(); ++k)
    arc.push_back(
        arc.back() +
        (mesh.positions().row(loop[(k + 1) % loop.size()]) - mesh.positions().row(loop[k])).norm());
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const double angle = 2 * std::numbers::pi * arc[k] / arc.back();
    x[2 * loop[k]] = radius * std::cos(angle);
    x[2 * loop[k] + 1] = radius * std::sin(angle);
  }
}

// The graph Laplacian of all vertices but those of the outer loop, whose terms go to the right-hand
// sides. Holes are filled with a vertex joined to their boundaries.
struct Laplacian {
  SparsePattern pattern;
  Vec values, rhs_u, rhs_v;
  std::vector<Index> interior;  // by row

  Laplacian(const SurfaceMesh& mesh, const Vec& x) {
    const std::vector<Index>& outer = outer_loop(mesh);
    const auto holes = static_cast<Index>(mesh.boundary_loops().size()) - 1;
    std::vector<Index> row(at(mesh.vertex_count() + holes), 0);
    for (const Index v : outer) row[at(v)] = -1;
    for (Index v = 0; v < mesh.vertex_count() + holes; ++v)
      if (row[at(v)] == 0) {
        row[at(v)] = static_cast<Index>(interior.size());
        interior.push_back(v);
      }
    std::vector<std::vector<Index>> neighbours(interior.size());
    for (Index f = 0; f < mesh.face_count(); ++f)
      for (int k = 0; k < 3; ++k) {
        const Index a = mesh.faces()(f, k), b = mesh.faces()(f, (k + 1) % 3);
        // Interior edges are met from both faces, edges of a hole from one.
        if (row[at(a)] >= 0) neighbours[at(row[at(a)])].push_back(b);
        if (row[at(b)] >= 0 && mesh.opposite(3 * f + k) < 0)
          neighbours[at(row[at(b)])].push_back(a);
      }
    Index filling = mesh.vertex_count();
    for (const auto& loop : mesh.boundary_loops()) {
      if (&loop == &outer) continue;
      for (const Index v : loop) {
        neighbours[at(row[at(v)])].push_back(filling);
        neighbours[at(row[at(filling)])].push_back(v);
      }
      ++filling;
    }
    const auto n = static_cast<Index>(interior.size());
    rhs_u.setZero(n);
    rhs_v.setZero(n);
    std::vector<double> entries;
    pattern.size = n;
    pattern.column_starts.push_back(0);
    for (Index r = 0; r < n; ++r) {
      auto& around = neighbours[at(r)];
      std::sort(around.begin(), around.end());
      pattern.rows.push_back(r);
      entries.push_back(static_cast<double>(around.size()));
      for (const Index v : around) {
        if (row[at(v)] < 0) {
          rhs_u[r] += x[2 * v];
          rhs_v[r] += x[2 * v + 1];
        } else if (row[at(v)] > r) {
          pattern.rows.push_back(row[at(v)]);
          entries.push_back(-1.0);
        }
      }
      pattern.column_starts.push_back(static_cast<Index>(pattern.rows.size()));
      pattern.block_of.push_back(r);
    }
    values = Eigen::Map<Vec>(entries.data(), static_cast<Index>(entries.size()));
  }
};

}  // namespace

Vec tutte_map(const SurfaceMesh& mesh, const StopCheck& stop) {
  Vec x = Vec::Zero(2 * mesh.vertex_count());
  place_boundary(mesh, x);
  const Laplacian laplacian(mesh, x);
  stop.poll();
  if (laplacian.interior.empty()) return x;
  const auto solver = make_cholmod_solver();
  solver->analyze(laplacian.pattern);
  stop.poll();
  if (solver->factorize(laplacian.values, 0.0) != FactorStatus::Ok)
    throw Error(ErrorKind::Infeasible,
                mesh.file() +
                    ": the Laplacian of the initial map cannot be factorized; check the "
                    "mesh with `majorant info`");
  Vec u, v;
  solver->solve(laplacian.rhs_u, u);
  solver->solve(laplacian.rhs_v, v);
  for (std::size_t r = 0; r < laplacian.interior.size(); ++r) {
    if (laplacian.interior[r] >= mesh.vertex_count()) continue;  // in a hole
    x[2 * laplacian.interior[r]] = u[static_cast<Index>(r)];
    x[2 * laplacian.interior[r] + 1] = v[static_cast<Index>(r)];
  }
  return x;
}

Vec texture_map(const SurfaceMesh& mesh) {
  if (mesh.corner_texcoords().rows() == 0)
    throw Error(ErrorKind::Unsupported,
                mesh.file() + ": not every face corner has texture coordinates; use --init tutte");
  Vec x = Vec::Zero(2 * mesh.vertex_count());
  std::vector<char> seen(at(mesh.vertex_count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Index v = mesh.faces()(f, k);
      const Vector2 uv = mesh.corner_texcoords().row(f).segment<2>(2 * k);
      if (seen[at(v)] && uv != x.segment<2>(2 * v))
        throw Error(ErrorKind::Unsupported,
                    fmt::format("{}: vertex {} has several texture coordinates (a seam); cut the "
                                "mesh there or use --init tutte",
                                mesh.file(), mesh.input_vertex(v) + 1));
      seen[at(v)] = 1;
      x.segment<2>(2 * v) = uv;
    }
  return x;
}

}  // namespace majorant
