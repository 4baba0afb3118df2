#include "majorant/pictures/baking/bake.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "majorant/framework/parallel.h"
#include "majorant/maps/distortion.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/pictures/baking/seam_levelling.h"
#include "majorant/pictures/baking/texel_grid.h"

namespace majorant {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
// Rows of texels of a task.
constexpr int kRowsOfBand = 16;
// Shares of baking that are done once texels have values, seams are levelled, and gaps filled.
constexpr double kCoveredShare = 0.9, kLevelledShare = 0.94, kFilledShare = 0.97;
// Rows and columns around a piece in which texels have something of it: one for filters, and one
// because row() and column() round.
constexpr int kReach = 2;
// Straight pieces along the edge of a curved face, for what it covers of texels beside its centres:
// chords of 8 leave a 64th of the sagitta.
constexpr int kPiecesOfCurve = 8;
// Texels between the points of a border at which seams are levelled and closed.
constexpr double kBetweenReadings = 0.25;
// What a filter reads at a point of a border lies no farther than the diagonal of a texel, and a
// little for its stretch; beyond is another part of the surface.
constexpr double kReachOfFilter = 1.5;
// By how much of their range the values on both sides of a cut differ at most: else the source has
// a seam there, and what is right is not known.
constexpr double kSeamOfSource = 1.0 / 255;

Vector3 position_at(const SurfaceMesh& mesh, const SurfacePlace& place) {
  Vector3 p = Vector3::Zero();
  for (Index k = 0; k < 3; ++k)
    p += place.barycentric[k] * mesh.input_position(mesh.faces()(place.face, k));
  return p;
}

// A straight piece of a face in the plane.
struct Piece {
  std::array<Vector2, 3> uv;
  Index face;
  int part;  // of the face
};

// The box of the points that a bilinear filter mixes with this texel: of twice its size.
Box2 filtered_box(const TexelGrid& grid, int x, int y) {
  return {grid.point(x - 0.5, y + 1.5), grid.point(x + 1.5, y - 0.5)};
}

// Barycentric coordinates of any point of the plane; not finite where the triangle has no area.
Barycentric coordinates(const std::array<Vector2, 3>& corner, const Vector2& p) {
  const double doubled = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double first = cross(corner[1] - p, corner[2] - p) / doubled;
  const double second = cross(corner[2] - p, corner[0] - p) / doubled;
  return {first, second, 1 - first - second};
}

// The faces as straight pieces, and which of them reach into which band of rows.
class Pieces {
 public:
  Pieces(const BezierMap& map, const TexelGrid& grid) {
    divide(map.degree() == 1 ? 1 : kPiecesOfCurve);
    const Points2 uv = map.sample(points_);
    const auto per_face = static_cast<Index>(points_.size());
    for (Index f = 0; f < map.mesh().face_count(); ++f)
      for (std::size_t part = 0; part < parts_.size(); ++part) {
        Piece piece{{}, f, static_cast<int>(part)};
        for (std::size_t k = 0; k < 3; ++k) piece.uv[k] = uv.row(per_face * f + parts_[part][k]);
        pieces_.push_back(piece);
      }
    sort_into_bands(grid);
  }

  template <class Visit>
  void for_band(int band, const Visit& visit) const {
    for (std::size_t i = first_[to_size(band)]; i < first_[to_size(band) + 1]; ++i)
      visit(pieces_[in_band_[i]]);
  }

  // Of the face, where the barycentric coordinates are those of the piece.
  SurfacePlace place(const Piece& piece, const Barycentric& xi) const {
    SurfacePlace place{piece.face, Barycentric::Zero()};
    for (Index k = 0; k < 3; ++k)
      place.barycentric += xi[k] * points_[to_size(parts_[to_size(piece.part)][to_size(k)])];
    return place;
  }

