#include "majorant/pictures/internal/drawing.h"

#include <array>
#include <utility>

namespace majorant {

void Path::move(const Vector2& to) {
  verbs.push_back(Verb::Move);
  points.push_back(to);
}

void Path::line(const Vector2& to) {
  verbs.push_back(Verb::Line);
  points.push_back(to);
}

void Path::quadratic(const Vector2& control, const Vector2& to) {
  verbs.push_back(Verb::Quadratic);
  points.insert(points.end(), {control, to});
}

void Path::cubic(const Vector2& first, const Vector2& second, const Vector2& to) {
  verbs.push_back(Verb::Cubic);
  points.insert(points.end(), {first, second, to});
}

void Path::close() { verbs.push_back(Verb::Close); }

void Path::append(const Path& other) {
  verbs.insert(verbs.end(), other.verbs.begin(), other.verbs.end());
  points.insert(points.end(), other.points.begin(), other.points.end());
}

int point_count(Path::Verb verb) {
  constexpr std::array kPoints{1, 1, 2, 3, 0};
  return kPoints[static_cast<std::size_t>(verb)];
}

Path rectangle(const Vector2& corner, const Vector2& size) {
  Path path;
  path.move(corner);
  path.line({corner.x() + size.x(), corner.y()});
  path.line(corner + size);
  path.line({corner.x(), corner.y() + size.y()});
  path.close();
  return path;
}

namespace {

struct Mover {
  Vector2 by;

  Path moved(Path path) const {
    for (Vector2& p : path.points) p += by;
    return path;
  }
  DrawingItem operator()(Shape shape) const {
    shape.path = moved(std::move(shape.path));
    return shape;
  }
  DrawingItem operator()(Circle circle) const {
    circle.center += by;
    return circle;
  }
  DrawingItem operator()(Label label) const {
    label.at += by;
    return label;
  }
  DrawingItem operator()(Clipped clipped) const {
    clipped.clip = moved(std::move(clipped.clip));
    for (Shape& shape : clipped.shapes) shape.path = moved(std::move(shape.path));
    return clipped;
  }
};

}  // namespace

DrawingItem moved(const DrawingItem& item, const Vector2& by) {
  return std::visit(Mover{by}, item);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
