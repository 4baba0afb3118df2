// What the samples of a picture of pixels look like.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "majorant/pictures/internal/bezier_image.h"
#include "majorant/pictures/internal/density_probe.h"
#include "majorant/pictures/internal/legend.h"
#include "majorant/pictures/internal/rasterizer.h"
#include "majorant/pictures/png_file.h"

namespace majorant {

using FloatColor = Eigen::Vector3d;  // sRGB, 0 to 255

// Gives colours to fragments; by several threads at a time.
class Painter {
 public:
  virtual ~Painter() = default;
  // One colour a sample, where there is a cell; adds what legends say.
  virtual void paint(std::span<const Fragment> samples, std::span<FloatColor> colors,
                     ValueSummary& values) const = 0;
};

std::unique_ptr<Painter> plain_painter();
std::unique_ptr<Painter> checker_painter(const MapFile& map);
// write_png.h says where the image lies.
std::unique_ptr<Painter> image_painter(const MapFile& map, PixelImage image);
// energy: of the density. Of cells whose surface triangle has no area: kFlippedColor.
std::unique_ptr<Painter> heat_painter(const MapFile& map, Quantity quantity,
                                      const EnergySum& energy, const ColorScale& scale);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
