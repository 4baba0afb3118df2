// Local injectivity: det J > 0 certified on every element ([MC20] Sec. 5), and angle sums at
// vertices ([MC20] Sec. 4.2, method.md N4).
//
// Positive determinants alone permit double covers around a vertex, so LocalInjectivity checks the
// elements and AngleSums the vertices. Along a path of certified maps interior angle sums cannot
// change, so a solve needs AngleSums only for its start. At boundary vertices it is needed in every
// step, since the sum may pass 2 pi continuously. On a cut surface the sums over all copies of a
// vertex count, and the sum at a cone is the cone's angle.
//
//   builder.add(std::make_shared<const LocalInjectivity>(space, 2 * rest.measure));
//   const auto boundary = AngleSums::Vertices::Boundary;
//   builder.add(std::make_shared<const AngleSums>(space, boundary));
//
// For overlaps of the image, see check_boundary() (certify/global_injectivity.h).
#pragma once

#include <memory>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/element_space.h"
#include "majorant/framework/feasibility.h"
#include "majorant/framework/stop_check.h"
#include "majorant/mesh/seams.h"

namespace majorant {

class LocalInjectivity final : public FeasibilityChecker {
 public:
  // Upper bound on the depth; larger values are reduced to it. 2^-63 of a triangle is below the
  // rounding of its coordinates.
  static constexpr int kMaxDepth = 63;
  // rest_det: #E determinants of the rest shapes (their measures over the reference measure), which
  // make margins dimensionless. stop: polled by max_step() alone, which then throws Stopped. Throws
  // InvalidArgument for a wrong number of determinants, one that is not positive and finite, a
  // missing space, or a negative depth. All members throw it for fewer unknowns than the space has;
  // more may follow, such as those of a scaffold.
  LocalInjectivity(std::shared_ptr<const ElementSpace> space, Vec rest_det,
                   int max_depth = ProofDepth::kStart, StopCheck stop = {});

  std::string_view name() const override { return "local injectivity"; }
  // margin: smallest certified det of the map. proven: max_depth + 1 entries.
  Verdict check(VecIn x) const override;
  StepBound max_step(VecIn x, VecIn d, double s) const override;

  int max_depth() const { return max_depth_; }
  // Returns certified lower bounds of det J of the map, by element (<= 0 without a proof).
  Vec lower_bounds(VecIn x) const;

 private:
  Index unknowns() const;
  Vec certify(VecIn x, std::vector<long>* proven) const;

  std::shared_ptr<const ElementSpace> space_;
  Vec rest_det_;
  int max_depth_;
  StopCheck stop_;
};

// Returns the sum of sector angles (radians) at each vertex, between the tangents of the map at the
// corners.
Vec vertex_angle_sums(const BezierTriangleSpace& space, VecIn x);

class AngleSums final : public FeasibilityChecker {
 public:
  enum class Vertices { Interior, Boundary };
  // Tolerance of angle sums, radians: far above rounding, far below the quarter turn by which a
  // wrong sum differs.
  static constexpr double kTolerance = 1e-6;
  // Interior: the sum must be 2 pi, at cones their angle. Boundary: at most 2 pi. Both up to
  // kTolerance. seams: of the cut surface of `space`; null or default: no cuts, no cones.
  AngleSums(std::shared_ptr<const BezierTriangleSpace> space, Vertices which,
            std::shared_ptr<const Seams> seams = nullptr);

  std::string_view name() const override { return "angle sums"; }
  // blocking: vertices, of the uncut surface for Interior, else of the space.
  Verdict check(VecIn x) const override;
  StepBound max_step(VecIn, VecIn, double s) const override { return {s, {}}; }

 private:
  std::shared_ptr<const BezierTriangleSpace> space_;
  Vertices which_;
  std::vector<Index> vertex_of_;    // by vertex of the space: of the uncut surface
  std::vector<int> quarter_turns_;  // by vertex of the uncut surface, 0: boundary
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