 private:
  void divide(int n) {
    std::vector<std::vector<Index>> number(to_size(n) + 1);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n - i; ++j) {
        number[to_size(i)].push_back(static_cast<Index>(points_.size()));
        points_.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n,
                             static_cast<double>(n - i - j) / n);
      }
    const auto at = [&](int i, int j) { return number[to_size(i)][to_size(j)]; };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n - i; ++j) {
        parts_.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (j + 1 < n - i) parts_.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }

  void sort_into_bands(const TexelGrid& grid) {
    const int bands = (grid.height() + kRowsOfBand - 1) / kRowsOfBand;
    const auto for_bands_of = [&](const Piece& piece, const auto& visit) {
      const auto [least, most] = std::minmax({piece.uv[0].y(), piece.uv[1].y(), piece.uv[2].y()});
      const int top = std::max(grid.row(most) - kReach, 0);
      const int bottom = std::min(grid.row(least) + kReach, grid.height() - 1);
      for (int b = top / kRowsOfBand; b <= bottom / kRowsOfBand; ++b) visit(to_size(b));
    };
    first_.assign(to_size(bands) + 1, 0);
    for (const Piece& piece : pieces_) for_bands_of(piece, [&](std::size_t b) { ++first_[b + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    in_band_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      for_bands_of(pieces_[i], [&](std::size_t b) { in_band_[next[b]++] = i; });
  }

  std::vector<Barycentric> points_;           // of a face
  std::vector<std::array<Index, 3>> parts_;   // of a face, by points
  std::vector<Piece> pieces_;                 // face by face
  std::vector<std::size_t> first_, in_band_;  // by band
};

// What is found of a texel before it has a value.
struct Covered {
  SurfacePlace place;
  double area = 0;                // of Part: of the piece that covers most
  double distance = 0;            // of Margin: of the nearest piece, squared
  const Piece* beside = nullptr;  // that piece
  Texel texel = Texel::Empty;
};

// The texels of some rows, and one row more above and below, of which the centres alone are known.
class Band {
 public:
  Band(int top, int bottom, int width)
      : top_(top),
        bottom_(bottom),
        width_(width),
        texels_(to_size(bottom - top + 2) * to_size(width)) {}

  Covered& at(int x, int y) {
    return texels_[to_size(y - top_ + 1) * to_size(width_) + to_size(x)];
  }
  // Whether one of the texels around shows its centre in this chart.
  template <class ChartOf>
  bool has_center_beside(int x, int y, Index chart, const ChartOf& chart_of) {
    for (int row = y - 1; row <= y + 1; ++row)
      for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width_ - 1); ++column)
        if (const Covered& texel = at(column, row);
            texel.texel == Texel::Centre && chart_of(texel.place.face) == chart)
          return true;
    return false;
  }
  int top() const { return top_; }
  int bottom() const { return bottom_; }

 private:
  int top_, bottom_, width_;
  std::vector<Covered> texels_;
};

// The one that a texel shows: the first that is proven, where there is one.
SurfacePlace shown(const std::vector<Preimage>& found) {
  const auto proven =
      std::find_if(found.begin(), found.end(), [](const Preimage& p) { return p.proven; });
  const Preimage& one = proven == found.end() ? found.front() : *proven;
  return {one.face, one.barycentric};
}

// Where the surface lies that a texel around a chart shows.
struct Around {
  std::size_t texel;
  Vector3 position;
};

// What a filter should read along a half-edge of a border.
struct BorderValues {
  std::vector<FilterReading> readings;
  std::vector<float> values;  // channels together
  std::vector<float> across;  // those on the other side of a cut; the same beside none
};

// What a filter reads along a cut, and what the surface has there on both sides.
struct CutValues {
  std::vector<SeamReading> seams;
  std::array<std::vector<double>, 2> values;  // channels together
};

// Memory of a task, and the face that its last answer came from.
struct Scratch {
  explicit Scratch(int channels) : value(to_size(channels)), sum(value), one(value) {}
  std::vector<float> value, sum, one;
  Index likely = -1;
  bool is_opposed = false;  // a place of the texel
};

class Baker {
 public:
  Baker(const InverseMap& layout, const BakeOptions& options, const PlaceOf& place_of,
        const SurfaceValues& values)
      : layout_(layout),
        options_(options),
        place_of_(place_of),
        values_(values),
        grid_(options.width, options.height),
        pieces_(layout.map(), grid_),
        continuation_(layout.map().mesh()),
        chart_of_(face_components(layout.map().mesh().opposites())),
        texels_(to_size(options.width) * to_size(options.height), Texel::Empty),
        baked_{{options.width, options.height, values.channels, options.depth}, {}} {
    const Index charts =
        chart_of_.empty() ? 0 : *std::max_element(chart_of_.begin(), chart_of_.end()) + 1;
    around_.resize(to_size((options.height + kRowsOfBand - 1) / kRowsOfBand));
    has_texel_ = std::vector<std::atomic<char>>(to_size(charts));
  }

  BakedImage run(const StopCheck& stop) {
    const int bands = (options_.height + kRowsOfBand - 1) / kRowsOfBand;
    std::vector<BakeCounts> counts(to_size(bands));
    std::atomic<Index> done = 0;
    const StopCheck told = stop.between(0, kCoveredShare);
    parallel_tasks(bands, [&](Index band, int) {
      stop.poll();
      bake_band(static_cast<int>(band), counts[to_size(band)], stop);
      told.advance(to_size(++done), to_size(bands));
    });
    BakeCounts& all = baked_.counts;
    for (const BakeCounts& c : counts) {
      all.covered += c.covered;
      all.doubly_covered += c.doubly_covered;
      all.undecided += c.undecided;
      all.partly += c.partly;
      all.misses += c.misses;
      all.opposed += c.opposed;
    }
    all.texels = static_cast<long>(texels_.size());
    all.charts = static_cast<Index>(has_texel_.size());
    for (const auto& has : has_texel_) all.charts_without_texels += has ? 0 : 1;
    if (has_margin() && options_.samples == 1) level(stop);
    stop.advance(kLevelledShare);
    fill_from_nearest(baked_.image, texels_, options_.padding, stop);
    stop.advance(kFilledShare);
    if (has_margin() && values_.course == Course::Picture) close(stop);
    return std::move(baked_);
  }

 private:
  void bake_band(int index, BakeCounts& counts, const StopCheck& stop) {
    const int top = index * kRowsOfBand;
    Band band(top, std::min(top + kRowsOfBand, options_.height), options_.width);
    find_centers(band, counts, stop);
    pieces_.for_band(index, [&](const Piece& piece) { cover(piece, band); });
    Scratch scratch(values_.channels);
    for (int y = band.top(); y < band.bottom(); ++y) {
      stop.poll();
      for (int x = 0; x < options_.width; ++x) write(x, y, band, counts, scratch);
    }
  }

