#include "majorant/pictures/internal/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/base64.h"
#include "majorant/io/json_depth.h"
#include "majorant/io/layout_scale.h"
#include "majorant/maps/bezier_cell.h"
#include "majorant/maps/energy_text.h"
#include "majorant/pictures/color_scale.h"
#include "majorant/pictures/first_view.h"
#include "majorant/pictures/internal/alignment.h"
#include "majorant/pictures/internal/legend.h"

namespace majorant {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "arrays are written as they are");

template <class T>
Json base64_of(const std::vector<T>& values) {
  std::string text;
  append_base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)}, text);
  return text;
}

// Encodes an Eigen array as values of type T, row by row.
template <class T, class Array>
Json base64_of_rows(const Array& rows) {
  std::vector<T> values;
  values.reserve(static_cast<std::size_t>(rows.size()));
  for (Index r = 0; r < rows.rows(); ++r)
    for (Index c = 0; c < rows.cols(); ++c) values.push_back(static_cast<T>(rows(r, c)));
  return base64_of(values);
}

void refuse_unless(bool holds, const std::string& problem) {
  if (!holds) throw Error(ErrorKind::Invalid, "a page cannot show this: " + problem);
}

// The order of points in the page: corners first, without unused points.
class PageOrder {
 public:
  explicit PageOrder(const MapFile& map)
      : number_(to_size(static_cast<Index>(map.points.rows())), -1) {
    const Cells corners = map.cells.leftCols(3);
    add(corners);
    corner_count_ = static_cast<Index>(points_.size());
    add(map.cells);
  }

  Index corner_count() const { return corner_count_; }
  const std::vector<Index>& points() const { return points_; }  // of the map, by number in the page
  Index number(Index point) const { return number_[point]; }

  // Returns the rows of these points.
  template <class Array>
  Array rows(const Array& of_points, Index count) const {
    Array rows(count, of_points.cols());
    for (Index p = 0; p < count; ++p) rows.row(p) = of_points.row(points_[p]);
    return rows;
  }

 private:
  // Adds cells by ascending numbers of the map.
  void add(const Cells& cells) {
    std::vector<char> is_new(number_.size(), 0);
    for (const Index point : cells.reshaped()) is_new[point] = number_[point] < 0;
    for (std::size_t point = 0; point < is_new.size(); ++point) {
      if (!is_new[point]) continue;
      number_[point] = static_cast<Index>(points_.size());
      points_.push_back(static_cast<Index>(point));
    }
  }

  std::vector<Index> number_;  // number in the page; -1 for unused points
  std::vector<Index> points_;
  Index corner_count_ = 0;
};

// Returns cells with local control points by falling i, then falling j (multi-index i, j, k).
Json cells_of(const MapFile& map, const PageOrder& order) {
  const auto multi_indices = bezier_multi_indices(map.degree);
  std::vector<std::size_t> locals(multi_indices.size());
  for (std::size_t l = 0; l < locals.size(); ++l) locals[l] = l;
  std::sort(locals.begin(), locals.end(),
            [&](std::size_t a, std::size_t b) { return multi_indices[a] > multi_indices[b]; });
  std::vector<std::uint32_t> numbers;
  numbers.reserve(static_cast<std::size_t>(map.cells.size()));
  for (Index cell = 0; cell < map.cells.rows(); ++cell)
    for (const std::size_t local : locals)
      numbers.push_back(
          static_cast<std::uint32_t>(order.number(map.cells(cell, static_cast<Index>(local)))));
  return base64_of(numbers);
}

// Returns uv and cells alone.
Json plane_of(const MapFile& map) {
  const PageOrder order(map);
  const auto count = static_cast<Index>(order.points().size());
  return {{"faces", map.cells.rows()},
          {"degree", map.degree},
          {"uv", base64_of_rows<double>(order.rows(map.uv, count))},
          {"cells", cells_of(map, order)}};
}

// Returns [[corner, quarter turns]] for every copy.
Json cones_of(const MapFile& map, const PageOrder& order) {
  Json cones = Json::array();
  if (map.cone.size() == 0) return cones;
  for (Index corner = 0; corner < order.corner_count(); ++corner) {
    const int turns = map.cone[order.points()[corner]];
    if (turns != 0) cones.push_back({corner, turns});
  }
  return cones;
}

Json points_section(const MapPage& page, const PageOrder& order) {
  std::map<Index, std::vector<Index>> copies;
  for (Index corner = 0; corner < order.corner_count(); ++corner)
    if (page.map.input_vertex.size() > 0)
      copies[page.map.input_vertex[order.points()[corner]]].push_back(corner);
  Json points = Json::array();
  for (const PagePoint& point : page.points) {
    const auto found = copies.find(point.vertex);
    refuse_unless(point.vertex >= 0 && found != copies.end() && point.target.allFinite(),
                  fmt::format("a point at vertex {}, which the map does not have", point.vertex));
    points.push_back({{"vertex", point.vertex},
                      {"corners", found->second},
                      {"target", {point.target.x(), point.target.y()}},
                      {"hold", point.hold == PagePoint::Hold::Pin ? "pin" : "handle"}});
  }
  return points;
}

