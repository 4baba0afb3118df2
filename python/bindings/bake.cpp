// Textures and attributes of one surface in the layout of another.
#include "bake.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "majorant/apps/jobs/bake_job.h"
#include "majorant/framework/error.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/parallel.h"
#include "mesh.h"
#include "options.h"
#include "run.h"

namespace majorant::python {
namespace {

using Codes = py::array_t<std::uint8_t, py::array::c_style>;
using Floats = py::array_t<float, py::array::c_style>;

// pixels: height by width by channels, rows from the top; bytes or floats.
Raster raster_of(const py::array& pixels) {
  const bool is_bytes = py::isinstance<Codes>(pixels);
  Raster raster(static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)),
                static_cast<int>(pixels.shape(2)),
                is_bytes ? PixelDepth::Eight : PixelDepth::Float);
  std::memcpy(raster.bytes().data(), pixels.data(), raster.bytes().size());
  return raster;
}

py::array pixels_of(const Raster& raster) {
  const std::vector<py::ssize_t> shape{raster.height(), raster.width(), raster.channels()};
  py::array pixels =
      raster.depth() == PixelDepth::Eight ? py::array(Codes(shape)) : py::array(Floats(shape));
  std::memcpy(pixels.mutable_data(), raster.bytes().data(), raster.bytes().size());
  return pixels;
}

// Returns why the image of a finished job is unusable; empty if it is usable.
std::string defect_of(const BakeJob& job) {
  const BakeCounts& counts = job.baked->counts;
  if (!job.is_proven())
    return fmt::format(
        "the centres of {} texels lie in two places of the layout, those of {} are undecided, and "
        "a texel shows one; unwrap without overlaps",
        counts.doubly_covered, counts.undecided);
  if (job.is_all_missed())
    return fmt::format("nothing of the carrier is within {:.4g} of the target; raise distance",
                       job.farthest);
  return {};
}

// Returns the image as an array and the report as JSON. carrier: null if it is the target.
py::tuple bake_arrays(const SharedPolygons& target, const SharedPolygons& carrier,
                      const py::list& images, const py::dict& keywords) {
  Run run(keyword<double>(keywords, "time_limit"), StoppingRules().max_iterations, py::none());
  const int threads = keyword<int>(keywords, "threads");
  BakeJob job;
  for (const py::handle image : images)
    job.images.push_back(raster_of(py::reinterpret_borrow<py::array>(image)));
  job.image_of_polygon = keyword<std::vector<int>>(keywords, "image_of_face");
  job.attribute = keyword<std::string>(keywords, "attribute");
  job.distance = keyword<std::optional<double>>(keywords, "distance");
  if (keyword<bool>(keywords, "linear")) job.image_transfer = Transfer::Linear;
  if (keyword<bool>(keywords, "nearest")) job.method = BakeMethod::Nearest;
  job.options.width = keyword<int>(keywords, "width");
  job.options.height = keyword<int>(keywords, "height");
  job.options.padding = keyword<int>(keywords, "padding");
  const bool is_bytes = keyword<bool>(keywords, "bytes");
  job.options.depth = is_bytes ? PixelDepth::Eight : PixelDepth::Float;
  if (is_bytes && !keyword<bool>(keywords, "linear")) job.options.transfer = Transfer::Srgb;
  run([&] {
    const ThreadCount count(threads);
    job.target = bake_surface(*target, Texcoords::Needed, run.stop());
    job.carrier = bake_surface(*carrier, Texcoords::Optional, run.stop());
    job.run(run.stop());
    return true;
  });
  if (const std::string defect = defect_of(job); !defect.empty())
    throw Error(ErrorKind::Invalid, defect);
  return py::make_tuple(pixels_of(job.baked->image), json_text(to_json(bake_report(job))));
}

}  // namespace

void bind_bakes(py::module_& module) {
  module.def("bake", &bake_arrays, py::arg("target"), py::arg("carrier"), py::arg("images"),
             py::arg("keywords"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
