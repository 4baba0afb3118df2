// A drawing: shapes and labels in painting order. write_svg.cpp writes it as SVG and
// internal/canvas.h paints it as pixels, so that both show the same.
//
//   Drawing drawing{.width = 100, .height = 50};
//   Path path;
//   path.move({10, 10});
//   path.line({90, 40});
//   drawing.items.push_back(Shape{.path = path, .stroke = Stroke{{51, 51, 51}, 2}});
//
// Coordinates are in units of the drawing from its upper left corner, y down.
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

// Returns the number of points that a verb takes.
int point_count(Path::Verb verb);

// Returns the rectangle between two corners.
Path rectangle(const Vector2& corner, const Vector2& size);

struct Stroke {
  Color color;
  double width = 1;  // with round ends and corners
};

// A shape, filled where the path has a nonzero winding number, then stroked.
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

  Vector2 at = Vector2::Zero();  // left or middle of the baseline
  std::string text = {};
  double size = 20;
  Anchor anchor = Anchor::Start;
  Color color{51, 51, 51};
  double halo = 0;  // width of a halo in the paper's colour
};

// Shapes clipped to the inside of a path.
struct Clipped {
  std::string name;  // identifies the path, one word
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

// Returns the drawing as SVG (write_svg.cpp).
std::string svg_text(const Drawing& drawing);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
