#include "majorant/certify/inverse_map.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "majorant/elements/bernstein.h"
#include "majorant/framework/error.h"
#include "majorant/framework/exact_integers.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/rounding.h"
#include "majorant/mesh/box_tree.h"
#include "majorant/mesh/exact_predicates.h"

namespace majorant {

// A straight face in one cache line.
struct alignas(64) StraightFace {
  std::array<Vector2, 3> corner;
  Index face = -1;
  int sense = 0;  // sign of its area; 0: no area
};

// The faces in the order of a tree of their boxes.
struct PlacesOfFaces {
  BoxTree<2> tree;
  std::vector<StraightFace> straight;  // empty for curved maps
};

namespace {

constexpr int kMaxControlPoints = control_point_count(BezierTriangleSpace::kMaxDegree);
// The bound c of |I - A J| for the projected iteration. For c < 1/2, if its fixed point differs
// from the solution by s, the distance from the piece exceeds c |s| / (1 - c). Slightly smaller,
// for rounding.
constexpr double kContraction = 0.49;
// The largest number of bisections of a face. Where det J > 0 fewer suffice; so many leave 2^-15 of
// each edge.
constexpr int kDeepestBisection = 30;
// Steps of the iteration: Newton steps first, then steps that contract by kContraction or more, to
// the last digit.
constexpr int kNewtonSteps = 8, kMaxSteps = 72;
// A multiple of the rounding error of A f. Points that lie this far outside of a piece still count
// as points on its edge, since uv is rounded.
constexpr double kBeyond = 8;
// A part of the size of a piece, far above rounding. If all its control points are this far beyond
// a line through uv, there is no preimage, not even on an edge. Chosen, not tuned.
constexpr double kClear = 1e-9;
// Points of a task of locate().
constexpr Index kPointsOfTask = 512;
// Bits of a coordinate in the grid that orders points, and bits of a digit of the radix sort.
constexpr int kGridBits = 11;
constexpr std::uint32_t kGridCells = 1U << kGridBits;

// A point of a face that the map takes to uv, with the error of its coordinates.
struct Found {
  Preimage preimage;
  double radius;

  bool is_zero(int corner) const { return preimage.barycentric[corner] <= radius; }
};

Eigen::Matrix2d columns(const Vector2& a, const Vector2& b) {
  Eigen::Matrix2d m;
  m << a, b;
  return m;
}

// Returns the nearest point of the triangle t >= 0, t0 + t1 <= 1.
Vector2 projected(const Vector2& t) {
  const Vector2 on_axes[] = {{std::clamp(t[0], 0.0, 1.0), 0}, {0, std::clamp(t[1], 0.0, 1.0)}};
  if (t[0] >= 0 && t[1] >= 0 && t[0] + t[1] <= 1) return t;
  const double s = std::clamp((1 + t[0] - t[1]) / 2, 0.0, 1.0);
  Vector2 nearest(s, 1 - s);
  for (const Vector2& p : on_axes)
    if ((p - t).squaredNorm() < (nearest - t).squaredNorm()) nearest = p;
  return nearest;
}

// A part of a face: its control points minus uv.
class MapPiece {
 public:
  MapPiece(const BezierMap& map, Index face, const Vector2& uv) : degree_(map.degree()) {
    const TriangleIndices& indices = TriangleIndices::of_degree(degree_);
    const auto points = map.control_uv();
    const auto nodes = map.space().cells().row(face);
    for (int local = 0; local < indices.count(); ++local) {
      const auto [i, j, k] = indices.multi(local);
      at(i, j) = points.row(nodes[local]).transpose() - uv;
    }
    corners_.setIdentity();
  }

  // Returns two halves, cut from the middle of the first edge to the opposite corner. The next cut
  // of each half goes to the new corner (newest vertex bisection), which preserves shapes.
  std::array<MapPiece, 2> halves() const {
    std::array<MapPiece, 2> half{MapPiece(degree_), MapPiece(degree_)};
    for (int k = 0; k <= degree_; ++k) {
      const int m = degree_ - k;
      std::array<Vector2, BezierTriangleSpace::kMaxDegree + 1> row;  // from corner 0 to corner 1
      for (int j = 0; j <= m; ++j) row[j] = at(m - j, j);
      for (int l = 0; l <= m; ++l) {
        // The half with corners (2, 0, middle) has k, m - l, l; that with (1, 2, middle) has m - l,
        // k, l.
        half[0].at(k, m - l) = row[0];
        half[1].at(m - l, k) = row[m - l];
        for (int j = 0; j < m - l; ++j) row[j] = (row[j] + row[j + 1]) / 2;
      }
    }
    const Barycentric middle = (corners_.col(0) + corners_.col(1)) / 2;
    half[0].corners_ << corners_.col(2), corners_.col(0), middle;
    half[1].corners_ << corners_.col(1), corners_.col(2), middle;
    return half;
  }

