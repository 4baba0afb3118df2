// Replacements of the functions of cairo that pictures call. Each calls the function of libcairo,
// which the first call loads.
#include <cairo.h>

#include "loaded_symbol.h"

namespace {
constexpr majorant::python::LibraryOnDemand kCairo{"libcairo.so.2", "pictures"};
}

// cairo.h declares the same functions, so that the compiler checks each definition.
#define MAJORANT_ON_DEMAND(Result, name, parameters, arguments)                               \
  Result name parameters {                                                                    \
    static const auto call = majorant::python::loaded_symbol<decltype(&name)>(kCairo, #name); \
    return call arguments;                                                                    \
  }

extern "C" {
MAJORANT_ON_DEMAND(cairo_surface_t*, cairo_image_surface_create,
                   (cairo_format_t format, int width, int height), (format, width, height))
MAJORANT_ON_DEMAND(unsigned char*, cairo_image_surface_get_data, (cairo_surface_t * s), (s))
MAJORANT_ON_DEMAND(int, cairo_image_surface_get_stride, (cairo_surface_t * s), (s))
MAJORANT_ON_DEMAND(void, cairo_surface_destroy, (cairo_surface_t * s), (s))
MAJORANT_ON_DEMAND(void, cairo_surface_flush, (cairo_surface_t * s), (s))
MAJORANT_ON_DEMAND(void, cairo_surface_mark_dirty, (cairo_surface_t * s), (s))
MAJORANT_ON_DEMAND(cairo_t*, cairo_create, (cairo_surface_t * s), (s))
MAJORANT_ON_DEMAND(void, cairo_destroy, (cairo_t * pen), (pen))
MAJORANT_ON_DEMAND(cairo_status_t, cairo_status, (cairo_t * pen), (pen))
MAJORANT_ON_DEMAND(void, cairo_save, (cairo_t * pen), (pen))
MAJORANT_ON_DEMAND(void, cairo_restore, (cairo_t * pen), (pen))
MAJORANT_ON_DEMAND(void, cairo_clip, (cairo_t * pen), (pen))
MAJORANT_ON_DEMAND(void, cairo_paint, (cairo_t * pen), (pen))
MAJORANT_ON_DEMAND(void, cairo_fill, (cairo_t * pen), (pen))
MAJORANT_ON_DEMAND(void, cairo_fill_preserve, (cairo_t * pen), (pen))
MAJORANT_ON_DEMAND(void, cairo_stroke, (cairo_t * pen), (pen))
MAJORANT_ON_DEMAND(void, cairo_stroke_preserve, (cairo_t * pen), (pen))
MAJORANT_ON_DEMAND(void, cairo_new_path, (cairo_t * pen), (pen))
MAJORANT_ON_DEMAND(void, cairo_close_path, (cairo_t * pen), (pen))
MAJORANT_ON_DEMAND(void, cairo_move_to, (cairo_t * pen, double x, double y), (pen, x, y))
MAJORANT_ON_DEMAND(void, cairo_line_to, (cairo_t * pen, double x, double y), (pen, x, y))
MAJORANT_ON_DEMAND(void, cairo_curve_to,
                   (cairo_t * pen, double x1, double y1, double x2, double y2, double x3,
                    double y3),
                   (pen, x1, y1, x2, y2, x3, y3))
MAJORANT_ON_DEMAND(void, cairo_arc,
                   (cairo_t * pen, double x, double y, double radius, double from, double to),
                   (pen, x, y, radius, from, to))
MAJORANT_ON_DEMAND(void, cairo_get_current_point, (cairo_t * pen, double* x, double* y),
                   (pen, x, y))
MAJORANT_ON_DEMAND(void, cairo_scale, (cairo_t * pen, double x, double y), (pen, x, y))
MAJORANT_ON_DEMAND(void, cairo_translate, (cairo_t * pen, double x, double y), (pen, x, y))
MAJORANT_ON_DEMAND(void, cairo_set_line_cap, (cairo_t * pen, cairo_line_cap_t cap), (pen, cap))
MAJORANT_ON_DEMAND(void, cairo_set_line_join, (cairo_t * pen, cairo_line_join_t join), (pen, join))
MAJORANT_ON_DEMAND(void, cairo_set_line_width, (cairo_t * pen, double width), (pen, width))
MAJORANT_ON_DEMAND(void, cairo_set_source_rgb, (cairo_t * pen, double r, double g, double b),
                   (pen, r, g, b))
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