Json faults_of(const MapPage& page) {
  Json faults = Json::array();
  for (const PageFault& fault : page.faults) {
    refuse_unless(fault.cell >= 0 && fault.cell < page.map.cells.rows(),
                  fmt::format("cell {}, which the map does not have", fault.cell));
    faults.push_back({{"face", fault.cell}, {"text", fault.text}});
  }
  return faults;
}

Json snapshots_of(const MapPage& page, const PageOrder& order) {
  Json snapshots = Json::array();
  for (const PageSnapshot& snapshot : page.snapshots) {
    refuse_unless(snapshot.uv.rows() == page.map.uv.rows() && snapshot.uv.allFinite(),
                  fmt::format("a snapshot with other points, of iteration {}", snapshot.iteration));
    const auto count = static_cast<Index>(order.points().size());
    snapshots.push_back({{"iteration", snapshot.iteration},
                         {"degree", snapshot.degree},
                         {"energy", snapshot.energy},
                         {"uv", base64_of_rows<float>(order.rows(snapshot.uv, count))}});
  }
  return snapshots;
}

Json scale_of(Quantity quantity, const ColorScale& scale) {
  std::vector<std::uint8_t> colors;
  for (const Color& color : scale.colors())
    colors.insert(colors.end(), {color.red, color.green, color.blue});
  Json ticks = Json::array();
  for (const ColorScale::Tick& tick : scale.ticks())
    ticks.push_back({{"value", tick.value}, {"label", tick.label}, {"position", tick.position}});
  return {{"name", quantity_name(quantity)},
          {"label", scale.label()},
          {"diverging", scale.shape() == ColorScale::Shape::Diverging},
          {"low", scale.low()},
          {"neutral", scale.neutral()},
          {"high", scale.high()},
          {"unit", scale.unit()},
          {"colors", base64_of(colors)},
          {"ticks", ticks}};
}

Quantity shown_first(const MapPage& page) { return page.quantity.value_or(Quantity::Density); }

// Returns the scales of all quantities; of the density only if the claims name an energy.
Json scales_of(const MapPage& page, const Json& claims) {
  std::optional<EnergySum> energy;
  const auto named = claims.find("energy");
  if (named != claims.end() && named->is_string())
    energy = find_energy_sum(named->get<std::string>());
  Json scales = Json::array();
  for (const Quantity quantity : kQuantities)
    if (energy || quantity != Quantity::Density)
      scales.push_back(
          scale_of(quantity,
                   picture_scale(claimed_energy(page.map), quantity,
                                 quantity == shown_first(page) ? page.color_range : std::nullopt)));
  return scales;
}

Json parsed_object(const std::string& what, const std::string& text) {
  require_shallow_json(what, text);
  const Json parsed = Json::parse(text.empty() ? "{}" : text, nullptr, false);
  refuse_unless(parsed.is_object(), what + " is no JSON object");
  return parsed;
}

}  // namespace

Json page_data(const MapPage& page) {
  const MapFile& map = page.map;
  refuse_unless(map.degree <= kHighestPageDegree,
                fmt::format("degree {}; pages evaluate up to {}", map.degree, kHighestPageDegree));
  const PageOrder order(map);
  Json data = {{"format", 1}, {"title", page.title}};
  data.update(plane_of(map));
  data["corners"] = order.corner_count();
  data["positions"] = base64_of_rows<double>(order.rows(map.points, order.corner_count()));
  const Vector2 direction = picture_direction(map, page.alignment);
  data["direction"] = {direction.x(), direction.y()};
  const Vector3 eye = first_view(map);
  data["eye"] = {eye.x(), eye.y(), eye.z()};
  if (map.input_vertex.size() > 0)
    data["input_vertex"] =
        base64_of_rows<std::int32_t>(order.rows(map.input_vertex, order.corner_count()));
  if (map.input_face.size() > 0) data["input_face"] = base64_of_rows<std::int32_t>(map.input_face);
  if (map.chart.size() > 0) data["chart"] = base64_of_rows<std::int32_t>(map.chart);
  if (map.seam_edges.size() > 0) data["seam_edges"] = base64_of_rows<std::int32_t>(map.seam_edges);
  data["cones"] = cones_of(map, order);
  data["points"] = points_section(page, order);
  data["faults"] = faults_of(page);
  data["snapshots"] = snapshots_of(page, order);
  if (page.scaffold) data["scaffold"] = plane_of(*page.scaffold);
  data["scale"] = {{"value", layout_scale(map)}, {"assumed", has_assumed_scale(map)}};
  data["claims"] = parsed_object("the map's claims", map.claims);
  data["scales"] = scales_of(page, data["claims"]);
  data["show"] =
      page.quantity || page.color_range ? Json(quantity_name(shown_first(page))) : Json();
  data["facts"] = parsed_object("what is known of the map", page.facts);
  if (page.other) {
    refuse_unless(page.other->map.cells.rows() == map.cells.rows() && !page.other->other,
                  "two maps of different surfaces");
    data["other"] = page_data(*page.other);
  }
  return data;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