  // Returns whether the control points surround the origin, as far as their box and the lines along
  // the chords of their sides show.
  bool may_reach_origin() const {
    const int count = control_point_count(degree_);
    Vector2 low = points_[0], high = points_[0];
    for (int p = 1; p < count; ++p) {
      low = low.cwiseMin(points_[p]);
      high = high.cwiseMax(points_[p]);
    }
    if (!((low.array() <= 0).all() && (high.array() >= 0).all())) return false;
    const double clear = kClear * (high - low).maxCoeff();
    const std::array<Vector2, 3> corner{at(degree_, 0), at(0, degree_), at(0, 0)};
    for (int k = 0; k < 3; ++k) {
      const Vector2 side = corner[(k + 1) % 3] - corner[k], inward(-side.y(), side.x());
      double least = inward.dot(points_[0]);
      for (int p = 1; p < count; ++p) least = std::min(least, inward.dot(points_[p]));
      if (least > clear * inward.lpNorm<1>()) return false;
    }
    return true;
  }

  enum class Outcome { None, One, Cut };
  // Decides whether the piece has a preimage of uv, or returns that it must be halved.
  Outcome solve(Found& found) const {
    const Eigen::Matrix2d straight = derivative_at({1.0 / 3, 1.0 / 3}).second.inverse();
    const double c = straight.allFinite() ? deviation(straight) : 1;
    if (!(c < kContraction)) return Outcome::Cut;
    double largest = 0;
    for (int p = 0; p < control_point_count(degree_); ++p)
      largest = std::max(largest, points_[p].norm());
    // The error of A f: averages of de Casteljau, the difference to uv, and the product.
    const double rounding = straight.norm() * kUnitRoundoff<double> * (8 * degree_ + 16) * largest;
    Vector2 t(1.0 / 3, 1.0 / 3);
    for (int step = 0; step < kMaxSteps; ++step) {
      const auto [value, jacobian] = derivative_at(t);
      const Vector2 s = -(straight * value);
      const double distance = s.norm() + rounding;
      if ((projected(t + s) - (t + s)).norm() > c / (1 - c) * distance + kBeyond * rounding)
        return Outcome::None;
      if (s.norm() <= 2 * kBeyond * rounding) {
        found = located(t, distance / (1 - c));
        return Outcome::One;
      }
      const Vector2 newton = -(jacobian.inverse() * value);
      t = projected(step < kNewtonSteps && newton.allFinite() ? t + newton : t + s);
    }
    return Outcome::Cut;
  }

  // Returns the place of the piece as an undecided preimage.
  Found undecided() const {
    Found found = located({1.0 / 3, 1.0 / 3}, 0);
    found.preimage.proven = false;
    return found;
  }

 private:
  explicit MapPiece(int degree) : degree_(degree) {}

  // Rows have equal i; the first row of degree n has n + 1 points.
  int place(int i, int j) const { return i * (degree_ + 1) - i * (i - 1) / 2 + j; }
  Vector2& at(int i, int j) { return points_[place(i, j)]; }
  const Vector2& at(int i, int j) const { return points_[place(i, j)]; }

  // Returns the map minus uv, and its derivatives by t0 and t1, at barycentric coordinates t0, t1,
  // 1 - t0 - t1 of the piece.
  std::pair<Vector2, Eigen::Matrix2d> derivative_at(const Vector2& t) const {
    const double last = 1 - t[0] - t[1];
    std::array<Vector2, kMaxControlPoints> p;
    std::copy_n(points_.begin(), control_point_count(degree_), p.begin());
    // Works in place; points of degree m stay in the rows of the whole degree.
    for (int m = degree_ - 1; m >= 1; --m)
      for (int i = 0; i <= m; ++i)
        for (int j = 0; j <= m - i; ++j)
          p[place(i, j)] =
              t[0] * p[place(i + 1, j)] + t[1] * p[place(i, j + 1)] + last * p[place(i, j)];
    const Vector2 &a = p[place(1, 0)], &b = p[place(0, 1)], &o = p[place(0, 0)];
    return {t[0] * a + t[1] * b + last * o, degree_ * columns(a - o, b - o)};
  }

