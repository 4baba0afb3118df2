// compare(): its methods, rows and files.
#include "comparison.h"

#include <pybind11/stl.h>

#include <limits>
#include <string>
#include <utility>

#include "arrays.h"
#include "majorant/framework/comparison/compare.h"
#include "majorant/framework/comparison/comparison_table.h"
#include "majorant/framework/parallel.h"
#include "majorant/pictures/write_comparison.h"
#include "module.h"
#include "options.h"
#include "run.h"
#if MAJORANT_GPL
#include "majorant/framework/comparison/ceres_methods.h"
#endif
#if MAJORANT_HAS_CHOLMOD
#include "majorant/framework/comparison/cholmod_methods.h"
#endif

namespace majorant::python {
namespace {

std::vector<ComparisonMethod> all_methods() {
  std::vector<ComparisonMethod> others;
#if MAJORANT_HAS_CHOLMOD
  for (ComparisonMethod& method : cholmod_methods()) others.push_back(std::move(method));
#endif
#if MAJORANT_GPL
  for (ComparisonMethod& method : ceres_methods()) others.push_back(std::move(method));
#endif
  return comparison_methods(std::move(others));
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const ComparisonMethod& method : all_methods()) names.push_back(method.name);
  return names;
}

Comparison compared(const ComparisonInput& input, const std::vector<std::string>& methods,
                    const py::dict& keywords) {
  Run run(std::numeric_limits<double>::infinity(), std::numeric_limits<int>::max(), py::none());
  ComparisonOptions options;
  options.bounds = input.bounds;
  options.time_limit_seconds = keyword<double>(keywords, "time_limit");
  options.tolerance = keyword<std::optional<double>>(keywords, "tolerance");
  options.max_iterations = keyword<std::optional<int>>(keywords, "max_iterations");
  options.title = keyword<std::string>(keywords, "title");
  options.stop = run.stop();
  const int threads = keyword<int>(keywords, "threads");
  const std::vector<ComparisonMethod> chosen = named_methods(methods, all_methods());
  return run([&] {
    const ThreadCount count(threads);
    return input.on_manifolds ? compare(*input.on_manifolds, input.start, chosen, options)
                              : compare(*input.problem, input.start, chosen, options);
  });
}

// Returns the points of a run as arrays, by name.
py::dict points_of(const MethodRun& run) {
  const auto column = [&](auto value) {
    Vec numbers(static_cast<Index>(run.points.size()));
    for (std::size_t k = 0; k < run.points.size(); ++k)
      numbers[static_cast<Index>(k)] = value(run.points[k]);
    return moved(std::move(numbers));
  };
  using namespace py::literals;
  using Point = const ComparisonPoint&;
  return py::dict("seconds"_a = column([](Point p) { return p.seconds; }),
                  "energy"_a = column([](Point p) { return p.energy; }),
                  "gradient_norm"_a = column([](Point p) { return p.gradient_norm; }),
                  "step"_a = column([](Point p) { return p.step; }));
}

py::list rows(const Comparison& all) {
  using namespace py::literals;
  py::list rows;
  for (const MethodRun& run : all.runs) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const ComparisonPoint last =
        run.points.empty() ? ComparisonPoint{0, 0, nan, nan, nan} : run.points.back();
    rows.append(py::dict(
        "method"_a = run.method, "status"_a = run.status, "message"_a = run.message,
        "iterations"_a = last.iteration, "factorizations"_a = run.factorizations,
        "seconds"_a = last.seconds, "energy"_a = last.energy,
        "gradient_norm"_a = last.gradient_norm, "distance"_a = run.distance,
        "definite"_a = definite_name(run.definite), "notes"_a = run.notes,
        "x"_a = moved(Vec(run.x)), "points"_a = points_of(run),
        "seconds_by_part"_a =
            py::dict("assemble"_a = run.seconds.assemble, "factorize"_a = run.seconds.factorize,
                     "solve"_a = run.seconds.solve, "line_search"_a = run.seconds.line_search)));
  }
  return rows;
}

}  // namespace

void bind_comparisons(py::module_& module) {
  py::class_<ComparisonInput>(module, "ComparisonInput");
  py::class_<Comparison>(module, "Comparison")
      .def("rows", &rows)
      .def_readonly("notes", &Comparison::notes)
      .def("text", &comparison_table)
      .def("html", &comparison_html_table)
      .def(
          "write_csv",
          [](const Comparison& all, const std::string& path, bool points) {
            (points ? write_comparison_csv : write_comparison_rows)(path, all);
          },
          py::arg("path"), py::arg("points"))
      .def(
          "write_page",
          [](const Comparison& all, const std::string& path) { write_comparison_html(path, all); },
          py::arg("path"));
  module.def("comparison_methods", &method_names);
  module.def("compare", &compared, py::arg("input"), py::arg("methods"), py::arg("keywords"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
