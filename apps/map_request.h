// The common options of the verbs that optimize a map: the options that say which map, and reading
// what they name.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>

#include "majorant/apps/jobs/map_job.h"
#include "majorant/io/read_mesh.h"

namespace majorant::app {

// The help text of MapRequest::choose_degree().
inline constexpr const char* kDegreeByOutputs =
    "3, or 1 where all data outputs are without curves: .obj .ply .glb .gltf";

// Everything the user can say of the map, as said.
struct MapRequest {
  std::string input, energy = "symmetric-dirichlet", boundary = "free", init = "auto",
                     curvature = "projected",  // an option of parametrize only
      pins, handles, weights;
  int degree = 0;  // 0: nothing was said, see choose_degree()
  int quadrature = 0;
  double soft = MapOptions().handle_weight;
  bool boundary_angles = false, seamless = false;  // seamless: an option of parametrize only
  Strictness strictness = Strictness::Shape;       // of reading `input`, at least

  // default_degree: what the verb takes where nothing is said, in words.
  void add_to(CLI::App& verb, const char* default_degree = kDegreeByOutputs);
  void add_start_to(CLI::App& verb);  // --boundary and --init, where the verb makes no start itself
  // Where nothing was said: 3, or 1 if every data file among the outputs has a format without
  // curves (pictures, traces and reports do not count).
  void choose_degree(const std::vector<std::string>& outputs);
  Json to_json() const;                     // for reports and claims
  std::vector<std::string> inputs() const;  // files to read; empty where none is given
};

// The options alone, of any surface of the file, cut or not: energy, degree, curvature, points and
// weights. names: as pins_at() takes them. Throws Error as the readers do; Error(Invalid) when
// stopped while it reads.
ParametrizationOptions read_options(const MapRequest& request, const PolygonMesh& polygons,
                                    const SurfaceMesh& mesh, const StopCheck& stop = {},
                                    const std::vector<Index>& names = {});

// Opens the job with the file, gives it a start and translates the options. make_start: calls one
// of the job's own; empty: that of the texture coordinates if `request` is seamless, else none.
// Throws Error as the readers and starts do; Error(Usage) for energies that collapse,
// Error(Invalid) when stopped.
using StartMaker = std::function<void(MapJob&)>;
void read_input(const MapRequest& request, MapJob& job, const StartMaker& make_start = {});

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
