#include "majorant/volumes/internal/curved_boundary.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "majorant/elements/bernstein.h"
#include "majorant/volumes/internal/reference_cell.h"

namespace majorant {
namespace {

// Normals at a node whose cosine is above this belong to one smooth surface: 15 degrees. That is
// more than the kinks between curved elements that interpolate a smooth surface, and less than
// edges of models.
constexpr double kSmoothCosine = 0.9659;
// The maximum number of steps of the search for the nearest point; each at least halves its
// distance.
constexpr int kMostSteps = 50;

double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

// Returns the Bernstein polynomial with index k of degree n at t, or its derivative.
double bernstein_value(int n, int k, double t) {
  if (k < 0 || k > n) return 0;
  return factorial(n) / (factorial(k) * factorial(n - k)) * integer_power(t, k) *
         integer_power(1 - t, n - k);
}
double bernstein_derivative(int n, int k, double t) {
  return n * (bernstein_value(n - 1, k - 1, t) - bernstein_value(n - 1, k, t));
}

}  // namespace

void CurvedBoundary::Patch::evaluate(double u, double v, Vector3& at, Vector3& by_u,
                                     Vector3& by_v) const {
  at = by_u = by_v = Vector3::Zero();
  for (std::size_t k = 0; k < control.size(); ++k) {
    const std::array<int, 3>& e = exponents[k];
    if (corners == 2) {
      at += bernstein_value(degree, e[1], u) * control[k];
      by_u += bernstein_derivative(degree, e[1], u) * control[k];
    } else if (corners == 4) {
      const double x = bernstein_value(degree, e[0], u), y = bernstein_value(degree, e[1], v);
      at += x * y * control[k];
      by_u += bernstein_derivative(degree, e[0], u) * y * control[k];
      by_v += x * bernstein_derivative(degree, e[1], v) * control[k];
    } else {
      const double factor =
          factorial(degree) / (factorial(e[0]) * factorial(e[1]) * factorial(e[2]));
      const std::array<double, 3> t{1 - u - v, u, v};
      const auto power = [&](int lowered) {  // the derivative by a coordinate; -1: the value
        double product = factor;
        for (int c = 0; c < 3; ++c) {
          const int n = e[to_size(c)];
          if (c != lowered) product *= integer_power(t[to_size(c)], n);
          if (c == lowered) product *= n == 0 ? 0 : n * integer_power(t[to_size(c)], n - 1);
        }
        return product;
      };
      at += power(-1) * control[k];
      by_u += (power(1) - power(0)) * control[k];
      by_v += (power(2) - power(0)) * control[k];
    }
  }
}

Vector3 CurvedBoundary::Patch::normal(double u, double v) const {
  Vector3 at, by_u, by_v;
  evaluate(u, v, at, by_u, by_v);
  if (corners == 2) by_v = Vector3::UnitZ();
  return by_u.cross(by_v).stableNormalized();
}

std::pair<double, double> CurvedBoundary::Patch::parameters(std::size_t k) const {
  const std::array<int, 3>& e = exponents[k];
  const double n = degree;
  if (corners == 2) return {e[1] / n, 0};
  return corners == 4 ? std::pair(e[0] / n, e[1] / n) : std::pair(e[1] / n, e[2] / n);
}

void CurvedBoundary::Patch::clamp(double& u, double& v) const {
  u = std::clamp(u, 0.0, 1.0);
  v = corners == 2 ? 0 : std::clamp(v, 0.0, 1.0);
  if (corners != 3 || u + v <= 1) return;
  const double over = (u + v - 1) / 2;
  u = std::clamp(u - over, 0.0, 1.0);
  v = 1 - u;
}

CurvedBoundary::Patch CurvedBoundary::patch_of(const VolumeMesh& mesh, const ControlNet& net,
                                               VecIn x, const CellSide& side) const {
  const CellBlock& block = mesh.blocks[to_size(side.name.block)];
  const ReferenceCell::Side& reference = ReferenceCell::of(block.type).sides()[to_size(side.side)];
  Patch patch;
  patch.corners = static_cast<int>(reference.corners.size());
  patch.degree = block.type.degree;
  for (std::size_t k = 0; k < reference.nodes.size(); ++k) {
    // The weights on the corners in their order around the side; their sum is degree^2.
    std::array<int, 4> weights{};
    for (std::size_t c = 0; c < reference.loop.size(); ++c) {
      const auto at =
          std::find(reference.corners.begin(), reference.corners.end(), reference.loop[c]);
      weights[c] = reference.weights[k][static_cast<std::size_t>(at - reference.corners.begin())];
    }
    const int n = patch.degree;
    if (patch.corners == 4)
      patch.exponents.push_back({(weights[1] + weights[2]) / n, (weights[2] + weights[3]) / n, 0});
    else
      patch.exponents.push_back({weights[0] / n, weights[1] / n, weights[2] / n});
    const Index point = net.point_of(block.nodes(side.name.cell, reference.nodes[k]));
    patch.points.push_back(point);
    Vector3 at = Vector3::Zero();
    at.head(net.dim()) = x.segment(net.dim() * point, net.dim());
    patch.control.push_back(at);
  }
  return patch;
}

CurvedBoundary::CurvedBoundary(const VolumeMesh& mesh, const ControlNet& net, VecIn x,
                               const std::vector<CellSide>& boundary,
                               const std::vector<char>& is_curved, const std::vector<int>& regions)
    : patch_of_(to_size(net.count())) {
  struct OfPoint {
    std::vector<Index> patches;
    std::vector<Vector3> normals;
    bool is_held = false;
    int region = 0;
  };
  std::map<Index, OfPoint> of_point;
  for (std::size_t s = 0; s < boundary.size(); ++s) {
    patches_.push_back(patch_of(mesh, net, x, boundary[s]));
    const Patch& patch = patches_.back();
    for (std::size_t k = 0; k < patch.points.size(); ++k) {
      OfPoint& at = of_point[patch.points[k]];
      at.is_held =
          at.is_held || is_curved[s] == 0 || (!at.patches.empty() && at.region != regions[s]);
      at.region = regions[s];
      at.patches.push_back(static_cast<Index>(s));
      const auto [u, v] = patch.parameters(k);
      at.normals.push_back(patch.normal(u, v));
    }
  }
  const auto is_smooth = [](const OfPoint& at) {
    // Sides run counterclockwise as seen from outside; sides between regions as seen from either
    // region.
    return !at.is_held &&
           std::all_of(at.normals.begin(), at.normals.end(), [&](const Vector3& normal) {
             return std::abs(normal.dot(at.normals.front())) >= kSmoothCosine;
           });
  };
  for (const auto& [point, at] : of_point) {
    if (!is_smooth(at)) continue;
    // An edge of a plane mesh without a second edge at the node ends there.
    if (net.dim() == 2 && at.patches.size() == 1) {
      const Patch& patch = patches_[to_size(at.patches[0])];
      const auto k = std::find(patch.points.begin(), patch.points.end(), point);
      const std::array<int, 3>& e =
          patch.exponents[static_cast<std::size_t>(k - patch.points.begin())];
      if (e[0] == 0 || e[1] == 0) continue;
    }
    // The sides of the node, and the sides that meet these in other sliding nodes.
    std::set<Index> around(at.patches.begin(), at.patches.end());
    for (const Index s : at.patches)
      for (const Index other : patches_[to_size(s)].points)
        if (const OfPoint& next = of_point.at(other); is_smooth(next))
          around.insert(next.patches.begin(), next.patches.end());
    patch_of_[to_size(point)].assign(around.begin(), around.end());
    is_empty_ = false;
  }
}

CurvedBoundary::Foot CurvedBoundary::nearest(Index point, const Vector3& at) const {
  double least = std::numeric_limits<double>::infinity();
  Foot best{at, Vector3::UnitX()};
  for (const Index s : patch_of_[to_size(point)]) {
    const Patch& patch = patches_[to_size(s)];
    // Starts from the nearest node, and takes Gauss-Newton and Newton steps inside the side as long
    // as they come nearer.
    double u = 0, v = 0, distance = std::numeric_limits<double>::infinity();
    Vector3 place, by_u, by_v;
    for (std::size_t k = 0; k < patch.points.size(); ++k) {
      const auto [at_u, at_v] = patch.parameters(k);
      patch.evaluate(at_u, at_v, place, by_u, by_v);
      if ((place - at).norm() < distance) {
        distance = (place - at).norm();
        u = at_u;
        v = at_v;
      }
    }
    patch.evaluate(u, v, place, by_u, by_v);
    for (int step = 0; step < kMostSteps; ++step) {
      const Vector3 rest = at - place;
      double du = 0, dv = 0;
      if (patch.corners == 2) {
        du = rest.dot(by_u) / by_u.squaredNorm();
      } else {
        Eigen::Matrix2d normal;
        normal << by_u.squaredNorm(), by_u.dot(by_v), by_u.dot(by_v), by_v.squaredNorm();
        const Vector2 d = normal.inverse() * Vector2(rest.dot(by_u), rest.dot(by_v));
        du = d.x();
        dv = d.y();
      }
      if (!std::isfinite(du) || !std::isfinite(dv)) break;
      bool is_nearer = false;
      for (int halving = 0; halving < 8 && !is_nearer; ++halving, du /= 2, dv /= 2) {
        double next_u = u + du, next_v = v + dv;
        patch.clamp(next_u, next_v);
        Vector3 next, next_by_u, next_by_v;
        patch.evaluate(next_u, next_v, next, next_by_u, next_by_v);
        is_nearer = (next - at).norm() < distance;
        if (!is_nearer) continue;
        distance = (next - at).norm();
        u = next_u;
        v = next_v;
        place = next;
        by_u = next_by_u;
        by_v = next_by_v;
      }
      if (!is_nearer) break;
    }
    if (distance < least) {
      least = distance;
      best = {place, patch.normal(u, v)};
    }
  }
  return best;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