  void find_centers(Band& band, BakeCounts& counts, const StopCheck& stop) const {
    const int last = std::min(band.bottom(), options_.height - 1);
    for (int y = std::max(band.top() - 1, 0); y <= last; ++y) {
      stop.poll();
      for (int x = 0; x < options_.width; ++x) {
        const std::vector<Preimage> found = layout_.preimages(grid_.center(x, y));
        if (found.empty()) continue;
        Covered& texel = band.at(x, y);
        texel.place = shown(found);
        texel.texel = Texel::Centre;
        if (y < band.top() || y >= band.bottom()) continue;  // counted by another band
        const auto proven =
            std::count_if(found.begin(), found.end(), [](const Preimage& p) { return p.proven; });
        ++counts.covered;
        counts.doubly_covered += proven > 1 ? 1 : 0;
        counts.undecided += proven == 0 ? 1 : 0;
      }
    }
  }

  // Texels of the band that have no centre in a chart and some of this piece, or are filtered with
  // those that have.
  void cover(const Piece& piece, Band& band) const {
    const auto [left, right] = std::minmax({piece.uv[0].x(), piece.uv[1].x(), piece.uv[2].x()});
    const auto [low, high] = std::minmax({piece.uv[0].y(), piece.uv[1].y(), piece.uv[2].y()});
    const int first = std::max(grid_.column(left) - kReach, 0);
    const int last = std::min(grid_.column(right) + kReach, options_.width - 1);
    const int above = std::max(grid_.row(high) - kReach, band.top());
    const int below = std::min(grid_.row(low) + kReach, band.bottom() - 1);
    for (int y = above; y <= below; ++y)
      for (int x = first; x <= last; ++x) {
        Covered& texel = band.at(x, y);
        if (texel.texel == Texel::Centre) continue;
        if (interiors_meet(piece.uv, grid_.box(x, y)))
          cover_part(piece, grid_.box(x, y), texel);
        else if (texel.texel != Texel::Part && has_margin() &&
                 interiors_meet(piece.uv, filtered_box(grid_, x, y)))
          cover_margin(piece, grid_.center(x, y), texel);
      }
  }

  bool has_margin() const { return options_.padding > 0 && values_.course != Course::OfFaces; }

  void cover_part(const Piece& piece, const Box2& box, Covered& texel) const {
    const ClippedTriangle part = clipped(piece.uv, box);
    if (texel.texel == Texel::Part && !(part.area > texel.area)) return;
    texel = {pieces_.place(piece, part.centroid), part.area, 0, &piece, Texel::Part};
  }

  void cover_margin(const Piece& piece, const Vector2& center, Covered& texel) const {
    const auto lifted = [](const Vector2& p) { return Vector3(p.x(), p.y(), 0); };
    const NearestPoint nearest = nearest_of_triangle(lifted(piece.uv[0]), lifted(piece.uv[1]),
                                                     lifted(piece.uv[2]), lifted(center));
    if (texel.texel == Texel::Margin && !(nearest.distance < texel.distance)) return;
    texel = {pieces_.place(piece, nearest.barycentric), 0, nearest.distance, &piece, Texel::Margin};
  }

  void write(int x, int y, Band& band, BakeCounts& counts, Scratch& scratch) {
    const Covered& covered = band.at(x, y);
    Texel texel = covered.texel;
    std::vector<float>& value = scratch.value;
    std::fill(value.begin(), value.end(), values_.background);
    scratch.is_opposed = false;
    const Piece* const beyond = beyond_border(x, y, band);
    if (texel == Texel::Margin && beyond == nullptr) texel = Texel::Empty;
    const bool is_covered = texel == Texel::Centre || texel == Texel::Part;
    if (is_covered) {
      counts.partly += texel == Texel::Part ? 1 : 0;
      has_texel_[to_size(chart_of(covered.place.face))].store(1, std::memory_order_relaxed);
    }
    if (texel != Texel::Empty && !find_value(x, y, covered.place, beyond, scratch)) {
      texel = is_covered ? Texel::Miss : Texel::Empty;
      counts.misses += is_covered ? 1 : 0;
    }
    counts.opposed += is_covered && scratch.is_opposed ? 1 : 0;
    texels_[to_size(y) * to_size(options_.width) + to_size(x)] = texel;
    if (has_margin() && beyond != nullptr && has_value(texel)) remember(x, y, *beyond);
    const bool is_encoded = options_.depth != PixelDepth::Float && has_value(texel);
    for (int c = 0; c < values_.channels; ++c)
      baked_.image.set(x, y, c,
                       is_encoded
                           ? encoded(value[to_size(c)], options_.transfer, c, values_.channels)
                           : value[to_size(c)]);
  }

  Index chart_of(Index face) const { return chart_of_[to_size(face)]; }

