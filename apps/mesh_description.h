// Describes a mesh for `majorant info`: size and topology, defects, and the verbs that accept it.
//
//   const MeshDescription found = describe_mesh(read_mesh("bunny.obj"), {.plan = true});
//   std::cout << found.text;
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <utility>

#include "majorant/apps/jobs/report.h"
#include "majorant/framework/stop_check.h"
#include "majorant/io/read_mesh.h"

namespace majorant::app {

// A description as lines of text and as a report.
struct MeshDescription {
  std::string text;
  RunReport report{.status = "done", .result = Json::object()};

  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
  }
};

struct DescriptionOptions {
  bool plan = false;  // also the charts and cuts that unwrap would make
};

// Throws Error for meshes that repair() refuses, and Stopped.
MeshDescription describe_mesh(const PolygonMesh& polygons, const DescriptionOptions& options,
                              const StopCheck& stop = {});

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
