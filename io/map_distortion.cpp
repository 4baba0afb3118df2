#include <fmt/format.h>

#include <iterator>

#include "majorant/elements/rest_shapes.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/io.h"
#include "majorant/io/layout_scale.h"

namespace majorant {

MapDistortion measure_distortion(const MapFile& file) {
  return measure_distortion(file.degree, file.cells, Vec(file.uv.reshaped<Eigen::RowMajor>()),
                            flat_triangles(file.points, file.cells.leftCols<3>()),
                            layout_scale(file));
}

FaceDistortion finite_or_none(const FaceDistortion& faces) {
  return faces.allFinite() ? faces : FaceDistortion();
}

void write_distortion(const std::string& path, const MapFile& file, const FaceDistortion& faces) {
  std::string text =
      fmt::format("input_face,face,chart,{},area_share\n", fmt::join(kFaceDistortionNames, ","));
  const Vec area = flat_triangles(file.points, file.cells.leftCols<3>()).measure;
  const double whole = area.sum();
  for (Index f = 0; f < faces.rows(); ++f) {
    fmt::format_to(std::back_inserter(text), "{},{},{}",
                   file.input_face.size() > 0 ? file.input_face[f] : f, f,
                   file.chart.size() > 0 ? file.chart[f] : 0);
    for (const double value : faces.row(f))
      fmt::format_to(std::back_inserter(text), ",{:.17g}", value);
    fmt::format_to(std::back_inserter(text), ",{:.17g}\n", area[f] / whole);
  }
  write_file_atomically(path, text);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
