#include "majorant/pictures/baking/internal/baked_borders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "majorant/framework/parallel.h"
#include "majorant/pictures/baking/internal/position_at.h"

namespace majorant {
namespace {

// Spacing, in texels, of the points of a border at which seams are levelled and closed.
constexpr double kReadingSpacing = 0.25;
// The largest distance, in texels, of what a filter reads at a point of a border: the diagonal of a
// texel, and some stretch. Larger distances mean another part of the surface.
constexpr double kFilterReach = 1.5;
// The largest difference of the values on both sides of a cut, relative to their range. Larger
// differences are seams of the source, which are not levelled.
constexpr double kSourceSeam = 1.0 / 255;

// The values that a filter should read along a half-edge of a border.
struct BorderValues {
  std::vector<FilterReading> readings;
  std::vector<float> values;  // channels interleaved
  std::vector<float> across;  // on the other side of a cut; equal to `values` elsewhere
};

// The filter readings along a cut, and the surface's values there on both sides.
struct CutValues {
  std::vector<SeamReading> seams;
  std::array<std::vector<double>, 2> values;  // channels interleaved
};

// Returns the point of a half-edge at this part of its length from its start.
SurfacePlace along(Index half_edge, double part) {
  SurfacePlace place{face_of(half_edge), Barycentric::Zero()};
  place.barycentric[corner_of(half_edge)] = 1 - part;
  place.barycentric[(corner_of(half_edge) + 1) % 3] = part;
  return place;
}

Vector2 uv_at(const BezierMap& map, Index half_edge, double part) {
  const SurfacePlace place = along(half_edge, part);
  return map.evaluate(place.face, place.barycentric);
}

double texels_along(const TexelGrid& grid, const BezierMap& map, Index half_edge) {
  const Vector2 texels(grid.width(), grid.height());
  double length = 0;
  for (int k = 0; k < kCurvePieces; ++k)
    length += (uv_at(map, half_edge, (k + 1.0) / kCurvePieces) -
               uv_at(map, half_edge, 1.0 * k / kCurvePieces))
                  .cwiseProduct(texels)
                  .norm();
  return length;
}

// Returns a bound of the distance on the surface between points that a filter mixes along a
// half-edge.
double reach_along(const TexelGrid& grid, const BezierMap& map, Index half_edge) {
  const SurfaceMesh& mesh = map.mesh();
  const double of_surface =
      (position_at(mesh, along(half_edge, 1)) - position_at(mesh, along(half_edge, 0))).norm();
  return kFilterReach * of_surface / texels_along(grid, map, half_edge);
}

// Returns the position on the surface that a texel shows.
std::optional<Vector3> position_of(const BakedTexels& baked, const LayoutValues& values,
                                   std::size_t texel) {
  const auto width = to_size(baked.grid.width());
  const std::size_t row = texel / width;
  const std::vector<AroundTexel>& around = baked.around[row / to_size(kBandRows)];
  const auto found =
      std::lower_bound(around.begin(), around.end(), texel,
                       [](const AroundTexel& one, std::size_t t) { return one.texel < t; });
  if (found != around.end() && found->texel == texel) return found->position;
  if (baked.texels[texel] != Texel::Centre) return std::nullopt;
  const auto place = values.place_at(
      baked.grid.center(static_cast<int>(texel % width), static_cast<int>(row)), nullptr);
  if (!place) return std::nullopt;
  return position_at(values.map().mesh(), *place);
}

// Returns whether everything that a filter reads at a point of a border shows the surface nearby,
// or no point of the surface.
bool is_near(const BakedTexels& baked, const LayoutValues& values, const FilterReading& reading,
             const SurfacePlace& place, double reach) {
  const Vector3 position = position_at(values.map().mesh(), place);
  return std::all_of(reading.texels.begin(), reading.texels.end(), [&](std::size_t texel) {
    const auto shown_at = position_of(baked, values, texel);
    return !shown_at || (*shown_at - position).norm() <= reach;
  });
}

bool has_values(const BakedTexels& baked, const FilterReading& reading) {
  return std::all_of(reading.texels.begin(), reading.texels.end(),
                     [&](std::size_t texel) { return has_value(baked.texels[texel]); });
}

// Reads along a cut, from the side of a half-edge.
void read_cut(const BakedTexels& baked, const LayoutValues& values, Index half_edge,
              CutValues& found) {
  const Index other = values.continuation().across(half_edge);
  const double length = std::max(texels_along(baked.grid, values.map(), half_edge),
                                 texels_along(baked.grid, values.map(), other));
  const double reach_here = reach_along(baked.grid, values.map(), half_edge),
               reach_there = reach_along(baked.grid, values.map(), other);
  const int count = static_cast<int>(std::ceil(length / kReadingSpacing));
  ValueScratch scratch(values.channels());
  for (int k = 0; k < count; ++k) {
    const double t = (k + 0.5) / count;
    SeamReading seam;
    seam.length = length / count;
    if (!reading_at(baked.image, uv_at(values.map(), half_edge, t), seam.sides[0]) ||
        !reading_at(baked.image, uv_at(values.map(), other, 1 - t), seam.sides[1]) ||
        !is_near(baked, values, seam.sides[0], along(half_edge, t), reach_here) ||
        !is_near(baked, values, seam.sides[1], along(other, 1 - t), reach_there) ||
        !values.value_at(along(half_edge, t), scratch.value, scratch) ||
        !values.value_at(along(other, 1 - t), scratch.one, scratch))
      continue;
    found.seams.push_back(seam);
    found.values[0].insert(found.values[0].end(), scratch.value.begin(), scratch.value.end());
    found.values[1].insert(found.values[1].end(), scratch.one.begin(), scratch.one.end());
  }
}

// Reads along a half-edge of a border, at the points where everything that a filter reads is near.
void read_border(const BakedTexels& baked, const LayoutValues& values, Index half_edge,
                 BorderValues& found) {
  const Index other = values.continuation().across(half_edge);
  const double length = texels_along(baked.grid, values.map(), half_edge),
               reach = reach_along(baked.grid, values.map(), half_edge);
  const int count = static_cast<int>(std::ceil(length / kReadingSpacing));
  ValueScratch scratch(values.channels());
  for (int k = 0; k < count; ++k) {
    const double t = (k + 0.5) / count;
    const SurfacePlace place = along(half_edge, t);
    FilterReading reading;
    if (!reading_at(baked.image, uv_at(values.map(), half_edge, t), reading) ||
        !has_values(baked, reading) || !is_near(baked, values, reading, place, reach) ||
        !values.value_at(place, scratch.value, scratch))
      continue;
    scratch.one = scratch.value;
    if (other >= 0 && !values.value_at(along(other, 1 - t), scratch.one, scratch)) continue;
    reading.length = length / count;
    found.readings.push_back(reading);
    found.values.insert(found.values.end(), scratch.value.begin(), scratch.value.end());
    found.across.insert(found.across.end(), scratch.one.begin(), scratch.one.end());
  }
}

}  // namespace

void level_borders(const LayoutValues& values, const StopCheck& stop, BakedTexels& baked) {
  std::vector<std::size_t> free;
  for (const std::vector<AroundTexel>& of_band : baked.around)
    for (const AroundTexel& one : of_band) free.push_back(one.texel);
  const std::vector<Index>& opposite = values.map().mesh().opposites();
  std::vector<Index> border;
  for (std::size_t h = 0; h < opposite.size(); ++h)
    if (opposite[h] < 0) border.push_back(static_cast<Index>(h));
  std::vector<BorderValues> found(border.size());
  parallel_tasks(static_cast<Index>(border.size()), [&](Index task, int) {
    stop.poll();
    read_border(baked, values, border[to_size(task)], found[to_size(task)]);
  });
  std::vector<FilterReading> readings;
  std::vector<float> near, across;
  for (const BorderValues& one : found) {
    readings.insert(readings.end(), one.readings.begin(), one.readings.end());
    near.insert(near.end(), one.values.begin(), one.values.end());
    across.insert(across.end(), one.across.begin(), one.across.end());
  }
  found = {};
  const auto count = static_cast<Index>(readings.size());
  using Floats = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Floats> here(near.data(), count, values.channels()),
      there(across.data(), count, values.channels());
  if (count == 0) return;
  const Eigen::RowVectorXf most_apart =
      static_cast<float>(kSourceSeam) * (here.colwise().maxCoeff() - here.colwise().minCoeff());
  std::vector<Index> kept;
  for (Index r = 0; r < count; ++r)
    if (((here.row(r) - there.row(r)).cwiseAbs() - most_apart).maxCoeff() <= 0) kept.push_back(r);
  RowMatrix targets(static_cast<Index>(kept.size()), values.channels());
  std::vector<FilterReading> used;
  for (const Index r : kept) {
    targets.row(static_cast<Index>(used.size())) = here.row(r).cast<double>();
    used.push_back(readings[to_size(r)]);
  }
  level_seams(baked.image, baked.transfer, free, used, targets, stop);
}

void close_cuts(const LayoutValues& values, const StopCheck& stop, BakedTexels& baked) {
  const std::vector<Index>& opposite = values.map().mesh().opposites();
  std::vector<Index> cut;
  for (std::size_t h = 0; h < opposite.size(); ++h)
    if (const auto half_edge = static_cast<Index>(h);
        opposite[h] < 0 && half_edge < values.continuation().across(half_edge))
      cut.push_back(half_edge);
  std::vector<CutValues> found(cut.size());
  parallel_tasks(static_cast<Index>(cut.size()), [&](Index task, int) {
    stop.poll();
    read_cut(baked, values, cut[to_size(task)], found[to_size(task)]);
  });
  std::vector<SeamReading> seams;
  std::array<std::vector<double>, 2> sides;
  for (const CutValues& one : found) {
    seams.insert(seams.end(), one.seams.begin(), one.seams.end());
    for (std::size_t side = 0; side < 2; ++side)
      sides[side].insert(sides[side].end(), one.values[side].begin(), one.values[side].end());
  }
  found = {};
  if (seams.empty()) return;
  std::vector<std::size_t> kept;
  for (const SeamReading& seam : seams)
    for (const FilterReading& side : seam.sides)
      for (const std::size_t texel : side.texels)
        if (baked.texels[texel] == Texel::Centre || baked.texels[texel] == Texel::Miss)
          kept.push_back(texel);
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  const auto rows = static_cast<Index>(seams.size());
  const Eigen::Map<const RowMatrix> here(sides[0].data(), rows, values.channels()),
      there(sides[1].data(), rows, values.channels());
  const Transfer seen = baked.transfer == Transfer::Srgb ? Transfer::Srgb : baked.seen;
  close_seams(baked.image, baked.transfer, seen, kept, seams, here, there, stop);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