  // Returns a bound of |I - A J| on the piece. J is a convex combination of differences of control
  // points.
  double deviation(const Eigen::Matrix2d& straight) const {
    double largest = 0;
    for (int i = 0; i < degree_; ++i)
      for (int j = 0; j < degree_ - i; ++j) {
        const Eigen::Matrix2d d =
            degree_ * columns(at(i + 1, j) - at(i, j), at(i, j + 1) - at(i, j));
        largest = std::max(largest, (Eigen::Matrix2d::Identity() - straight * d).norm());
      }
    return largest;
  }

  Found located(const Vector2& t, double radius) const {
    Found found;
    found.radius = 2 * radius + 8 * kUnitRoundoff<double>;
    Barycentric& xi = found.preimage.barycentric;
    xi = (corners_ * Barycentric(t[0], t[1], 1 - t[0] - t[1])).cwiseMax(0.0);
    xi /= xi.sum();
    found.preimage.on_edge = xi.minCoeff() <= found.radius;
    return found;
  }

  int degree_;
  std::array<Vector2, kMaxControlPoints> points_;
  Eigen::Matrix3d corners_;  // one column for each corner: barycentric coordinates of the face
};

// Appends all preimages in the piece. Two pieces may find the same one on their common edge.
void append_of_piece(const MapPiece& piece, int depth, std::vector<Found>& found) {
  if (!piece.may_reach_origin()) return;
  Found one;
  const MapPiece::Outcome outcome = piece.solve(one);
  if (outcome == MapPiece::Outcome::None) return;
  if (outcome == MapPiece::Outcome::Cut && depth < kDeepestBisection) {
    for (const MapPiece& half : piece.halves()) append_of_piece(half, depth + 1, found);
    return;
  }
  if (outcome == MapPiece::Outcome::Cut) one = piece.undecided();
  for (const Found& other : found)
    if ((other.preimage.barycentric - one.preimage.barycentric).norm() <= other.radius + one.radius)
      return;
  found.push_back(one);
}

// A multiple of the rounding bound of a weight. Larger weights have at least nine correct digits.
constexpr double kManyDigits = 0x1p30;

// Returns the barycentric coordinates of a point in a triangle with an area, even a sliver:
// quotients of exact integers, rounded.
Barycentric exact_coordinates(const std::array<Vector2, 3>& corner, const Vector2& uv) {
  using BigInteger = boost::multiprecision::cpp_int;
  const auto x =
      to_integers<BigInteger>(std::array{corner[0].x(), corner[0].y(), corner[1].x(), corner[1].y(),
                                         corner[2].x(), corner[2].y(), uv.x(), uv.y()});
  std::array<BigInteger, 3> weight;
  BigInteger sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = 2 * ((k + 1) % 3), b = 2 * ((k + 2) % 3);
    weight[k] = (x[a] - x[6]) * (x[b + 1] - x[7]) - (x[a + 1] - x[7]) * (x[b] - x[6]);
    sum += weight[k];
  }
  constexpr unsigned kBits = 62;
  Barycentric coordinates;
  for (std::size_t k = 0; k < 3; ++k)
    coordinates[static_cast<Index>(k)] =
        std::ldexp(BigInteger(weight[k] * (BigInteger(1) << kBits) / sum).convert_to<double>(),
                   -static_cast<int>(kBits));
  return coordinates / coordinates.sum();
}

// Appends preimages exactly, for triangles of either orientation.
void append_of_triangle(const StraightFace& triangle, const Vector2& uv,
                        std::vector<Found>& found) {
  const auto& [corner, face, sense] = triangle;
  Found one{{face}, 0};
  std::array<double, 3> weight{};
  bool is_rough = false;
  for (int k = 0; k < 3; ++k) {
    const Vector2 &a = corner[(k + 1) % 3], &b = corner[(k + 2) % 3];
    if (sense == 0) {
      if (!on_segment(a, b, uv)) continue;
      one.preimage.proven = false;  // a triangle without area
      weight = {1, 1, 1};
      break;
    }
    const int side = sense * orientation(a, b, uv);
    if (side < 0) return;
    if (side == 0) {
      one.preimage.on_edge = true;
      continue;
    }
    const Vector2 p = a - uv, q = b - uv;
    const double left = p.x() * q.y(), right = p.y() * q.x();
    weight[k] = sense * (left - right);
    is_rough = is_rough || !(weight[k] > kManyDigits * orientation_error(left, right));
  }
  if (is_rough) {
    one.preimage.barycentric = exact_coordinates(corner, uv);
    found.push_back(one);
    return;
  }
  const double sum = weight[0] + weight[1] + weight[2];
  if (!(sum > 0)) return;
  for (int k = 0; k < 3; ++k) one.preimage.barycentric[k] = weight[k] / sum;
  found.push_back(one);
}

// Appends the same preimages. It decides in floating point unless a weight is within its rounding
// bound, which is rare.
void append_of_face(const StraightFace& triangle, const Vector2& uv, std::vector<Found>& found) {
  const Vector2 a = triangle.corner[0] - uv, b = triangle.corner[1] - uv,
                c = triangle.corner[2] - uv;
  const std::array<double, 3> left{b.x() * c.y(), c.x() * a.y(), a.x() * b.y()};
  const std::array<double, 3> right{b.y() * c.x(), c.y() * a.x(), a.y() * b.x()};
  std::array<double, 3> weight;
  int inside = static_cast<int>(triangle.sense != 0), outside = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double error = orientation_error(left[k], right[k]);
    weight[k] = triangle.sense * (left[k] - right[k]);
    outside |= static_cast<int>(weight[k] < -error);
    inside &= static_cast<int>(weight[k] > kManyDigits * error);
  }
  if (outside != 0) return;
  if (inside == 0) return append_of_triangle(triangle, uv, found);
  const double sum = weight[0] + weight[1] + weight[2];
  found.push_back({{triangle.face, Barycentric(weight[0], weight[1], weight[2]) / sum}, 0});
}