  // The piece whose continuation beyond the border of its chart a texel shows; null: it does not,
  // having its centre in a chart, or no centre of its chart around.
  const Piece* beyond_border(int x, int y, Band& band) const {
    const Covered& covered = band.at(x, y);
    if (covered.beside == nullptr || values_.course == Course::OfFaces) return nullptr;
    const bool is_wide = band.has_center_beside(x, y, chart_of(covered.place.face),
                                                [&](Index face) { return chart_of(face); });
    return is_wide ? covered.beside : nullptr;
  }

  void remember(int x, int y, const Piece& beyond) {
    if (const auto place = place_at(grid_.center(x, y), &beyond))
      around_[to_size(y / kRowsOfBand)].push_back(
          {to_size(y) * to_size(options_.width) + to_size(x),
           position_at(layout_.map().mesh(), *place)});
  }

  // Sets what is shown around charts so that a filter reads at their borders what is there.
  void level(const StopCheck& stop) {
    std::vector<std::size_t> free;
    for (const std::vector<Around>& of_band : around_)
      for (const Around& one : of_band) free.push_back(one.texel);
    const std::vector<Index>& opposite = layout_.map().mesh().opposites();
    std::vector<Index> border;
    for (std::size_t h = 0; h < opposite.size(); ++h)
      if (opposite[h] < 0) border.push_back(static_cast<Index>(h));
    std::vector<BorderValues> found(border.size());
    parallel_tasks(static_cast<Index>(border.size()), [&](Index task, int) {
      stop.poll();
      read_border(border[to_size(task)], found[to_size(task)]);
    });
    std::vector<FilterReading> readings;
    std::vector<float> values, across;
    for (const BorderValues& one : found) {
      readings.insert(readings.end(), one.readings.begin(), one.readings.end());
      values.insert(values.end(), one.values.begin(), one.values.end());
      across.insert(across.end(), one.across.begin(), one.across.end());
    }
    found = {};
    const auto count = static_cast<Index>(readings.size());
    using Floats = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Floats> here(values.data(), count, values_.channels),
        there(across.data(), count, values_.channels);
    if (count == 0) return;
    const Eigen::RowVectorXf most_apart =
        static_cast<float>(kSeamOfSource) * (here.colwise().maxCoeff() - here.colwise().minCoeff());
    std::vector<Index> kept;
    for (Index r = 0; r < count; ++r)
      if (((here.row(r) - there.row(r)).cwiseAbs() - most_apart).maxCoeff() <= 0) kept.push_back(r);
    RowMatrix targets(static_cast<Index>(kept.size()), values_.channels);
    std::vector<FilterReading> used;
    for (const Index r : kept) {
      targets.row(static_cast<Index>(used.size())) = here.row(r).cast<double>();
      used.push_back(readings[to_size(r)]);
    }
    level_seams(baked_.image, options_.transfer, free, used, targets, stop);
  }

  // The point of a half-edge that is this part of it from its start.
  static SurfacePlace along(Index half_edge, double part) {
    SurfacePlace place{face_of(half_edge), Barycentric::Zero()};
    place.barycentric[corner_of(half_edge)] = 1 - part;
    place.barycentric[(corner_of(half_edge) + 1) % 3] = part;
    return place;
  }
  Vector2 uv_at(Index half_edge, double part) const {
    const SurfacePlace place = along(half_edge, part);
    return layout_.map().evaluate(place.face, place.barycentric);
  }
  double texels_along(Index half_edge) const {
    const Vector2 texels(options_.width, options_.height);
    double length = 0;
    for (int k = 0; k < kPiecesOfCurve; ++k)
      length += (uv_at(half_edge, (k + 1.0) / kPiecesOfCurve) -
                 uv_at(half_edge, 1.0 * k / kPiecesOfCurve))
                    .cwiseProduct(texels)
                    .norm();
    return length;
  }

  // Moves what is shown at cuts so that a filter reads the same on both sides.
  void close(const StopCheck& stop) {
    const std::vector<Index>& opposite = layout_.map().mesh().opposites();
    std::vector<Index> cut;
    for (std::size_t h = 0; h < opposite.size(); ++h)
      if (const auto half_edge = static_cast<Index>(h);
          opposite[h] < 0 && half_edge < continuation_.across(half_edge))
        cut.push_back(half_edge);
    std::vector<CutValues> found(cut.size());
    parallel_tasks(static_cast<Index>(cut.size()), [&](Index task, int) {
      stop.poll();
      read_cut(cut[to_size(task)], found[to_size(task)]);
    });
    std::vector<SeamReading> seams;
    std::array<std::vector<double>, 2> values;
    for (const CutValues& one : found) {
      seams.insert(seams.end(), one.seams.begin(), one.seams.end());
      for (std::size_t side = 0; side < 2; ++side)
        values[side].insert(values[side].end(), one.values[side].begin(), one.values[side].end());
    }
    found = {};
    if (seams.empty()) return;
    std::vector<std::size_t> kept;
    for (const SeamReading& seam : seams)
      for (const FilterReading& side : seam.sides)
        for (const std::size_t texel : side.texels)
          if (texels_[texel] == Texel::Centre || texels_[texel] == Texel::Miss)
            kept.push_back(texel);
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    const auto rows = static_cast<Index>(seams.size());
    const Eigen::Map<const RowMatrix> here(values[0].data(), rows, values_.channels),
        there(values[1].data(), rows, values_.channels);
    const Transfer seen = options_.transfer == Transfer::Srgb ? Transfer::Srgb : values_.seen;
    close_seams(baked_.image, options_.transfer, seen, kept, seams, here, there, stop);
  }

