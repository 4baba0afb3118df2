#include "options.h"

#include <pybind11/stl.h>

#include "arrays.h"
#include "density.h"
#include "majorant/apps/jobs/input_points.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/energy_term.h"

namespace majorant::python {
namespace {

// Rows of targets that are NaN stand for the vertex's position in the initial map.
std::vector<Pin> points(const py::dict& keywords, const char* name, const SurfaceMesh& mesh,
                        const std::vector<Index>& names) {
  if (keywords[name].is_none()) return {};
  const auto [numbers, targets] = keyword<std::pair<Integers, Doubles>>(keywords, name);
  std::vector<Handle> handles;
  for (py::ssize_t k = 0; k < numbers.size(); ++k) {
    const Vector2 target(targets.at(k, 0), targets.at(k, 1));
    handles.push_back({numbers.at(k), target.allFinite() ? std::optional(target) : std::nullopt});
  }
  return pins_at(mesh, handles, name, names);
}

// Reads one weight per polygon and returns one per face of the mesh.
Vec face_weights(const py::dict& keywords, const SurfaceMesh& mesh) {
  if (keywords["weights"].is_none()) return {};
  const auto of_polygon = keyword<Doubles>(keywords, "weights");
  Vec weights(mesh.face_count());
  for (Index f = 0; f < weights.size(); ++f) weights[f] = of_polygon.at(mesh.input_face(f));
  return weights;
}

template <class Choice>
Choice pick(const py::dict& keywords, const char* name, std::string_view word, Choice yes,
            Choice no) {
  return keyword<std::string>(keywords, name) == word ? yes : no;
}

}  // namespace

EnergySum energy_sum(const py::handle& energies) {
  EnergySum sum;
  for (const py::handle summand : energies) {
    const auto [energy, weight] = summand.cast<std::pair<py::object, double>>();
    if (py::isinstance<py::str>(energy))
      sum.push_back({find_energy(energy.cast<std::string>())->make, weight});
    else
      sum.push_back({python_energy(energy), weight});
  }
  return sum;
}

ParametrizationOptions read_options(const py::dict& keywords, const SurfaceMesh& mesh,
                                    const std::vector<Index>& names) {
  ParametrizationOptions options;
  MapOptions& map = options.map;
  map.energy = energy_sum(keywords["energies"]);
  map.degree = keyword<int>(keywords, "degree");
  map.boundary = pick(keywords, "boundary", "fixed", BoundaryCondition::Fixed, map.boundary);
  if (keyword<bool>(keywords, "boundary_angles"))
    map.boundary_angles = BoundaryAngles::AtMostFullTurn;
  if (keyword<bool>(keywords, "bijective")) map.injectivity = MapInjectivity::Global;
  map.pins = points(keywords, "pins", mesh, names);
  map.handles = points(keywords, "handles", mesh, names);
  map.handle_weight = keyword<double>(keywords, "soft");
  map.face_weight = face_weights(keywords, mesh);
  for (const StartMethod method : {StartMethod::Tutte, StartMethod::Multiresolution})
    map.start = pick(keywords, "init", start_name(method), method, map.start);
  SolveOptions& solve = options.solve;
  solve.curvature = *curvature_choice(keyword<std::string>(keywords, "curvature"));
  solve.elevation = pick(keywords, "elevation", "direct", Elevation::Direct, solve.elevation);
  solve.effort = pick(keywords, "effort", "high", Effort::High, solve.effort);
  solve.tolerance = keyword<double>(keywords, "tolerance");
  solve.quadrature_points = keyword<int>(keywords, "quadrature");
  if (keyword<bool>(keywords, "improve_mesh")) solve.triangles = Triangles::Flipped;
  solve.threads = keyword<int>(keywords, "threads");
  return options;
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
