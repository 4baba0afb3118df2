#include "majorant/pictures/write_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "embedded/comparison_page_css.h"
#include "embedded/comparison_page_html.h"
#include "embedded/comparison_page_js.h"
#include "majorant/framework/comparison/comparison_table.h"
#include "majorant/io/atomic_file.h"
#include "majorant/pictures/page_text.h"

namespace majorant {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kDrawnPoints = 2000;

// Returns null for values that JSON cannot hold.
Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

// Rounds to six digits, which makes the page a third as large.
Json short_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  const std::string digits = fmt::format("{:.6g}", value);
  double rounded = value;
  std::from_chars(digits.data(), digits.data() + digits.size(), rounded);
  return rounded;
}

// Returns the points to draw: all, or the first, the last and kDrawnPoints - 2 with two spacings.
std::vector<std::size_t> drawn_points(std::size_t count) {
  std::set<std::size_t> chosen;
  if (count <= kDrawnPoints) {
    for (std::size_t i = 0; i < count; ++i) chosen.insert(chosen.end(), i);
  } else {
    constexpr std::size_t kHalf = kDrawnPoints / 2;
    const auto last = static_cast<double>(count - 1);
    for (std::size_t i = 0; i < kHalf; ++i) {
      const double part = static_cast<double>(i) / (kHalf - 1);
      chosen.insert(static_cast<std::size_t>(std::round(last * part)));
      chosen.insert(static_cast<std::size_t>(std::round(std::pow(last, part))));
    }
  }
  return {chosen.begin(), chosen.end()};
}

Json json_run(const MethodRun& run) {
  Json iteration = Json::array(), seconds = Json::array(), energy = Json::array(),
       gradient_norm = Json::array(), step = Json::array(), measure = Json::array();
  for (const std::size_t i : drawn_points(run.points.size())) {
    const ComparisonPoint& point = run.points[i];
    iteration.push_back(point.iteration);
    seconds.push_back(short_number(point.seconds));
    energy.push_back(json_number(point.energy));
    gradient_norm.push_back(short_number(point.gradient_norm));
    step.push_back(short_number(point.step));
    measure.push_back(short_number(point.measure));
  }
  return {{"method", run.method},           {"status", run.status}, {"count", run.points.size()},
          {"iteration", iteration},         {"seconds", seconds},   {"energy", energy},
          {"gradient_norm", gradient_norm}, {"step", step},         {"measure", measure}};
}

std::string json_data(const Comparison& comparison) {
  Json runs = Json::array();
  for (const MethodRun& run : comparison.runs) runs.push_back(json_run(run));
  return script_json({{"title", comparison.title},
                      {"machine", comparison.machine},
                      {"best", json_number(comparison.best_energy())},
                      {"fractions", kComparisonFractions},
                      {"measure", comparison.measure},
                      {"runs", runs}});
}

// Returns the least seconds until a run is within a fraction of the best energy; +inf if none is.
double fastest(const Comparison& comparison, double best, double fraction) {
  double least = std::numeric_limits<double>::infinity();
  for (const MethodRun& run : comparison.runs) {
    const ComparisonPoint* point = first_within(run, best, fraction);
    if (point) least = std::min(least, point->seconds);
  }
  return least;
}

// The further columns with their names. Columns without numbers are left out.
struct PlainColumn {
  std::string name;
  std::string ComparisonRow::*cell;
};
std::vector<PlainColumn> plain_columns(const Comparison& comparison) {
  std::vector<PlainColumn> columns{{"iterations", &ComparisonRow::iterations},
                                   {"factorizations", &ComparisonRow::factorizations},
                                   {"seconds", &ComparisonRow::seconds},
                                   {"final energy", &ComparisonRow::energy},
                                   {"excess", &ComparisonRow::excess},
                                   {"gradient", &ComparisonRow::gradient_norm},
                                   {"distance", &ComparisonRow::distance},
                                   {comparison.measure, &ComparisonRow::measure},
                                   {"assemble", &ComparisonRow::assemble},
                                   {"factorize", &ComparisonRow::factorize},
                                   {"solve", &ComparisonRow::solve},
                                   {"line search", &ComparisonRow::line_search}};
  const std::vector<ComparisonRow> rows = comparison_rows(comparison);
  std::erase_if(columns, [&](const PlainColumn& column) {
    return std::all_of(rows.begin(), rows.end(),
                       [&](const ComparisonRow& row) { return row.*column.cell == "-"; });
  });
  return columns;
}

