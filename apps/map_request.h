// What the verbs that optimize a map share: the options that say which map, and reading what they
// name.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "majorant/io/map_file.h"
#include "majorant/parametrization/cuts/choose_cuts.h"
#include "majorant/parametrization/drive/parametrize.h"
#include "majorant/parametrization/starts/start.h"
#include "majorant/results/internal/report.h"

namespace majorant::app {

// What MapRequest::choose_degree() does.
inline constexpr const char* kDegreeByOutputs =
    "3, or 1 where all data outputs are without curves: .obj .ply";

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

struct MapInput {
  PolygonMesh polygons;
  std::shared_ptr<const SurfaceMesh> mesh;  // of the file, not cut
  ParametrizationOptions options;           // vertices are those of start's mesh, if there is one
  std::optional<Start> start;               // of seamless maps, and of surfaces cut open
  std::optional<SurfaceCuts> cuts;          // of the latter
};

// The options alone, of any surface of the file, cut or not: energy, degree, curvature, points and
// weights. Throws Error as the readers do.
ParametrizationOptions read_options(const MapRequest& request, const PolygonMesh& polygons,
                                    const SurfaceMesh& mesh);

// Reads the files and translates the options. make_start: gives the seamless map to start from;
// empty: that of the texture coordinates if `request` is seamless, else a map of a disk with or
// without holes. Throws Error as the readers and starts do; Error(Unsupported) when a mesh should
// be such a disk and is not, Error(Usage) for energies that collapse, Error(Invalid) when stopped.
using StartMaker = std::function<Start(const PolygonMesh&, const SurfaceMesh&)>;
MapInput read_input(const MapRequest& request, const StopCheck& stop,
                    const StartMaker& make_start = {});

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
