#include "majorant/pictures/internal/drawing.h"

#include <array>

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

int points_of(Path::Verb verb) {
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

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