  // Along a cut, from the side of a half-edge.
  void read_cut(Index half_edge, CutValues& found) const {
    const Index other = continuation_.across(half_edge);
    const double length = std::max(texels_along(half_edge), texels_along(other));
    const double reach_here = reach_along(half_edge), reach_there = reach_along(other);
    const int count = static_cast<int>(std::ceil(length / kBetweenReadings));
    Scratch scratch(values_.channels);
    for (int k = 0; k < count; ++k) {
      const double t = (k + 0.5) / count;
      SeamReading seam;
      seam.length = length / count;
      if (!reading_at(baked_.image, uv_at(half_edge, t), seam.sides[0]) ||
          !reading_at(baked_.image, uv_at(other, 1 - t), seam.sides[1]) ||
          !is_near(seam.sides[0], along(half_edge, t), reach_here) ||
          !is_near(seam.sides[1], along(other, 1 - t), reach_there) ||
          !value_at(along(half_edge, t), scratch.value, scratch) ||
          !value_at(along(other, 1 - t), scratch.one, scratch))
        continue;
      found.seams.push_back(seam);
      found.values[0].insert(found.values[0].end(), scratch.value.begin(), scratch.value.end());
      found.values[1].insert(found.values[1].end(), scratch.one.begin(), scratch.one.end());
    }
  }

  // Along a half-edge of a border: the points at which all that a filter reads is near.
  void read_border(Index half_edge, BorderValues& found) const {
    const Index other = continuation_.across(half_edge);
    const double length = texels_along(half_edge), reach = reach_along(half_edge);
    const int count = static_cast<int>(std::ceil(length / kBetweenReadings));
    Scratch scratch(values_.channels);
    for (int k = 0; k < count; ++k) {
      const double t = (k + 0.5) / count;
      const SurfacePlace place = along(half_edge, t);
      FilterReading reading;
      if (!reading_at(baked_.image, uv_at(half_edge, t), reading) || !has_values(reading) ||
          !is_near(reading, place, reach) || !value_at(place, scratch.value, scratch))
        continue;
      scratch.one = scratch.value;
      if (other >= 0 && !value_at(along(other, 1 - t), scratch.one, scratch)) continue;
      reading.length = length / count;
      found.readings.push_back(reading);
      found.values.insert(found.values.end(), scratch.value.begin(), scratch.value.end());
      found.across.insert(found.across.end(), scratch.one.begin(), scratch.one.end());
    }
  }

  // By how far what is read along a half-edge lies apart on the surface at most.
  double reach_along(Index half_edge) const {
    const SurfaceMesh& mesh = layout_.map().mesh();
    const double of_surface =
        (position_at(mesh, along(half_edge, 1)) - position_at(mesh, along(half_edge, 0))).norm();
    return kReachOfFilter * of_surface / texels_along(half_edge);
  }

  // Whether all that is read at a point of a border shows the surface near it, as far as it shows
  // any point of the surface.
  bool is_near(const FilterReading& reading, const SurfacePlace& place, double reach) const {
    const Vector3 position = position_at(layout_.map().mesh(), place);
    return std::all_of(reading.texels.begin(), reading.texels.end(), [&](std::size_t texel) {
      const auto shown_at = position_of(texel);
      return !shown_at || (*shown_at - position).norm() <= reach;
    });
  }

  bool has_values(const FilterReading& reading) const {
    return std::all_of(reading.texels.begin(), reading.texels.end(),
                       [&](std::size_t texel) { return has_value(texels_[texel]); });
  }

  // Where the surface lies that a texel shows.
  std::optional<Vector3> position_of(std::size_t texel) const {
    const auto width = to_size(options_.width);
    const std::size_t row = texel / width;
    const std::vector<Around>& around = around_[row / to_size(kRowsOfBand)];
    const auto found =
        std::lower_bound(around.begin(), around.end(), texel,
                         [](const Around& one, std::size_t t) { return one.texel < t; });
    if (found != around.end() && found->texel == texel) return found->position;
    if (texels_[texel] != Texel::Centre) return std::nullopt;
    const auto place =
        place_at(grid_.center(static_cast<int>(texel % width), static_cast<int>(row)), nullptr);
    if (!place) return std::nullopt;
    return position_at(layout_.map().mesh(), *place);
  }

  // The point of the surface at this point of the layout, or of a piece that is continued there;
  // none where no chart has it.
  std::optional<SurfacePlace> place_at(const Vector2& uv, const Piece* continued) const {
    if (continued == nullptr) {
      const std::vector<Preimage> found = layout_.preimages(uv);
      return found.empty() ? std::nullopt : std::optional(shown(found));
    }
    const Barycentric xi = coordinates(continued->uv, uv);
    if (!xi.allFinite()) return std::nullopt;
    return continuation_.at(pieces_.place(*continued, xi));
  }

