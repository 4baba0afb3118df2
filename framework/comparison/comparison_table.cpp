#include "majorant/framework/comparison/comparison_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace majorant {
namespace {

constexpr const char* kNothing = "-";

// Keeps trailing zeros, so that digits of a column line up.
std::string number_text(double value, int digits) {
  return std::isnan(value) ? kNothing : fmt::format("{:#.{}g}", value, digits);
}

// Returns three digits, or all digits of a whole number of moderate size.
std::string short_text(double value) {
  const double size = std::abs(value);
  return size >= 100.0 && size < 1e6 ? fmt::format("{:.0f}", value) : number_text(value, 3);
}

// Returns two digits: a norm tells an order of magnitude.
std::string norm_text(double value) {
  return std::isnan(value) ? kNothing : fmt::format("{:.1e}", value);
}

std::string excess_text(double energy, double best) {
  const double excess = excess_energy(energy, best);
  if (std::isnan(excess)) return kNothing;
  return best == 0.0 ? short_text(excess) : short_text(100.0 * excess) + " %";
}

ComparisonRow row_of(const MethodRun& run, double best) {
  ComparisonRow row;
  row.method = run.method;
  row.status = run.status;
  row.message = run.message == run.status ? "" : run.message;
  row.iterations = row.factorizations = row.seconds = row.assemble = row.factorize = row.solve =
      row.line_search = row.energy = row.gradient_norm = row.measure = row.distance = row.excess =
          kNothing;
  if (!run.points.empty()) {
    const ComparisonPoint& last = run.points.back();
    row.iterations = fmt::format("{}", last.iteration);
    row.factorizations = fmt::format("{}", run.factorizations);
    row.seconds = short_text(last.seconds);
    row.assemble = short_text(run.seconds.assemble);
    row.factorize = short_text(run.seconds.factorize);
    row.solve = short_text(run.seconds.solve);
    row.line_search = short_text(run.seconds.line_search);
    row.energy = number_text(last.energy, 8);
    row.gradient_norm = norm_text(last.gradient_norm);
    row.measure = short_text(last.measure);
    row.distance = norm_text(run.distance);
    row.excess = excess_text(last.energy, best);
  }
  for (std::size_t i = 0; i < kComparisonFractions.size(); ++i) {
    const ComparisonPoint* point = first_within(run, best, kComparisonFractions[i]);
    row.iterations_to[i] = point ? fmt::format("{}", point->iteration) : kNothing;
    row.seconds_to[i] = point ? short_text(point->seconds) : kNothing;
  }
  return row;
}

// Replaces each character outside of ASCII by one '?'.
std::string ascii(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 && byte < 0xc0) continue;  // within a UTF-8 character
    result += byte >= 0x20 && byte < 0x7f ? c : '?';
  }
  return result;
}

// A column of the table: two lines of heading, then one cell for each method.
struct Column {
  std::vector<std::string> cells;
  bool is_text = false;  // aligned to the left
  bool is_kept = false;  // even if no method has a number

  bool shows() const {
    return is_kept || std::any_of(cells.begin() + 2, cells.end(),
                                  [](const std::string& cell) { return cell != kNothing; });
  }
};

std::vector<Column> columns_of(const Comparison& comparison) {
  const std::vector<ComparisonRow> rows = comparison_rows(comparison);
  std::vector<Column> columns;
  const auto add = [&](std::string above, std::string name, auto cell, bool is_kept = false) {
    Column column{{std::move(above), std::move(name)}, false, is_kept};
    for (const ComparisonRow& row : rows) column.cells.push_back(cell(row));
    columns.push_back(std::move(column));
  };
  using Row = const ComparisonRow&;
  add(
      "", "method", [](Row r) { return ascii(r.method); }, true);
  add(
      "", "status", [](Row r) { return ascii(r.status); }, true);
  columns[0].is_text = columns[1].is_text = true;
  add(
      "", "iterations", [](Row r) { return r.iterations; }, true);
  add("", "factorizations", [](Row r) { return r.factorizations; });
  add(
      "", "seconds", [](Row r) { return r.seconds; }, true);
  add("seconds", "assemble", [](Row r) { return r.assemble; });
  add("by part", "factorize", [](Row r) { return r.factorize; });
  add("", "solve", [](Row r) { return r.solve; });
  add("", "line search", [](Row r) { return r.line_search; });
  add(
      "", "final energy", [](Row r) { return r.energy; }, true);
  add("", "gradient", [](Row r) { return r.gradient_norm; });
  add("", "distance", [](Row r) { return r.distance; });
  add("", ascii(comparison.measure), [](Row r) { return r.measure; });
  for (std::size_t i = 0; i < kComparisonFractions.size(); ++i) {
    add(
        "to within", "iterations", [i](Row r) { return r.iterations_to[i]; }, true);
    add(
        fmt::format("{:g} %", 100.0 * kComparisonFractions[i]), "seconds",
        [i](Row r) { return r.seconds_to[i]; }, true);
  }
  std::erase_if(columns, [](const Column& column) { return !column.shows(); });
  return columns;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

}  // namespace

