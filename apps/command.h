// The verbs, and the options that every verb has.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>

#include "apps/failure.h"
#include "majorant/framework/minimizer.h"
#include "majorant/io/read_mesh.h"

namespace majorant::app {

std::string version_line();

inline constexpr const char* kStandardOutput = "-";  // as the file of a report

struct CommonOptions {
  int threads = 0;  // 0: all that the process may use
  bool quiet = false, verbose = false;
  bool force = false;   // an output may replace an input
  bool strict = false;  // refuse inputs that need repairs
  std::string report;   // file name, kStandardOutput or empty
  std::string petsc_options;
  std::string format;  // of standard input and output, which with_standard_streams() reads

  void add_to(CLI::App& verb);
  void add_petsc_to(CLI::App& verb);  // adds --petsc-options, for verbs that may use PETSc
  // Returns the strictness for reading meshes: Everything with --strict, else `least`.
  Strictness strictness(Strictness least = Strictness::Shape) const;
};

// Each function adds its verb to `app` and sets *run if that verb is chosen. The action returns the
// exit code and may throw Error.
using Action = std::function<int()>;
void add_parametrize(CLI::App& app, Action* run);
void add_unwrap(CLI::App& app, Action* run);
void add_seamless(CLI::App& app, Action* run);
void add_deform(CLI::App& app, Action* run);
void add_check(CLI::App& app, Action* run);
void add_compare(CLI::App& app, Action* run);
void add_convert(CLI::App& app, Action* run);
void add_bake(CLI::App& app, Action* run);
void add_info(CLI::App& app, Action* run);
void add_mesh(CLI::App& app, Action* run);
void add_quads(CLI::App& app, Action* run);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
