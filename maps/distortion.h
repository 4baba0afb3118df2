// The distortion of a map at a point of the surface, of each face, and over the whole surface.
//
//   const PointDistortion d = distortion_of(map.jacobian(12, {0.2, 0.3, 0.5}));
//   const double growth = d.area();   // 2: twice as large in the plane as on the surface
//   const double skew = d.angle();    // 1: conformal
//
// All measures come from the singular values sigma_1 >= sigma_2 of the map J from the surface to
// the plane; for an isometry each measure is 1. Area, sigma_1, sigma_2 and stretch depend on the
// scale of the layout, so J must be multiplied by it first (layout_scale()). Validity is proven,
// not sampled (MapMeasures::min_det).
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "majorant/elements/rest_shapes.h"
#include "majorant/framework/types.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {

struct PointDistortion {
  // Units of the plane per unit of the surface. sigma_2 has the sign of det J: negative where the
  // map inverts the surface; sigma_1 >= |sigma_2|.
  double sigma_1 = 1, sigma_2 = 1;

  // Returns sigma_1 sigma_2 = det J, the area in the plane of a unit of area on the surface.
  double area() const { return sigma_1 * sigma_2; }
  // Returns sigma_1 / sigma_2 >= 1, the aspect ratio of the images of circles; +inf where det J <=
  // 0.
  double angle() const { return over_positive(sigma_1); }
  // Returns sqrt((1 / sigma_1^2 + 1 / sigma_2^2) / 2), the root mean square over all directions of
  // the stretch of a texture on the surface; [SSGH01] Sec. 3 with the singular values Gamma = 1 /
  // sigma_2 and gamma = 1 / sigma_1 of the inverse map. +inf where det J <= 0.
  double stretch_l2() const {
    const double ratio = sigma_2 / sigma_1;
    return over_positive(std::sqrt(0.5 + 0.5 * ratio * ratio));
  }
  // Returns 1 / sigma_2, the stretch in the worst direction; +inf where det J <= 0.
  double stretch_linf() const { return over_positive(1); }

 private:
  double over_positive(double value) const {
    return sigma_2 > 0 ? value / sigma_2 : std::numeric_limits<double>::infinity();
  }
};

// Returns the distortion of J, a 2 by 2 matrix whose columns are the images of an orthonormal frame
// of the surface.
PointDistortion distortion_of(const Eigen::Matrix2d& J);

// The distortion of each face and of the whole surface is measured by integrals over the surface.
//
//   const MapDistortion measured = measure_distortion(map);
//   const DistortionSummary all = summary(measured);
//   const double typical = all.angle.percentile[3], stretch = all.stretch_l2;
//
// Quantities at a point are those of PointDistortion. On affine faces integrals are exact. On
// curved faces they use Radon's rule on 1, 2^2, 4^2, 8^2 or 16^2 subtriangles, until two successive
// rules agree. They are meant for reports and pictures, not for proofs: a face whose det J is not
// positive everywhere has an infinite stretch only if a sample detects it.

// The names of the columns of face values in files. sigma_1, sigma_2, their product (area of the
// image over area of the face) and sigma_1 / sigma_2 are means over the face. The stretch is given
// as its root mean square, L2(T) of [SSGH01], and its largest sampled value, Linf(T). NaN for faces
// without an area.
inline constexpr std::array<std::string_view, 6> kFaceDistortionNames{
    "sigma_1", "sigma_2", "area_distortion", "angle_distortion", "stretch_l2", "stretch_linf"};
using FaceDistortion = Eigen::Matrix<double, Eigen::Dynamic, kFaceDistortionNames.size()>;

struct MapDistortion {
  FaceDistortion faces;  // #F by 6
  Vec area;              // #F, of the faces on the surface; 0 for those that are excluded
  // A sample. Each face that counts has one at the 7 points of Radon's rule; a face of an affine
  // map has one sample.
  struct Sample {
    PointDistortion at;
    double weight;  // the area that it represents
  };
  std::vector<Sample> samples;
};

// Measures cells of that degree (#F by (n+1)(n+2)/2, VTK order) on faces of these shapes. x:
// control points, 2 numbers a node, which are multiplied by `scale`. Cells need not fit together.
MapDistortion measure_distortion(int degree, const Cells& cells, VecIn x, const RestShapes& rest,
                                 double scale);
MapDistortion measure_distortion(const BezierMap& map, double scale = 1);

// The percentiles of reports.
inline constexpr std::array<int, 7> kPercentiles{1, 5, 25, 50, 75, 95, 99};

// The distribution of a quantity over the surface, weighted by area.
struct Spread {
  double mean = 0;
  // The smallest value that is exceeded on at most 99, 95, ... % of the area, parallel to
  // kPercentiles.
  std::array<double, kPercentiles.size()> percentile{};
};

struct DistortionSummary {
  // L2(M) = sqrt(sum L2(T)^2 A(T) / sum A(T)) and Linf(M) = max Linf(T) [SSGH01], where A are the
  // areas of faces on the surface, at the layout's own scale. With equal areas of both, as in
  // [SSGH01], the value is L2(M) sqrt(area.mean), which is 1 for an isometry and larger for all
  // other maps.
  double stretch_l2 = 0, stretch_linf = 0;
  Spread sigma_1, sigma_2, area, angle;
};

// Returns the summary of all parts as one map; all 0 if no face counts.
DistortionSummary summary(const std::vector<const MapDistortion*>& parts);
inline DistortionSummary summary(const MapDistortion& map) { return summary(std::vector{&map}); }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
