#include "majorant/pictures/space_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "majorant/io/atomic_file.h"
#include "majorant/pictures/internal/canvas.h"
#include "majorant/pictures/internal/drawing.h"

namespace majorant {
namespace {

constexpr double kWidth = 1000, kHeight = 800, kMargin = 40;  // pixels
constexpr double kTitle = 22, kText = 18;                     // heights of letters
constexpr double kLegendWidth = 300, kLegendHeight = 14;
constexpr std::size_t kItemsAtOnce = 4096;  // items between two polls, about 10 ms
constexpr double kAmbient = 0.7;            // share of the light; the rest comes from the eye
constexpr Color kInk{51, 51, 51}, kMarked{190, 0, 30};

// The projection from space to pixels.
class View {
 public:
  explicit View(const SpacePicture& picture) {
    eye_ = picture.eye.normalized();
    const bool is_from_above = eye_.head<2>().isZero();
    right_ = (is_from_above ? Vector3::UnitY() : Vector3::UnitZ()).cross(eye_).normalized();
    up_ = eye_.cross(right_);
    Vector2 low = Vector2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    const auto take = [&](const Vector3& p) {
      low = low.cwiseMin(flat(p));
      high = high.cwiseMax(flat(p));
    };
    for (const SpaceTriangle& triangle : picture.triangles)
      for (const Vector3& p : triangle.corners) take(p);
    for (const SpaceMark& mark : picture.marks)
      for (const auto& line : mark.lines)
        for (const Vector3& p : line) take(p);
    const Vector2 room(kWidth - 2 * kMargin, kHeight - 5 * kMargin);  // between title and legend
    const Vector2 size = (high - low).cwiseMax(std::numeric_limits<double>::min());
    scale_ = (room.array() / size.array()).minCoeff();
    offset_ = Vector2(kWidth / 2, (kHeight - kMargin) / 2) - scale_ * (low + high) / 2;
  }
  Vector2 operator()(const Vector3& p) const { return offset_ + scale_ * flat(p); }
  const Vector3& eye() const { return eye_; }

 private:
  Vector2 flat(const Vector3& p) const { return {right_.dot(p), -up_.dot(p)}; }

  Vector3 eye_, right_, up_;
  double scale_ = 1;
  Vector2 offset_ = Vector2::Zero();
};

Color lit(const SpaceTriangle& triangle, const Vector3& eye) {
  const auto& [a, b, c] = triangle.corners;
  const Vector3 normal = (b - a).cross(c - a);
  const double length = normal.norm();
  const double cosine = length > 0 ? std::abs(normal.dot(eye)) / length : 0;
  const double light = kAmbient + (1 - kAmbient) * cosine;
  const auto part = [&](std::uint8_t x) {
    return static_cast<std::uint8_t>(std::lround(light * x));
  };
  return {part(triangle.color.red), part(triangle.color.green), part(triangle.color.blue)};
}

void paint(const SpaceTriangle& triangle, const View& view, std::vector<DrawingItem>& items) {
  std::array<Vector2, 3> corners;
  std::transform(triangle.corners.begin(), triangle.corners.end(), corners.begin(), view);
  Path path;
  path.move(corners[0]);
  path.line(corners[1]);
  path.line(corners[2]);
  path.close();
  const Color color = lit(triangle, view.eye());
  // The stroke closes gaps that antialiased borders leave between neighbours.
  items.push_back(Shape{path, color, Stroke{color, 0.5}});
  for (std::size_t k = 0; k < 3; ++k) {
    if (!triangle.has_edge[k]) continue;
    Path edge;
    edge.move(corners[k]);
    edge.line(corners[(k + 1) % 3]);
    items.push_back(Shape{.path = edge, .stroke = Stroke{kInk, 0.8}});
  }
}

void paint(const SpaceMark& mark, const View& view, std::vector<DrawingItem>& items) {
  for (const auto& [from, to] : mark.lines) {
    Path line;
    line.move(view(from));
    line.line(view(to));
    items.push_back(Shape{.path = line, .stroke = Stroke{kMarked, 2}});
  }
  items.push_back(Label{.at = view(mark.at),
                        .text = mark.text,
                        .size = kText,
                        .anchor = Label::Anchor::Middle,
                        .color = kMarked,
                        .halo = 4});
}

void paint_legend(const SpacePicture& picture, std::vector<DrawingItem>& items) {
  if (picture.colors.empty()) return;
  const Vector2 corner(kMargin, kHeight - 2 * kMargin);
  const double step = kLegendWidth / static_cast<double>(picture.colors.size());
  for (std::size_t k = 0; k < picture.colors.size(); ++k)
    items.push_back(Shape{
        rectangle(corner + Vector2(step * static_cast<double>(k), 0), {step + 0.5, kLegendHeight}),
        picture.colors[k]});
  for (const auto& [place, text] : picture.ticks)
    items.push_back(Label{.at = corner + Vector2(place * kLegendWidth, kLegendHeight + kText),
                          .text = text,
                          .size = kText,
                          .anchor = Label::Anchor::Middle});
  items.push_back(Label{.at = corner + Vector2(kLegendWidth + kMargin / 2, kLegendHeight),
                        .text = picture.legend,
                        .size = kText});
}

}  // namespace

void write_space_png(const std::string& path, const SpacePicture& picture, const StopCheck& stop) {
  const View view(picture);
  std::vector<double> depth;
  for (const SpaceTriangle& triangle : picture.triangles)
    depth.push_back(
        view.eye().dot(triangle.corners[0] + triangle.corners[1] + triangle.corners[2]));
  std::vector<std::size_t> order(depth.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return depth[i] < depth[j]; });
  Canvas canvas({static_cast<int>(kWidth), static_cast<int>(kHeight)}, 1, Paper::White);
  std::vector<DrawingItem> items;
  for (const std::size_t k : order) {
    paint(picture.triangles[k], view, items);
    if (items.size() < kItemsAtOnce) continue;
    stop.poll();
    canvas.paint(items);
    items.clear();
  }
  for (const SpaceMark& mark : picture.marks) paint(mark, view, items);
  items.push_back(Label{.at = {kMargin, kMargin}, .text = picture.title, .size = kTitle});
  paint_legend(picture, items);
  canvas.paint(items);
  write_file_atomically(path, encode_png(canvas.image()));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