// The columns that methods are compared by come first, so that narrow windows show them.
std::string table_head(const Comparison& comparison) {
  std::string first, second;
  for (const double fraction : kComparisonFractions) {
    first += fmt::format(
        "<th colspan=\"2\" scope=\"colgroup\" class=\"group\">"
        "<span>to within {:g}&nbsp;%</span></th>",
        100.0 * fraction);
    second += "<th scope=\"col\" class=\"group\">iterations</th><th scope=\"col\">seconds</th>";
  }
  const auto column = [](const char* kind, const std::string& name) {
    return fmt::format("<th scope=\"col\" rowspan=\"2\"{}>{}</th>", kind, html_text(name));
  };
  std::string columns = column(" class=\"text group\"", "status");
  for (const PlainColumn& plain : plain_columns(comparison)) columns += column("", plain.name);
  return fmt::format("<tr>{}{}{}</tr>\n<tr>{}</tr>", column("", "method"), first, columns, second);
}

// Returns the message of a run and its notes, each on a line of its own.
std::string remarks(const ComparisonRow& row, const MethodRun& run) {
  std::string text;
  if (!row.message.empty()) text = fmt::format("<small>{}</small>", html_text(row.message));
  for (const std::string& note : run.notes)
    text += fmt::format("<small>{}</small>", html_text(note));
  return text;
}

std::string table_body(const Comparison& comparison) {
  const double best = comparison.best_energy();
  const auto rows = comparison_rows(comparison);
  const std::vector<PlainColumn> columns = plain_columns(comparison);
  std::string body;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ComparisonRow& row = rows[i];
    const MethodRun& run = comparison.runs[i];
    const bool wins = !run.points.empty() && run.points.back().energy == best;
    body += fmt::format("<tr><th scope=\"row\"><span data-run=\"{}\">{}</span></th>", i,
                        html_text(row.method));
    for (std::size_t k = 0; k < kComparisonFractions.size(); ++k) {
      const ComparisonPoint* point = first_within(run, best, kComparisonFractions[k]);
      const bool leads =
          point && point->seconds == fastest(comparison, best, kComparisonFractions[k]);
      body += fmt::format("<td class=\"group\">{}</td><td{}>{}</td>", row.iterations_to[k],
                          leads ? " class=\"least\"" : "", row.seconds_to[k]);
    }
    body +=
        fmt::format("<td class=\"text group\">{}{}</td>", html_text(row.status), remarks(row, run));
    for (const PlainColumn& column : columns)
      body += fmt::format("<td{}>{}</td>",
                          wins && column.cell == &ComparisonRow::energy ? " class=\"least\"" : "",
                          row.*column.cell);
    body += "</tr>\n";
  }
  return body;
}

std::string notes(const Comparison& comparison) {
  const double best = comparison.best_energy();
  std::string text = "No run has a finite energy.";
  if (best == 0.0) {
    text =
        "The best energy of all runs is 0: excess is the energy itself, and only 0 is within a "
        "percentage of it.";
  } else if (std::isfinite(best)) {
    text = fmt::format(
        "Best energy of all runs: {:.10g}. Excess is (E &minus; E<sub>best</sub>) / "
        "|E<sub>best</sub>|.",
        best);
  }
  text += " Iteration 0 is the start. Bold: the best final energy, the fewest seconds.";
  for (const std::string& note : comparison.notes)
    text += fmt::format(" Note: {}.", html_text(note));
  const bool thinned =
      std::any_of(comparison.runs.begin(), comparison.runs.end(),
                  [](const MethodRun& run) { return run.points.size() > kDrawnPoints; });
  if (thinned) {
    text += fmt::format(
        " Runs of more than {0} points are drawn with at most {0}: the start, the "
        "end, and points at even steps and at even ratios of their number; the "
        "table is made from all of them.",
        kDrawnPoints);
  }
  return text;
}

}  // namespace

std::string comparison_html_table(const Comparison& comparison) {
  return fmt::format("<table>\n<thead>\n{}\n</thead>\n<tbody>\n{}</tbody>\n</table>\n<p>{}</p>\n",
                     table_head(comparison), table_body(comparison), notes(comparison));
}

std::string comparison_page(const Comparison& comparison) {
  return fill_in(comparison_page_html(), {{"title", html_text(comparison.title)},
                                          {"machine", html_text(comparison.machine)},
                                          {"style", std::string(comparison_page_css())},
                                          {"head", table_head(comparison)},
                                          {"body", table_body(comparison)},
                                          {"notes", notes(comparison)},
                                          {"data", json_data(comparison)},
                                          {"script", std::string(comparison_page_js())}});
}

void write_comparison_csv(const std::string& path, const Comparison& comparison) {
  write_file_atomically(path, comparison_points_csv(comparison));
}

void write_comparison_rows(const std::string& path, const Comparison& comparison) {
  write_file_atomically(path, comparison_rows_csv(comparison));
}

void write_comparison_html(const std::string& path, const Comparison& comparison) {
  write_file_atomically(path, comparison_page(comparison));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
