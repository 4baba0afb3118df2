#include "majorant/pictures/internal/canvas.h"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <new>

#include "majorant/pictures/internal/letters.h"

namespace majorant {

static_assert(std::endian::native == std::endian::little, "cairo's pixels are b, g, r, a");

struct Canvas::Surface {
  cairo_surface_t* image;
  cairo_t* pen;

  explicit Surface(PixelSize size)
      : image(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, size.width, size.height)),
        pen(cairo_create(image)) {
    if (cairo_status(pen) != CAIRO_STATUS_SUCCESS) {
      release();
      throw std::bad_alloc();
    }
    cairo_set_line_join(pen, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(pen, CAIRO_LINE_CAP_ROUND);
  }
  ~Surface() { release(); }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  void release() {
    cairo_destroy(pen);
    cairo_surface_destroy(image);
  }

  unsigned char* pixel(int x, int y) const {
    return cairo_image_surface_get_data(image) + y * cairo_image_surface_get_stride(image) + 4 * x;
  }
};

namespace {

void set_color(cairo_t* pen, const Color& color) {
  constexpr double kMaximum = 255;
  cairo_set_source_rgb(pen, color.red / kMaximum, color.green / kMaximum, color.blue / kMaximum);
}

void stroke(cairo_t* pen, const Stroke& with) {
  set_color(pen, with.color);
  cairo_set_line_width(pen, with.width);
  cairo_stroke(pen);
}

// Adds verbs first to last of a path. Their points begin at `at`, which is advanced.
void trace(cairo_t* pen, const Path& path, std::size_t first, std::size_t last, std::size_t& at) {
  for (std::size_t k = first; k < last; ++k) {
    const Vector2* p = path.points.data() + at;
    switch (path.verbs[k]) {
      case Path::Verb::Move:
        cairo_move_to(pen, p->x(), p->y());
        break;
      case Path::Verb::Line:
        cairo_line_to(pen, p->x(), p->y());
        break;
      case Path::Verb::Quadratic: {  // raised to a cubic
        double x = 0, y = 0;
        cairo_get_current_point(pen, &x, &y);
        const Vector2 from(x, y), a = (from + 2 * p[0]) / 3, b = (p[1] + 2 * p[0]) / 3;
        cairo_curve_to(pen, a.x(), a.y(), b.x(), b.y(), p[1].x(), p[1].y());
        break;
      }
      case Path::Verb::Cubic:
        cairo_curve_to(pen, p[0].x(), p[0].y(), p[1].x(), p[1].y(), p[2].x(), p[2].y());
        break;
      case Path::Verb::Close:
        cairo_close_path(pen);
    }
    at += static_cast<std::size_t>(point_count(path.verbs[k]));
  }
}

void trace(cairo_t* pen, const Path& path) {
  std::size_t at = 0;
  trace(pen, path, 0, path.verbs.size(), at);
}

// Strokes each part by itself, so that time is linear in their number.
void stroke_parts(cairo_t* pen, const Path& path, const Stroke& with) {
  std::size_t at = 0;
  for (std::size_t first = 0; first < path.verbs.size();) {
    const auto next = std::find(path.verbs.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                                path.verbs.end(), Path::Verb::Move);
    const auto last = static_cast<std::size_t>(next - path.verbs.begin());
    trace(pen, path, first, last, at);
    stroke(pen, with);
    first = last;
  }
}

struct Painter {
  cairo_t* pen;

  void operator()(const Shape& shape) const {
    if (shape.fill) {
      trace(pen, shape.path);
      set_color(pen, *shape.fill);
      cairo_fill(pen);
    }
    if (shape.stroke) stroke_parts(pen, shape.path, *shape.stroke);
  }

  void operator()(const Circle& circle) const {
    cairo_new_path(pen);
    cairo_arc(pen, circle.center.x(), circle.center.y(), circle.radius, 0, 2 * M_PI);
    cairo_close_path(pen);
    if (circle.fill) {
      set_color(pen, *circle.fill);
      cairo_fill_preserve(pen);
    }
    if (circle.stroke) stroke(pen, *circle.stroke);
    cairo_new_path(pen);
  }

  void operator()(const Label& label) const {
    const double width = label.size * text_width(label.text);
    cairo_save(pen);
    cairo_translate(pen, label.at.x() - (label.anchor == Label::Anchor::Middle ? width / 2 : 0),
                    label.at.y());
    cairo_scale(pen, label.size, label.size);
    trace(pen, text_outline(label.text));
    cairo_restore(pen);
    if (label.halo > 0) {
      set_color(pen, {255, 255, 255});
      cairo_set_line_width(pen, label.halo);
      cairo_stroke_preserve(pen);
    }
    set_color(pen, label.color);
    cairo_fill(pen);
  }

  void operator()(const Clipped& clipped) const {
    cairo_save(pen);
    trace(pen, clipped.clip);
    cairo_clip(pen);
    for (const Shape& shape : clipped.shapes) (*this)(shape);
    cairo_restore(pen);
  }
};

}  // namespace

Canvas::Canvas(PixelSize size, double scale, Paper paper)
    : surface_(std::make_unique<Surface>(size)), size_(size), scale_(scale), paper_(paper) {
  if (paper_ == Paper::None) return;
  set_color(surface_->pen, {255, 255, 255});
  cairo_paint(surface_->pen);
}

Canvas::~Canvas() = default;

void Canvas::paint(std::span<const DrawingItem> items) {
  cairo_save(surface_->pen);
  cairo_scale(surface_->pen, scale_, scale_);
  for (const DrawingItem& item : items) std::visit(Painter{surface_->pen}, item);
  cairo_restore(surface_->pen);
}

void Canvas::lay(std::span<const CoveredColor> pixels) {
  cairo_surface_flush(surface_->image);
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    unsigned char* below = surface_->pixel(static_cast<int>(k % to_size(size_.width)),
                                           static_cast<int>(k / to_size(size_.width)));
    const CoveredColor& c = pixels[k];
    const std::array over{c[2], c[1], c[0], 255 * c[3]};  // b, g, r, a
    for (std::size_t d = 0; d < over.size(); ++d)
      below[d] =
          static_cast<unsigned char>(std::lround(std::min(255.0, over[d] + (1 - c[3]) * below[d])));
  }
  cairo_surface_mark_dirty(surface_->image);
}

PixelImage Canvas::image() const {
  cairo_surface_flush(surface_->image);
  PixelImage image{size_.width, size_.height, {}, {}};
  image.pixels.reserve(to_size(size_.width) * to_size(size_.height));
  for (int y = 0; y < size_.height; ++y)
    for (int x = 0; x < size_.width; ++x) {
      const unsigned char* p = surface_->pixel(x, y);
      const auto channel = [&](int d) {  // cairo's colours are premultiplied
        return static_cast<std::uint8_t>(p[3] == 0 ? 0
                                                   : std::min(255, (255 * p[d] + p[3] / 2) / p[3]));
      };
      image.pixels.push_back({channel(2), channel(1), channel(0)});
      if (paper_ == Paper::None) image.alpha.push_back(p[3]);
    }
  return image;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
