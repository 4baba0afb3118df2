#include "apps/compare/comparison_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace majorant {
namespace {

constexpr const char* kNothing = "-";

// Trailing zeros stay: columns are read by comparing digits.
std::string number_text(double value, int digits) {
  return std::isnan(value) ? kNothing : fmt::format("{:#.{}g}", value, digits);
}

// Three digits, or all that a whole number of reasonable size has.
std::string short_text(double value) {
  const double size = std::abs(value);
  return size >= 100.0 && size < 1e6 ? fmt::format("{:.0f}", value) : number_text(value, 3);
}

std::string excess_text(double energy, double best) {
  const double excess = excess_energy(energy, best);
  if (std::isnan(excess)) return kNothing;
  return best == 0.0 ? short_text(excess) : short_text(100.0 * excess) + " %";
}

ComparisonRow row_of(const MethodRun& run, double best) {
  const std::string more = run.message == run.status ? "" : run.message;
  ComparisonRow row{run.method, run.status, more,     kNothing, kNothing,
                    kNothing,   kNothing,   kNothing, {},       {}};
  if (!run.points.empty()) {
    const ComparisonPoint& last = run.points.back();
    row.iterations = fmt::format("{}", last.iteration);
    row.seconds = short_text(last.seconds);
    row.energy = number_text(last.energy, 8);
    row.min_det = short_text(last.min_det);
    row.excess = excess_text(last.energy, best);
  }
  for (std::size_t i = 0; i < kComparisonFractions.size(); ++i) {
    const ComparisonPoint* point = first_within(run, best, kComparisonFractions[i]);
    row.iterations_to[i] = point ? fmt::format("{}", point->iteration) : kNothing;
    row.seconds_to[i] = point ? short_text(point->seconds) : kNothing;
  }
  return row;
}

// One '?' per character that a terminal of 1970 would not print.
std::string ascii(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 && byte < 0xc0) continue;  // within a UTF-8 character
    result += byte >= 0x20 && byte < 0x7f ? c : '?';
  }
  return result;
}

std::vector<std::string> cells_of(const ComparisonRow& row) {
  std::vector<std::string> cells = {ascii(row.method), ascii(row.status), row.iterations,
                                    row.seconds,       row.energy,        row.min_det};
  for (std::size_t i = 0; i < kComparisonFractions.size(); ++i) {
    cells.push_back(row.iterations_to[i]);
    cells.push_back(row.seconds_to[i]);
  }
  return cells;
}

}  // namespace

std::vector<ComparisonRow> comparison_rows(const Comparison& comparison) {
  const double best = comparison.best_energy();
  std::vector<ComparisonRow> rows;
  for (const MethodRun& run : comparison.runs) rows.push_back(row_of(run, best));
  return rows;
}

std::string comparison_table(const Comparison& comparison) {
  constexpr std::size_t kTextColumns = 2;  // aligned to the left
  const auto rows = comparison_rows(comparison);
  std::vector<std::vector<std::string>> lines = {
      {"", "", "", "", "", ""},
      {"method", "status", "iterations", "seconds", "final energy", "min det"}};
  for (const double fraction : kComparisonFractions) {
    lines[0].insert(lines[0].end(), {"to within", fmt::format("{:g} %", 100.0 * fraction)});
    lines[1].insert(lines[1].end(), {"iterations", "seconds"});
  }
  for (const ComparisonRow& row : rows) lines.push_back(cells_of(row));

  std::vector<std::size_t> widths(lines[0].size(), 0);
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const auto& line : lines) {
    std::string joined;
    for (std::size_t i = 0; i < line.size(); ++i) {
      joined += i < kTextColumns ? fmt::format("{:<{}}  ", line[i], widths[i])
                                 : fmt::format("{:>{}}  ", line[i], widths[i]);
    }
    text += joined.substr(0, joined.find_last_not_of(' ') + 1) + "\n";
  }
  for (const ComparisonRow& row : rows) {
    if (!row.message.empty()) text += ascii(row.method) + ": " + ascii(row.message) + "\n";
  }
  return text;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