std::vector<Box2> boxes_of(const BezierMap& map) {
  const auto points = map.control_uv();
  const Cells& cells = map.space().cells();
  std::vector<Box2> boxes;
  boxes.reserve(static_cast<std::size_t>(cells.rows()));
  for (Index f = 0; f < cells.rows(); ++f) {
    Box2 box{points.row(cells(f, 0)), points.row(cells(f, 0))};
    for (const Index node : cells.row(f)) {
      if (!points.row(node).allFinite())
        throw InvalidArgument(fmt::format("InverseMap: control point {} is not finite", node));
      box.low = box.low.cwiseMin(points.row(node).transpose());
      box.high = box.high.cwiseMax(points.row(node).transpose());
    }
    boxes.push_back(box);
  }
  return boxes;
}

std::shared_ptr<const PlacesOfFaces> places_of_faces(const BezierMap& map) {
  const auto places = std::make_shared<PlacesOfFaces>(PlacesOfFaces{BoxTree<2>(boxes_of(map)), {}});
  if (map.degree() > 1) return places;
  const auto points = map.control_uv();
  places->straight.resize(to_size(places->tree.size()));
  for (Index place = 0; place < places->tree.size(); ++place) {
    StraightFace& one = places->straight[to_size(place)];
    one.face = places->tree.box_at(place);
    for (Index k = 0; k < 3; ++k)
      one.corner[to_size(k)] = points.row(map.space().cells()(one.face, k));
    one.sense = orientation(one.corner[0], one.corner[1], one.corner[2]);
  }
  return places;
}