  // False where nothing is known. The mean of the samples that lie in charts, or in what is
  // continued, where there are some.
  bool find_value(int x, int y, const SurfacePlace& place, const Piece* continued,
                  Scratch& scratch) const {
    const int n = options_.samples;
    std::vector<float>& sum = scratch.sum;
    std::fill(sum.begin(), sum.end(), 0.0F);
    int known = 0;
    for (int i = 0; (n > 1 || continued != nullptr) && i < n * n; ++i) {
      const double across = (i % n + 0.5) / n, down = (i / n + 0.5) / n;
      const auto sampled = place_at(grid_.point(x + across, y + down), continued);
      if (!sampled || !value_at(*sampled, scratch.one, scratch)) continue;
      ++known;
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += scratch.one[c];
    }
    if (known == 0) return value_at(place, scratch.value, scratch);
    for (std::size_t c = 0; c < sum.size(); ++c)
      scratch.value[c] = sum[c] / static_cast<float>(known);
    return true;
  }

  // False, and value as it was, where nothing is known.
  bool value_at(const SurfacePlace& place, std::vector<float>& value, Scratch& scratch) const {
    const std::optional<CarrierPlace> carrier = place_of_(place, scratch.likely);
    if (!carrier) return false;
    scratch.likely = carrier->face;
    scratch.is_opposed = scratch.is_opposed || carrier->is_opposed;
    values_.at(*carrier, value.data());
    return true;
  }

  const InverseMap& layout_;
  const BakeOptions& options_;
  const PlaceOf& place_of_;
  const SurfaceValues& values_;
  TexelGrid grid_;
  Pieces pieces_;
  ChartContinuation continuation_;
  std::vector<Index> chart_of_;  // by face
  std::vector<Texel> texels_;
  std::vector<std::vector<Around>> around_;   // by band, ascending
  std::vector<std::atomic<char>> has_texel_;  // by chart
  BakedImage baked_;
};

void write_vector(const Vector3& v, float* value) {
  for (Index k = 0; k < 3; ++k) value[k] = static_cast<float>(v[k]);
}

}  // namespace

namespace {

// The faces of `carrier` that are the polygons of another mesh of the same file.
class SamePolygons {
 public:
  SamePolygons(const SurfaceMesh& surface, const SurfaceMesh& carrier)
      : surface_(surface), carrier_(carrier) {
    const Vector3 extent =
        (carrier.positions().colwise().maxCoeff() - carrier.positions().colwise().minCoeff())
            .transpose();
    tolerance_ = kTenDigits * extent.norm();
    for (Index f = 0; f < carrier.face_count(); ++f) faces_of_[carrier.input_face(f)].push_back(f);
    for (Index f = 0; f < surface.face_count(); ++f) ++count_of_[surface.input_face(f)];
    same_.resize(to_size(surface.face_count()));
  }

  // False where a face of the surface is not in the carrier.
  bool find() {
    for (Index f = 0; f < surface_.face_count(); ++f)
      if (!find(f)) return false;
    return true;
  }

  SurfacePlace place(const SurfacePlace& of) const {
    const Same& match = same_[to_size(of.face)];
    if (match.face < 0) return nearest(of);
    SurfacePlace place{match.face, Barycentric::Zero()};
    for (Index k = 0; k < 3; ++k) place.barycentric[match.corner[to_size(k)]] += of.barycentric[k];
    return place;
  }

 private:
  struct Same {
    Index face = -1;                    // -1: the polygon is cut into other triangles
    std::array<Index, 3> corner = {0};  // of it, by those of the face of the surface
  };

  bool find(Index f) {
    const auto faces = faces_of_.find(surface_.input_face(f));
    if (faces == faces_of_.end()) return false;
    for (const Index other : faces->second)
      if (matches(f, other, same_[to_size(f)])) return true;
    same_[to_size(f)].face = -1;
    if (static_cast<Index>(faces->second.size()) != count_of_[surface_.input_face(f)]) return false;
    for (Index k = 0; k < 3; ++k)
      if (std::none_of(faces->second.begin(), faces->second.end(),
                       [&](Index other) { return corner_of(f, k, other) >= 0; }))
        return false;
    return true;
  }

  bool matches(Index f, Index other, Same& match) const {
    match.face = other;
    for (Index k = 0; k < 3; ++k) {
      match.corner[to_size(k)] = corner_of(f, k, other);
      if (match.corner[to_size(k)] < 0) return false;
    }
    return true;
  }

  // The corner of a face of the carrier that corner k of a face of the surface is; -1: none.
  Index corner_of(Index f, Index k, Index other) const {
    const Index v = surface_.faces()(f, k);
    for (Index l = 0; l < 3; ++l) {
      const Index w = carrier_.faces()(other, l);
      if (surface_.input_vertex(v) == carrier_.input_vertex(w) &&
          (surface_.input_position(v) - carrier_.input_position(w)).norm() <= tolerance_)
        return l;
    }
    return -1;
  }

  SurfacePlace nearest(const SurfacePlace& of) const {
    const Vector3 p = position_at(surface_, of);
    NearestPoint best;
    best.distance = std::numeric_limits<double>::infinity();
    for (const Index f : faces_of_.at(surface_.input_face(of.face))) {
      const auto corner = [&](Index k) { return carrier_.input_position(carrier_.faces()(f, k)); };
      NearestPoint found = nearest_of_triangle(corner(0), corner(1), corner(2), p);
      found.face = f;
      if (found.distance < best.distance) best = found;
    }
    return {best.face, best.barycentric};
  }

