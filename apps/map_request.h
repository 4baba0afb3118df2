// The options shared by the verbs that optimize a map, and the readers of the files that they name.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>

#include "majorant/apps/jobs/map_job.h"
#include "majorant/io/read_mesh.h"

namespace majorant::app {

// The help text about MapRequest::choose_degree().
inline constexpr const char* kDegreeByOutputs =
    "3, or 1 where all data outputs are without curves: .obj .ply .glb .gltf";

// The options of a map as the user gave them.
struct MapRequest {
  std::string input, energy = "symmetric-dirichlet", boundary = "free", init = "auto",
                     curvature = "projected",  // set by parametrize only
      pins, handles, weights;
  int degree = 0;  // 0: not given, see choose_degree()
  int quadrature = 0;
  double soft = MapOptions().handle_weight;
  bool boundary_angles = false, seamless = false;  // seamless: set by parametrize only
  Strictness strictness = Strictness::Shape;       // minimal strictness for reading `input`

  // default_degree: words for the help on the verb's default.
  void add_to(CLI::App& verb, const char* default_degree = kDegreeByOutputs);
  void add_start_to(CLI::App& verb);  // adds --boundary and --init, for verbs without a start of
                                      // their own
  // Chooses a degree if none is given: 1 if every data file among the outputs has a format without
  // curves, else 3. Pictures, traces and reports do not count.
  void choose_degree(const std::vector<std::string>& outputs);
  Json to_json() const;                     // for reports and claims
  std::vector<std::string> inputs() const;  // files to read; empty names for options not given
};

// Returns the options for any surface of the file, cut or not: energy, degree, curvature, points
// and weights. names: see pins_at(). Throws the errors of the readers; Error(Invalid) if stopped
// while reading.
ParametrizationOptions read_options(const MapRequest& request, const PolygonMesh& polygons,
                                    const SurfaceMesh& mesh, const StopCheck& stop = {},
                                    const std::vector<Index>& names = {});

// Opens the job with the file, makes a start and translates the options. make_start makes the
// start; if it is empty, a seamless request starts from the texture coordinates. Throws the errors
// of the readers and starts; Error(Usage) for energies that collapse, Error(Invalid) if stopped.
using StartMaker = std::function<void(MapJob&)>;
void read_input(const MapRequest& request, MapJob& job, const StartMaker& make_start = {});

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
