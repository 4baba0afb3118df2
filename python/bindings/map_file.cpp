#include "map_file.h"

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "majorant/apps/jobs/float_layout.h"
#include "majorant/apps/jobs/object_layouts.h"
#include "majorant/apps/jobs/write_map.h"
#include "majorant/framework/error.h"
#include "majorant/io/claims.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/read_mesh.h"
#include "majorant/maps/bezier_cell.h"
#include "majorant/maps/energy_text.h"
#include "majorant/maps/smallest_rectangle.h"
#include "majorant/pictures/color_scale.h"
#include "majorant/pictures/pictures.h"
#include "majorant/pictures/turned_over.h"
#include "mesh.h"
#include "module.h"
#include "run.h"

namespace majorant::python {
namespace {

template <class Matrix>
void add_array(py::class_<MapFile, SharedMap>& type, const char* name, Matrix MapFile::*member) {
  type.def_property_readonly(name, [member](const py::object& self) {
    return view(self, self.cast<const MapFile&>().*member);
  });
}

// Returns all members of a map, in the order of restored().
py::tuple state(const MapFile& file) {
  return py::make_tuple(file.degree, moved(file.points), moved(file.uv), moved(file.uv_rounding),
                        moved(file.cells), moved(file.input_vertex), moved(file.input_face),
                        moved(file.distortion), moved(file.min_det), moved(file.cone),
                        moved(file.seam_edges), moved(file.chart),
                        moved(RowMatrix(file.face_distortion)), file.claims, file.warnings);
}

MapFile restored(const py::tuple& state) {
  MapFile file;
  std::size_t k = 0;
  const auto next = [&](auto& member) {
    using Member = std::decay_t<decltype(member)>;
    const py::object value = state[k++];
    if constexpr (std::is_base_of_v<Eigen::MatrixBase<Member>, Member>)
      member =
          matrix<Member>(value.cast<py::array_t<typename Member::Scalar, py::array::c_style>>());
    else
      member = value.cast<Member>();
  };
  next(file.degree), next(file.points), next(file.uv), next(file.uv_rounding), next(file.cells);
  next(file.input_vertex), next(file.input_face), next(file.distortion), next(file.min_det);
  next(file.cone), next(file.seam_edges), next(file.chart), next(file.face_distortion);
  next(file.claims), next(file.warnings);
  return file;
}

ProofRequest unpacked_request(const PackedRequest& packed, const PolygonMesh& mesh,
                              const std::string& path) {
  const auto [cuts, is_injective, of_surface, has_labels, is_as_given, has_stacks, of_objects] =
      packed;
  ProofRequest request;
  request.cuts = static_cast<CutRule>(cuts);
  if (is_injective) request.overlap = ProofRequest::Overlap::Forbidden;
  if (of_surface) request.surface = &mesh;
  if (has_labels) request.labels = labels_in(path);
  if (is_as_given) request.orientation = Orientation::AsGiven;
  if (has_stacks) request.stacks = ProofRequest::Stacks::Allowed;
  return request;
}

// mesh: the mesh of the map. input: whether mesh formats are written with the vertices and polygons
// of that mesh.
void save(const std::string& path, const MapFile& file, const PolygonMesh& mesh,
          const PackedRequest& packed, bool input, int refine, bool lagrange, bool surface) {
  const ProofRequest request = unpacked_request(packed, mesh, path);
  MapFormats formats;
  formats.tessellation = {refine, allowed_overlap(request)};
  if (lagrange) formats.vtu = VtuCells::Lagrange;
  if (surface) formats.msh = MshContent::Surface;
  const bool of_objects = std::get<6>(packed);
  if (of_objects && is_map_data(path) && (is_gltf(path) || !written_format(path)->has_objects))
    throw Error(ErrorKind::Usage,
                path + ": objects with layouts of their own are written as .obj or .vtu");
  Run run;
  run([&] {
    write_map(
        path, file, input ? &mesh : nullptr, formats,
        of_objects ? proof_of_objects(path, mesh) : proof_of_file(path, request, file, formats));
    return true;
  });
}

// Returns the layout with coordinates rounded to floats, and its first unproven property.
py::tuple layout_in_floats(const MapFile& file, const PolygonMesh& mesh,
                           const PackedRequest& packed) {
  Run run;
  ProofRequest request = unpacked_request(packed, mesh, "layout.vtu");
  request.stop = run.stop();
  FloatLayout layout = run([&] { return float_layout(file, mesh, request); });
  return py::make_tuple(std::make_shared<MapFile>(std::move(layout.map)), layout.defect);
}

struct ReadMap {
  SharedMap file;
  SharedPolygons mesh;
  PackedRequest request;
};

py::tuple load_map(const std::string& path) {
  Run run;
  const ReadMap read = run([&] {
    ReadMap out;
    out.file = std::make_shared<MapFile>(read_map(path, run.stop()));
    out.mesh = std::make_shared<PolygonMesh>(mesh_from_map(*out.file, path));
    out.request = packed_request(proof_request(*out.file, *out.mesh, path));
    return out;
  });
  return py::make_tuple(read.file, read.mesh, read.request);
}

std::optional<Quantity> quantity_of(const std::string& name) {
  for (const Quantity q : kQuantities)
    if (quantity_name(q) == name) return q;
  return std::nullopt;
}

std::string drawing(const MapFile& file, const std::string& quantity) {
  SvgOptions options;
  options.quantity = quantity_of(quantity);
  Run run;
  return run([&] { return svg_text(file, options); });
}

// Returns the color scale of a quantity in pictures: lower end, value at isometry, upper end, unit,
// colors (256 by 3, 0 to 1), and whether values lie on both sides of isometry. None for a density
// if the claims name no energy.
py::object quantity_scale(const MapFile& file, const std::string& quantity) {
  const std::optional<std::string> name = readable_claims(file.claims).energy;
  const std::optional<EnergySum> energy = name ? find_energy_sum(*name) : std::nullopt;
  const Quantity q = quantity_of(quantity).value();
  if (q == Quantity::Density && !energy) return py::none();
  const ColorScale scale = color_scale(q, energy.value_or(EnergySum()));
  Points3 colors(ColorScale::kColors, 3);
  for (Index k = 0; k < colors.rows(); ++k) {
    const Color& color = scale.colors()[to_size(k)];
    colors.row(k) << color.red, color.green, color.blue;
  }
  return py::make_tuple(scale.low(), scale.neutral(), scale.high(), scale.unit(),
                        moved(Points3(colors / 255)),
                        scale.shape() == ColorScale::Shape::Diverging);
}

// Returns the means over the cells of 'sigma-max', 'sigma-min', 'area' or 'angle', NaN without an
// area.
py::array mean_quantity(const MapFile& file, const std::string& quantity) {
  constexpr std::array kColumns{Quantity::SigmaMax, Quantity::SigmaMin, Quantity::Area,
                                Quantity::Angle};
  const auto* const found =
      std::find(kColumns.begin(), kColumns.end(), quantity_of(quantity).value());
  Run run;
  const FaceDistortion faces = run([&] {
    return file.face_distortion.rows() > 0 ? file.face_distortion : measure_distortion(file).faces;
  });
  return moved(Vec(faces.col(found - kColumns.begin())));
}

py::array cells_turned_over(const MapFile& file) {
  const std::vector<Index> cells = turned_over_cells(file);
  return moved(Eigen::VectorXi(Eigen::Map<const Eigen::Matrix<Index, Eigen::Dynamic, 1>>(
                                   cells.data(), static_cast<Index>(cells.size()))
                                   .cast<int>()));
}

// Returns the direction of the longer side of the layout.
std::pair<double, double> direction_of(const MapFile& file) {
  const Vector2 direction = layout_direction(file.uv, file.cells);
  return {direction.x(), direction.y()};
}

// Returns the multi-indices of the nodes in VTK's order.
py::array multi_indices(int degree) {
  const auto indices = bezier_multi_indices(degree);
  Cells rows(indices.size(), 3);
  for (Index k = 0; k < rows.rows(); ++k)
    for (Index corner = 0; corner < 3; ++corner) rows(k, corner) = indices[k][corner];
  return moved(std::move(rows));
}

}  // namespace

PackedRequest packed_request(const ProofRequest& request) {
  return {static_cast<int>(request.cuts),
          request.overlap == ProofRequest::Overlap::Forbidden,
          request.surface != nullptr,
          request.labels == ProofRequest::FaceLabels::Compared,
          request.orientation == Orientation::AsGiven,
          request.stacks == ProofRequest::Stacks::Allowed,
          false};
}

PackedRequest packed_request_of_objects() {
  return {static_cast<int>(CutRule::Free), true, true, false, false, false, true};
}

void bind_map_files(py::module_& module) {
  py::class_<MapFile, SharedMap> type(module, "MapFile");
  type.def_readonly("degree", &MapFile::degree)
      .def_readonly("claims", &MapFile::claims)
      .def_readonly("warnings", &MapFile::warnings)
      .def(py::pickle(&state, &restored));
  add_array(type, "points", &MapFile::points);
  add_array(type, "uv", &MapFile::uv);
  add_array(type, "cells", &MapFile::cells);
  add_array(type, "input_vertex", &MapFile::input_vertex);
  add_array(type, "input_face", &MapFile::input_face);
  add_array(type, "distortion", &MapFile::distortion);
  add_array(type, "min_det", &MapFile::min_det);
  add_array(type, "cone", &MapFile::cone);
  add_array(type, "chart", &MapFile::chart);
  add_array(type, "seam_edges", &MapFile::seam_edges);
  module.def("read_map", &load_map, py::arg("path"));
  module.def("map_formats", [] {
    std::vector<std::string> all = extensions_for(FormatUse::WriteMap);
    for (std::string& picture : extensions_for(FormatUse::Show)) all.push_back(std::move(picture));
    return all;
  });
  module.def("save_map", &save, py::arg("path"), py::arg("file"), py::arg("mesh"),
             py::arg("request"), py::arg("input"), py::arg("refine"), py::arg("lagrange"),
             py::arg("surface"));
  module.def("float_layout", &layout_in_floats, py::arg("file"), py::arg("mesh"),
             py::arg("request"));
  module.def("svg_text", &drawing, py::arg("file"), py::arg("quantity"));
  module.def("quantity_scale", &quantity_scale, py::arg("file"), py::arg("quantity"));
  module.def("mean_quantity", &mean_quantity, py::arg("file"), py::arg("quantity"));
  module.def("turned_over_cells", &cells_turned_over, py::arg("file"));
  module.def("layout_direction", &direction_of, py::arg("file"));
  module.def("multi_indices", &multi_indices, py::arg("degree"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