  const SurfaceMesh& surface_;
  const SurfaceMesh& carrier_;
  double tolerance_ = 0;
  std::unordered_map<Index, std::vector<Index>> faces_of_;  // of the carrier, by polygon
  std::unordered_map<Index, Index> count_of_;               // of the surface, by polygon
  std::vector<Same> same_;                                  // by face of the surface
};

}  // namespace

std::optional<PlaceOf> same_places(const SurfaceMesh& surface, const SurfaceMesh& carrier) {
  const auto same = std::make_shared<SamePolygons>(surface, carrier);
  if (!same->find()) return std::nullopt;
  return [same](const SurfacePlace& of, Index) {
    return std::optional(CarrierPlace{same->place(of), false});
  };
}

namespace {

// Normals of a surface, interpolated between means around its vertices, by angle. Copies of a
// vertex along cuts have one normal, so that both sides of a cut look the same way.
class InterpolatedNormals {
 public:
  explicit InterpolatedNormals(const SurfaceMesh& mesh) : mesh_(mesh), flat_(mesh.face_count(), 3) {
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Index input = mesh.input_vertex(v);
      first_copy_.push_back(input >= 0 ? mesh.find_input_vertex(input) : v);
    }
    const Index vertices = mesh.vertex_count();
    at_vertex_ = Points3::Zero(vertices, 3);
    Vec weights = Vec::Zero(vertices);
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const auto p = [&](Index k) -> Vector3 { return mesh.positions().row(mesh.faces()(f, k)); };
      const Vector3 normal = (p(1) - p(0)).cross(p(2) - p(0)).stableNormalized();
      flat_.row(f) = normal;
      for (Index k = 0; k < 3; ++k) {
        const Vector3 a = p((k + 1) % 3) - p(k), b = p((k + 2) % 3) - p(k);
        const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
        const Index v = first_copy_[to_size(mesh.faces()(f, k))];
        at_vertex_.row(v) += angle * normal;
        weights[v] += angle;
      }
    }
    for (Index v = 0; v < vertices; ++v)
      if (weights[v] > 0) at_vertex_.row(v) /= weights[v];
  }

  // The normal, of length 1, or 0 where the surface has none there: that of the flat face where
  // normals around cancel out, or lead along it.
  Vector3 at(const SurfacePlace& place) const {
    Vector3 normal = Vector3::Zero();
    for (Index k = 0; k < 3; ++k)
      normal += place.barycentric[k] *
                at_vertex_.row(first_copy_[to_size(mesh_.faces()(place.face, k))]).transpose();
    const Vector3 flat = flat_.row(place.face);
    constexpr double kLeast = 0.1;
    if (flat.isZero(0)) return normal.norm() > kLeast ? Vector3(normal.normalized()) : flat;
    return normal.dot(flat) > kLeast ? Vector3(normal.normalized()) : flat;
  }

 private:
  const SurfaceMesh& mesh_;
  std::vector<Index> first_copy_;  // by vertex: of its copies along cuts the first one
  Points3 flat_, at_vertex_;
};

}  // namespace

Sense sense_of(const SurfaceMesh& surface, const SurfaceTree& tree, double distance) {
  constexpr Index kSamples = 2000;
  const Index step = std::max(Index{1}, surface.face_count() / kSamples);
  double agreeing = 0;
  for (Index f = 0; f < surface.face_count(); f += step) {
    const auto p = [&](Index k) { return surface.input_position(surface.faces()(f, k)); };
    const Vector3 doubled = (p(1) - p(0)).cross(p(2) - p(0));
    const NearestPoint nearest = tree.nearest((p(0) + p(1) + p(2)) / 3);
    if (!(nearest.distance <= distance)) continue;
    agreeing += doubled.dot(tree.doubled_normal(nearest.face).stableNormalized());
  }
  return agreeing < 0 ? Sense::Reversed : Sense::Equal;
}

PlaceOf nearest_places(const SurfaceMesh& surface, const SurfaceTree& tree, double distance,
                       Sense sense) {
  const auto normals = std::make_shared<const InterpolatedNormals>(surface);
  const double sign = sense == Sense::Equal ? 1 : -1;
  return [&surface, &tree, distance, sign, normals](const SurfacePlace& of,
                                                    Index likely) -> std::optional<CarrierPlace> {
    constexpr double kFartherAlong = 2;
    const Vector3 p = position_at(surface, of), normal = sign * normals->at(of);
    const NearestPoint facing = tree.nearest_facing(p, normal, distance, likely);
    if (facing.face >= 0) {
      const NearestPoint along = tree.along(p, normal, kFartherAlong * facing.distance);
      const NearestPoint& found = along.face >= 0 && along.distance <= distance ? along : facing;
      return CarrierPlace{{found.face, found.barycentric}, false};
    }
    const NearestPoint nearest = tree.nearest(p, likely);
    if (!(nearest.distance <= distance)) return std::nullopt;
    const bool is_opposed = tree.doubled_normal(nearest.face).dot(normal) < 0;
    return CarrierPlace{{nearest.face, nearest.barycentric}, is_opposed};
  };
}

