// Paints drawings as pixels, with cairo.
//
//  Canvas canvas({800, 600}, 0.8, Paper::White);     // 0.8 pixels a unit of drawings
//  canvas.paint(behind);
//  canvas.lay(pixels);                               // over `behind`
//  canvas.paint(over);
//  write_file_atomically("a.png", encode_png(canvas.image()));
//
// Letters have built-in outlines (internal/letters.h), so that no font of the machine is needed.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "majorant/pictures/images/png_file.h"
#include "majorant/pictures/internal/drawing.h"
#include "majorant/pictures/internal/rasterizer.h"

namespace majorant {

// Red, green and blue, 0 to 255, times the covered part of the pixel; then that part, 0 to 1.
using CoveredColor = Eigen::Vector4d;

class Canvas {
 public:
  // Throws std::bad_alloc if memory is short.
  Canvas(PixelSize size, double scale, Paper paper);
  ~Canvas();

  void paint(std::span<const DrawingItem> items);
  // Paints rows of pixels from the top, as wide as the canvas; fewer rows are allowed.
  void lay(std::span<const CoveredColor> pixels);

  PixelImage image() const;

 private:
  struct Surface;
  std::unique_ptr<Surface> surface_;
  PixelSize size_;
  double scale_;
  Paper paper_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