// Returns whether both are one point of the surface, on an edge or at a vertex that their faces
// share.
bool is_same_point(const SurfaceMesh& mesh, const Found& a, const Found& b) {
  if (!a.preimage.on_edge || !b.preimage.on_edge || a.preimage.face == b.preimage.face)
    return false;
  const double reach = a.radius + b.radius + 16 * kUnitRoundoff<double>;
  for (int k = 0; k < 3; ++k) {
    if (!a.is_zero((k + 2) % 3)) continue;
    if (a.is_zero(k) || a.is_zero((k + 1) % 3)) {  // a vertex
      const Index vertex = mesh.faces()(a.preimage.face, a.is_zero(k) ? (k + 1) % 3 : k);
      for (int l = 0; l < 3; ++l)
        if (mesh.faces()(b.preimage.face, l) == vertex && b.is_zero((l + 1) % 3) &&
            b.is_zero((l + 2) % 3))
          return true;
    }
    const Index across = mesh.opposite(3 * a.preimage.face + k);
    if (across < 0 || face_of(across) != b.preimage.face) continue;
    if (std::abs(a.preimage.barycentric[k] - b.preimage.barycentric[corner_of(next(across))]) <=
        reach)
      return true;
  }
  return false;
}

bool is_on_border(const SurfaceMesh& mesh, const Found& p) {
  for (int k = 0; k < 3; ++k)
    if (p.is_zero((k + 2) % 3) && mesh.opposite(3 * p.preimage.face + k) < 0) return true;
  return false;
}

// A search for the preimages of many points, which reuses its memory.
class PreimageSearch {
 public:
  PreimageSearch(const BezierMap& map, const PlacesOfFaces& places) : map_(map), places_(places) {}

  // Returns preimages by ascending faces, shared points once. Valid until the next call.
  const std::vector<Found>& preimages(const Vector2& uv) {
    candidates_.clear();
    found_.clear();
    if (!uv.allFinite()) return found_;
    if (map_.degree() == 1)
      places_.tree.visit_places_meeting({uv, uv}, [&](Index place) {
        append_of_face(places_.straight[to_size(place)], uv, candidates_);
      });
    else
      places_.tree.visit_meeting({uv, uv}, [&](Index face) { solve(face, uv); });
    if (candidates_.size() < 2) return candidates_;
    std::stable_sort(candidates_.begin(), candidates_.end(), [](const Found& a, const Found& b) {
      return a.preimage.face < b.preimage.face;
    });
    for (const Found& one : candidates_)
      if (std::none_of(found_.begin(), found_.end(),
                       [&](const Found& other) { return is_same_point(map_.mesh(), one, other); }))
        found_.push_back(one);
    return found_;
  }

 private:
  void solve(Index face, const Vector2& uv) {
    of_face_.clear();
    append_of_piece(MapPiece(map_, face, uv), 0, of_face_);
    for (Found& one : of_face_) {
      one.preimage.face = face;
      candidates_.push_back(one);
    }
  }

  const BezierMap& map_;
  const PlacesOfFaces& places_;
  std::vector<Found> of_face_, candidates_, found_;
};

// Returns the bits of a coordinate at even places.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 8) & 0x00ff00ffU;
  x = (x | x << 4) & 0x0f0f0f0fU;
  x = (x | x << 2) & 0x33333333U;
  return (x | x << 1) & 0x55555555U;
}

// Returns the cell of a grid over the box, numbered along Lebesgue's curve (Morton order); 0 if uv
// is not finite.
std::uint32_t cell_on_curve(const Vector2& uv, const Box2& box) {
  std::uint32_t cell = 0;
  for (Index k = 0; k < 2; ++k) {
    const double place = (uv[k] - box.low[k]) / (box.high[k] - box.low[k]) * kGridCells;
    if (place > 0)
      cell |= spread(static_cast<std::uint32_t>(std::min(place, kGridCells - 1.0))) << k;
  }
  return cell;
}

// Returns an order of the rows in which neighbours are near each other. The boxes and faces around
// a point are then in the cache for the next one; random points among many faces would wait for
// memory.
std::vector<Index> near_after_near(const Points2& uv, const Box2& box) {
  const auto count = static_cast<std::size_t>(uv.rows());
  std::vector<Index> order(count), sorted(count);
  std::vector<std::uint32_t> cell(count);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t k = 0; k < count; ++k) cell[k] = cell_on_curve(uv.row(k), box);
  for (const int shift : {0, kGridBits}) {  // radix sort by digits, the last one first
    const auto digit = [&](Index k) { return cell[to_size(k)] >> shift & (kGridCells - 1); };
    std::vector<std::size_t> begin(kGridCells + 1, 0);
    for (const Index k : order) ++begin[digit(k) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const Index k : order) sorted[begin[digit(k)]++] = k;
    order.swap(sorted);
  }
  return order;
}

