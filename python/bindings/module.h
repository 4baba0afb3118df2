// The registration functions of the files of the module _core; module.cpp calls all of them.
#pragma once

#include <pybind11/pybind11.h>

namespace majorant::python {

namespace py = pybind11;

// Translates the library's exceptions to those of majorant/_errors.py: Error and Stopped by kind,
// std::bad_alloc to MemoryError, all others to InternalError. Exceptions of Python pass through the
// library unchanged.
void translate_errors();

void bind_steps(py::module_& module);      // Step, of callbacks
void bind_meshes(py::module_& module);     // Mesh, mesh_of_arrays, read_mesh
void bind_map_files(py::module_& module);  // MapFile, read_map, save_map, svg_text, multi_indices,
                                           // functions of plots
// Registers parametrize, seamless, deform and unwrap. Each takes a Mesh, keywords (options.h) and a
// callback, and returns
//     (MapFile, Mesh, request, input, status, message, report)
// from which Python makes a Map. Mesh is the mesh for writers, request the properties that files
// must be proven to have, input whether mesh formats keep the polygons, report the report as JSON.
// Raises an exception if there is no valid map.
void bind_solvers(py::module_& module);
void bind_unwrap(py::module_& module);
void bind_check(py::module_& module);     // check_map
void bind_places(py::module_& module);    // InverseMap, SurfaceTree
void bind_spaces(py::module_& module);    // Space, triangle_space, tetrahedron_space, quad_space
void bind_terms(py::module_& module);     // Term, energy_terms, penalty, linear_term, element_term,
                                          // robust_loss
void bind_problems(py::module_& module);  // Problem
void bind_comparisons(py::module_& module);  // Comparison, compare, comparison_methods
void bind_quads(py::module_& module);        // Quads, quad_mesh, save_quads
void bind_volumes(py::module_& module);      // Volume, read_volume, make_volume, check_volume, ...

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
