// majorant._core, the compiled module of the Python package majorant. It is private to the package,
// which checks and documents the arguments; names and arguments may change.
#include "module.h"

#include <dlfcn.h>
#include <pybind11/stl.h>

#include "bake.h"
#include "majorant/apps/jobs/layout_presets.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/minimizer.h"
#include "majorant/maps/energy_text.h"
#include "majorant/parametrization/packing/pack.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant::python {
namespace {

// Returns the kernels that a loaded OpenBLAS has chosen; empty if it is not loaded.
std::string blas_kernels() {
  using Name = const char* (*)();
  const auto name = reinterpret_cast<Name>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  return name ? name() : "";
}

std::vector<std::pair<std::optional<std::string>, std::string>> split_energy(
    const std::string& text) {
  std::vector<std::pair<std::optional<std::string>, std::string>> words;
  for (const EnergyWord& word : split_energy_text(text)) words.emplace_back(word.weight, word.name);
  return words;
}

// Returns the defaults of the package's options, and the largest weight.
py::dict defaults() {
  const ParametrizationOptions options;
  const PackOptions packing;
  py::dict all;
  all["tolerance"] = options.solve.tolerance;
  all["max_iterations"] = StoppingRules().max_iterations;
  all["soft"] = options.map.handle_weight;
  all["padding"] = packing.padding_pixels;
  all["resolution"] = packing.resolution;
  all["largest_weight"] = kLargestFactor;
  return all;
}

// Returns the options of each preset of `unwrap`, by name.
py::dict presets() {
  py::dict all;
  for (const LayoutPreset& preset : kLayoutPresets) {
    py::dict values;
    values["max_stretch"] = preset.max_stretch ? py::cast(*preset.max_stretch) : py::none();
    values["charts"] = preset.is_one_chart ? "one" : "auto";
    values["fill"] = preset.fill;
    values["padding"] = preset.padding;
    values["resolution"] = preset.resolution;
    all[py::str(std::string(preset.name))] = values;
  }
  return all;
}

std::vector<std::pair<std::string, std::string>> energies() {
  std::vector<std::pair<std::string, std::string>> list;
  for (const NamedEnergy& energy : named_energies()) list.emplace_back(energy.name, energy.summary);
  return list;
}

}  // namespace
}  // namespace majorant::python

PYBIND11_MODULE(_core, module) {
  using namespace majorant::python;
  module.attr("version") = MAJORANT_VERSION;
  module.attr("max_degree") = majorant::BezierTriangleSpace::kMaxDegree;
  module.attr("max_tetrahedron_degree") = majorant::BezierTetrahedronSpace::kMaxDegree;
  module.attr("defaults") = defaults();
  module.attr("presets") = presets();
  module.attr("most_tiles") = majorant::kMaxTiles;
  translate_errors();
  bind_steps(module);
  bind_meshes(module);
  bind_map_files(module);
  bind_solvers(module);
  bind_unwrap(module);
  bind_check(module);
  bind_places(module);
  bind_spaces(module);
  bind_terms(module);
  bind_comparisons(module);
  bind_problems(module);
  bind_volumes(module);
  bind_quads(module);
  bind_bakes(module);
  module.def("energies", &energies);
  module.def("split_energy", &split_energy, py::arg("text"));
  module.def("vector_instructions", &majorant::vector_instructions);
  module.def("blas_kernels", &blas_kernels);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
