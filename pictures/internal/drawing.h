// A drawing: what is painted where, in order. Two programs consume it, and so show the same: one
// writes SVG (write_svg.cpp), one paints pixels (internal/canvas.h).
//
//   Drawing drawing{.width = 100, .height = 50};
//   Path path;
//   path.move({10, 10});
//   path.line({90, 40});
//   drawing.items.push_back(Shape{.path = path, .stroke = Stroke{{51, 51, 51}, 2}});
//
// Places are in units of the drawing from its upper left corner, y down.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/pictures/color_scale.h"
#include "majorant/pictures/pictures.h"

namespace majorant {

// Pieces of curves; verbs take their points in order.
struct Path {
  enum class Verb : char { Move, Line, Quadratic, Cubic, Close };

  std::vector<Verb> verbs;
  std::vector<Vector2> points;

  void move(const Vector2& to);
  void line(const Vector2& to);
  void quadratic(const Vector2& control, const Vector2& to);
  void cubic(const Vector2& first, const Vector2& second, const Vector2& to);
  void close();
  void append(const Path& other);
};

// The number of points that a verb takes.
int point_count(Path::Verb verb);

// The box between two corners.
Path rectangle(const Vector2& corner, const Vector2& size);

struct Stroke {
  Color color;
  double width = 1;  // with round ends and corners
};

// Filled where the path winds around a point, then stroked.
struct Shape {
  Path path = {};
  std::optional<Color> fill = {};
  std::optional<Stroke> stroke = {};
};

struct Circle {
  Vector2 center = Vector2::Zero();
  double radius = 1;
  std::optional<Color> fill = {};
  std::optional<Stroke> stroke = {};
};

// One line of ASCII.
struct Label {
  enum class Anchor { Start, Middle };

  Vector2 at = Vector2::Zero();  // of the foot of the letters
  std::string text = {};
  double size = 20;
  Anchor anchor = Anchor::Start;
  Color color{51, 51, 51};
  double halo = 0;  // width of the paper's colour around the letters
};

// Shapes of which only what is inside of a path is seen.
struct Clipped {
  std::string name;  // of the path, one word
  Path clip;
  std::vector<Shape> shapes;
};

using DrawingItem = std::variant<Shape, Circle, Label, Clipped>;
DrawingItem moved(const DrawingItem& item, const Vector2& by);

struct Drawing {
  double width = 0, height = 0;
  Paper paper = Paper::White;
  std::string title = {}, description = {};
  std::vector<DrawingItem> items = {};
};

// As SVG (write_svg.cpp).
std::string svg_text(const Drawing& drawing);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