std::vector<ComparisonRow> comparison_rows(const Comparison& comparison) {
  const double best = comparison.best_energy();
  std::vector<ComparisonRow> rows;
  for (const MethodRun& run : comparison.runs) rows.push_back(row_of(run, best));
  return rows;
}

std::string comparison_table(const Comparison& comparison) {
  const std::vector<Column> columns = columns_of(comparison);
  std::vector<std::size_t> widths;
  for (const Column& column : columns)
    widths.push_back(
        std::max_element(column.cells.begin(), column.cells.end(),
                         [](const auto& a, const auto& b) { return a.size() < b.size(); })
            ->size());
  std::string text;
  for (std::size_t line = 0; line < 2 + comparison.runs.size(); ++line) {
    std::string joined;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::string& cell = columns[c].cells[line];
      joined += columns[c].is_text ? fmt::format("{:<{}}  ", cell, widths[c])
                                   : fmt::format("{:>{}}  ", cell, widths[c]);
    }
    text += joined.substr(0, joined.find_last_not_of(' ') + 1) + "\n";
  }
  for (const MethodRun& run : comparison.runs) {
    if (!run.message.empty() && run.message != run.status)
      text += ascii(run.method) + ": " + ascii(run.message) + "\n";
    for (const std::string& note : run.notes) text += ascii(run.method) + ": " + ascii(note) + "\n";
  }
  for (const std::string& note : comparison.notes) text += "note: " + ascii(note) + "\n";
  return text;
}

std::string comparison_rows_csv(const Comparison& comparison) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "method,status,iterations,factorizations,seconds,assemble,factorize,solve,"
                 "line_search,energy,gradient_norm,distance,definite,notes\n");
  for (const MethodRun& run : comparison.runs) {
    const double nan = std::nan("");
    const ComparisonPoint last =
        run.points.empty() ? ComparisonPoint{0, 0, nan, nan, nan} : run.points.back();
    std::string notes = run.message == run.status ? "" : run.message;
    for (const std::string& note : run.notes) notes += (notes.empty() ? "" : "; ") + note;
    fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(run.method),
                   csv_field(run.status), last.iteration, run.factorizations, last.seconds,
                   run.seconds.assemble, run.seconds.factorize, run.seconds.solve,
                   run.seconds.line_search, last.energy, last.gradient_norm, run.distance,
                   definite_name(run.definite), csv_field(notes));
  }
  return {text.data(), text.size()};
}

std::string comparison_points_csv(const Comparison& comparison) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  const bool measures = !comparison.measure.empty();
  std::string measure = comparison.measure;
  std::replace(measure.begin(), measure.end(), ' ', '_');
  fmt::format_to(out, "method,iteration,seconds,energy,gradient_norm,step{}{}\n",
                 measures ? "," : "", csv_field(measure));
  for (const MethodRun& run : comparison.runs) {
    const std::string method = csv_field(run.method);
    for (const ComparisonPoint& point : run.points) {
      fmt::format_to(out, "{},{},{},{},{},{}", method, point.iteration, point.seconds, point.energy,
                     point.gradient_norm, point.step);
      if (measures) fmt::format_to(out, ",{}", point.measure);
      fmt::format_to(out, "\n");
    }
  }
  return {text.data(), text.size()};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
