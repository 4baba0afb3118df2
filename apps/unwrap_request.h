// What the user can say of a layout: how to repair, where to cut, how to pack.
//
//   UnwrapRequest request;
//   request.add_to(verb);
//   const RepairedSurface surface = request.repaired(polygons, common.strictness(), stop);
//   UnwrapOptions options = request.options(polygons, surface);
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "apps/seam_request.h"
#include "majorant/mesh/repair.h"
#include "majorant/parametrization/atlas/unwrap.h"

namespace majorant::app {

struct UnwrapRequest {
  SeamRequest seams;
  std::optional<double> weld;
  double padding = PackOptions().padding_pixels, resolution = PackOptions().resolution;
  bool no_pack = false;

  void add_to(CLI::App& verb);
  // The surface of the file. Throws Error(Unsupported) for what would be repaired, where everything
  // must be whole.
  RepairedSurface repaired(const PolygonMesh& polygons, Strictness strictness,
                           const StopCheck& stop) const;
  // Of cuts and packing; `chart` is left as it is. Throws as SeamRequest::options.
  UnwrapOptions options(const PolygonMesh& polygons, const RepairedSurface& surface) const;
  Json to_json() const;  // for reports and claims
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
