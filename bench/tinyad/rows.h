// The problems of TinyAD's examples (github.com/patr-schm/TinyAD-Examples). Each has several rows:
// by a lambda with the example's formulation, and in the usual ways of this library.
#pragma once

#include <ctime>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "input.h"
#include "majorant/framework/newton.h"

namespace majorant::tinyad {

// Counts the steps of a row and measures the time until its energy is at most `target`.
class Watch : public RunObserver {
 public:
  // to_rounding: whether rows run until doubles resolve no decrease.
  Watch(double target, bool to_rounding);
  const NewtonOptions& options() const { return options_; }
  Directive after_step(const TraceEntry& row, const Vec& y) override;
  // Records a step whose energy differs from that of the comparison.
  void step(const IterationRecord& record, double energy);
  double seconds() const;  // CPU seconds since construction

  int steps = 0, factorizations = 0;
  int steps_to_target = -1;
  double seconds_to_target = std::numeric_limits<double>::infinity();

 private:
  double target_;
  NewtonOptions options_;
  std::clock_t begin_;
};

struct End {
  SolveResult result;
  double energy;         // by the example's formula, unless the row documents another
  double violation = 0;  // of exact constraints
};
inline End end_of(const SolveResult& result) { return {result, result.energy}; }

struct Row {
  std::string name;
  std::function<End(const Input&, Watch&)> solve;
};

struct TinyadProblem {
  std::string name;  // problems with the same first word have the same input
  Input (*input)(const std::string& folder);
  std::vector<Row> rows;
};

std::vector<TinyadProblem> parametrization();
std::vector<TinyadProblem> deformation();
std::vector<TinyadProblem> sphere_embedding();
std::vector<TinyadProblem> polycurl();
std::vector<TinyadProblem> planar_quads();  // empty without OpenMesh
std::vector<TinyadProblem> polygon();
std::vector<TinyadProblem> derivatives();

}  // namespace majorant::tinyad

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