SurfaceValues position_values(const SurfaceMesh& mesh) {
  return {3,
          [&mesh](const SurfacePlace& place, float* value) {
            write_vector(position_at(mesh, place), value);
          },
          kNothing};
}

SurfaceValues normal_values(const SurfaceMesh& mesh) {
  return {3,
          [&mesh](const SurfacePlace& place, float* value) {
            const auto p = [&](Index k) -> Vector3 {
              return mesh.positions().row(mesh.faces()(place.face, k));
            };
            write_vector((p(1) - p(0)).cross(p(2) - p(0)).stableNormalized(), value);
          },
          0, Course::OfFaces};
}

SurfaceValues normal_values(Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor> corners) {
  const auto kept = std::make_shared<const decltype(corners)>(std::move(corners));
  return {3,
          [kept](const SurfacePlace& place, float* value) {
            Vector3 normal = Vector3::Zero();
            for (Index k = 0; k < 3; ++k)
              normal += place.barycentric[k] * kept->row(place.face).segment<3>(3 * k).transpose();
            write_vector(normal.stableNormalized(), value);
          },
          0};
}

SurfaceValues face_values(const SurfaceMesh& mesh) {
  return {1,
          [&mesh](const SurfacePlace& place, float* value) {
            *value = static_cast<float>(mesh.input_face(place.face));
          },
          -1, Course::OfFaces};
}

SurfaceValues table_of_faces(RowMatrix rows) {
  const auto kept = std::make_shared<const RowMatrix>(std::move(rows));
  return {static_cast<int>(kept->cols()),
          [kept](const SurfacePlace& place, float* value) {
            for (Index c = 0; c < kept->cols(); ++c)
              value[c] = static_cast<float>((*kept)(place.face, c));
          },
          kNothing, Course::OfFaces};
}

SurfaceValues table_of_vertices(const SurfaceMesh& mesh, RowMatrix rows) {
  const auto kept = std::make_shared<const RowMatrix>(std::move(rows));
  return {static_cast<int>(kept->cols()),
          [&mesh, kept](const SurfacePlace& place, float* value) {
            for (Index c = 0; c < kept->cols(); ++c) {
              double sum = 0;
              for (Index k = 0; k < 3; ++k)
                sum += place.barycentric[k] * (*kept)(mesh.faces()(place.face, k), c);
              value[c] = static_cast<float>(sum);
            }
          },
          kNothing};
}

SurfaceValues table_of_corners(RowMatrix rows) {
  const auto kept = std::make_shared<const RowMatrix>(std::move(rows));
  return {static_cast<int>(kept->cols()),
          [kept](const SurfacePlace& place, float* value) {
            for (Index c = 0; c < kept->cols(); ++c) {
              double sum = 0;
              for (Index k = 0; k < 3; ++k)
                sum += place.barycentric[k] * (*kept)(3 * place.face + k, c);
              value[c] = static_cast<float>(sum);
            }
          },
          kNothing};
}

SurfaceValues color_values(RowMatrix corners) {
  SurfaceValues values = table_of_corners(std::move(corners));
  values.background = 0;
  values.seen = Transfer::Srgb;
  return values;
}

SurfaceValues texture_values(const BezierMap& layout, const Raster& image, Transfer transfer,
                             Filter filter, const Wraps& wraps) {
  const auto decoder = std::make_shared<const ColorDecoder>(image, transfer);
  return {image.channels(),
          [&layout, &image, decoder, filter, wraps](const SurfacePlace& place, float* value) {
            sample(image, *decoder, layout.evaluate(place.face, place.barycentric), filter, value,
                   wraps);
          },
          0, filter == Filter::Nearest ? Course::OfFaces : Course::Picture, transfer};
}

bool is_in_unit_square(const BezierMap& map) {
  return map.control_points().minCoeff() >= 0 && map.control_points().maxCoeff() <= 1;
}

BakedImage bake(const InverseMap& layout, const BakeOptions& options, const PlaceOf& place_of,
                const SurfaceValues& values, const StopCheck& stop) {
  return Baker(layout, options, place_of, values).run(stop);
}

TexelDensity texel_density(const BezierMap& map, int width, int height) {
  const MapDistortion measured = measure_distortion(map);
  const auto area_column = std::distance(
      kFaceDistortionNames.begin(),
      std::find(kFaceDistortionNames.begin(), kFaceDistortionNames.end(), "area_distortion"));
  const double texels = static_cast<double>(width) * height;
  TexelDensity density{std::numeric_limits<double>::infinity(), 0, 0};
  double area = 0;
  for (Index f = 0; f < measured.area.size(); ++f) {
    const double here = std::sqrt(std::abs(measured.faces(f, area_column)) * texels);
    if (!(measured.area[f] > 0) || !std::isfinite(here)) continue;
    density.min = std::min(density.min, here);
    density.max = std::max(density.max, here);
    density.mean += measured.area[f] * here;
    area += measured.area[f];
  }
  if (!(area > 0)) return {};
  density.mean /= area;
  return density;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
