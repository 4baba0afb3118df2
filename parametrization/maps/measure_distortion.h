// What a map does to each face and to the whole surface, in the words of the field.
//
//   const MapDistortion measured = measure_distortion(map);
//   const DistortionSummary all = summary(measured);
//   const double typical = all.angle.percentile[3], stretch = all.stretch_l2;
//
// Quantities at a point are those of distortion.h, integrals those over the surface. Of curved
// faces they are made by Radon's rule on 1, 2^2, 4^2, 8^2 or 16^2 subtriangles, whatever is needed
// for two successive rules to agree; of affine ones they are exact. For reports and pictures, not
// for proofs: a face whose det J is not positive everywhere has an infinite stretch only if a point
// finds it.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "majorant/elements/rest_shapes.h"
#include "majorant/parametrization/maps/bezier_map.h"
#include "majorant/parametrization/maps/distortion.h"

namespace majorant {

// Per face, one column each, named as files have them: means over the face of sigma_1, sigma_2,
// sigma_1 sigma_2 (area of the image over area of the face) and sigma_1 / sigma_2; the root mean
// square of the stretch, L2(T) of [SSGH01]; its largest sampled value, Linf(T). NaN for faces
// without an area.
inline constexpr std::array<std::string_view, 6> kFaceDistortionNames{
    "sigma_1", "sigma_2", "area_distortion", "angle_distortion", "stretch_l2", "stretch_linf"};
using FaceDistortion = Eigen::Matrix<double, Eigen::Dynamic, kFaceDistortionNames.size()>;

struct MapDistortion {
  FaceDistortion faces;  // #F by 6
  Vec area;              // #F, of the faces on the surface; 0 for those that do not count
  // At the 7 points of Radon's rule in each face that counts, at one where the map is affine.
  struct Sample {
    PointDistortion at;
    double weight;  // area that it stands for
  };
  std::vector<Sample> samples;
};

// Control points x, 2 numbers a node, of cells of that degree (#F by (n+1)(n+2)/2, VTK order) on
// faces of these shapes; x is multiplied by `scale`. Cells need not fit together.
MapDistortion measure_distortion(int degree, const Cells& cells, VecIn x, const RestShapes& rest,
                                 double scale);
MapDistortion measure_distortion(const BezierMap& map, double scale = 1);

// The percentiles that are told: those people ask for; for reports alone.
inline constexpr std::array<int, 7> kPercentiles{1, 5, 25, 50, 75, 95, 99};

// How a quantity is spread over the surface, by area.
struct Spread {
  double mean = 0;
  // The smallest value that is exceeded on at most 99, 95, ... % of the area, as kPercentiles.
  std::array<double, kPercentiles.size()> percentile{};
};

struct DistortionSummary {
  // L2(M) = sqrt(sum L2(T)^2 A(T) / sum A(T)) and Linf(M) = max Linf(T) [SSGH01], A the areas of
  // faces on the surface. At the layout's own scale: with equal areas of both, as the authors have
  // it, L2(M) sqrt(area.mean), which is 1 for an isometry and larger for all else.
  double stretch_l2 = 0, stretch_linf = 0;
  Spread sigma_1, sigma_2, area, angle;
};

// Of all parts as one map; all 0 where no face counts.
DistortionSummary summary(const std::vector<const MapDistortion*>& parts);
inline DistortionSummary summary(const MapDistortion& map) { return summary(std::vector{&map}); }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