std::span<const Index> rows_of_task(const std::vector<Index>& order, Index task) {
  const std::size_t first = to_size(task) * to_size(kPointsOfTask);
  return std::span(order).subspan(first, std::min(order.size() - first, to_size(kPointsOfTask)));
}

// Gathers all rows at once, which overlaps memory accesses.
Points2 rows_of(const Points2& uv, std::span<const Index> rows) {
  Points2 gathered(static_cast<Index>(rows.size()), 2);
  for (std::size_t i = 0; i < rows.size(); ++i)
    gathered.row(static_cast<Index>(i)) = uv.row(rows[i]);
  return gathered;
}

Index task_count(Index points) { return (points + kPointsOfTask - 1) / kPointsOfTask; }

// Calls take(task, row, preimages) for all points, on all threads; in order within a task.
template <class Take>
void search_all(const BezierMap& map, const PlacesOfFaces& places, const Points2& uv,
                const std::vector<Index>& order, const StopCheck& stop, const Take& take) {
  parallel_tasks(task_count(static_cast<Index>(uv.rows())), [&](Index task, int) {
    stop.poll();
    PreimageSearch search(map, places);
    const std::span<const Index> rows = rows_of_task(order, task);
    const Points2 gathered = rows_of(uv, rows);
    for (std::size_t i = 0; i < rows.size(); ++i)
      take(task, rows[i], search.preimages(gathered.row(static_cast<Index>(i))));
  });
}

Box2 layout_box(const BezierMap& map) {
  const auto points = map.control_uv();
  return {points.colwise().minCoeff(), points.colwise().maxCoeff()};
}

}  // namespace

InverseMap::InverseMap(BezierMap map) : map_(std::move(map)), places_(places_of_faces(map_)) {}

std::vector<Preimage> InverseMap::preimages(const Vector2& uv) const {
  std::vector<Preimage> result;
  PreimageSearch search(map_, *places_);
  for (const Found& one : search.preimages(uv)) result.push_back(one.preimage);
  return result;
}

InverseMap::Points InverseMap::locate(const Points2& uv, const StopCheck& stop) const {
  Points points;
  const auto count = static_cast<Index>(uv.rows());
  points.face.assign(to_size(count), -1);
  points.barycentric.resize(count, 3);
  std::vector<char> undecided(to_size(count), 0);  // not bits: tasks write neighbours concurrently
  const auto take = [&](Index, Index k, const std::vector<Found>& found) {
    if (found.empty()) {
      points.barycentric.row(k).setZero();
      return;
    }
    const Found& first = found.front();
    points.face[to_size(k)] = first.preimage.face;
    points.barycentric.row(k) = first.preimage.barycentric;
    undecided[to_size(k)] = !first.preimage.proven || (map_.degree() > 1 && found.size() == 1 &&
                                                       is_on_border(map_.mesh(), first));
  };
  search_all(map_, *places_, uv, near_after_near(uv, layout_box(map_)), stop, take);
  points.is_undecided.assign(undecided.begin(), undecided.end());
  return points;
}

InverseMap::Lists InverseMap::locate_all(const Points2& uv, const StopCheck& stop) const {
  const auto count = static_cast<Index>(uv.rows());
  const Index tasks = task_count(count);
  std::vector<std::vector<Preimage>> of_task(to_size(tasks));
  Lists lists;
  lists.begin.assign(to_size(count) + 1, 0);
  const std::vector<Index> order = near_after_near(uv, layout_box(map_));
  const auto take = [&](Index task, Index k, const std::vector<Found>& found) {
    lists.begin[to_size(k) + 1] = static_cast<Index>(found.size());
    for (const Found& one : found) of_task[to_size(task)].push_back(one.preimage);
  };
  search_all(map_, *places_, uv, order, stop, take);
  std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
  lists.preimages.resize(to_size(lists.begin.back()));
  for (Index task = 0; task < tasks; ++task) {
    auto next = of_task[to_size(task)].begin();
    for (const Index row : rows_of_task(order, task)) {
      const std::size_t k = to_size(row);
      const Index found = lists.begin[k + 1] - lists.begin[k];
      std::copy_n(next, found, lists.preimages.begin() + lists.begin[k]);
      next += found;
    }
  }
  return lists;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
