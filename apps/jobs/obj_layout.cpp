#include "majorant/apps/jobs/obj_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "majorant/parametrization/packing/pack.h"

namespace majorant {
namespace {

using Line = std::pair<Index, std::string>;

// Rewrites the directives: keeps those before each polygon that `keep` accepts, and adds the text
// that `before` returns for the polygon unless it is empty.
void rewrite(PolygonMesh& mesh, const std::function<bool(const Line&)>& keep,
             const std::function<std::string(std::size_t)>& before) {
  std::vector<Line> result;
  auto directive = mesh.directives.begin();
  const auto keep_up_to = [&](std::size_t polygon) {
    for (; directive != mesh.directives.end() && to_size(directive->first) <= polygon; ++directive)
      if (keep(*directive)) result.push_back(std::move(*directive));
  };
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p) {
    keep_up_to(p);
    if (std::string line = before(p); !line.empty())
      result.emplace_back(static_cast<Index>(p), std::move(line));
  }
  keep_up_to(mesh.polygons.size());
  mesh.directives = std::move(result);
}

}  // namespace

std::vector<int> chart_of_polygons(const MapFile& file, const PolygonMesh& polygons) {
  std::vector<int> chart(polygons.polygons.size(), -1);
  for (Index c = 0; c < file.chart.size(); ++c) {
    const Index face = file.input_face.size() > 0 ? file.input_face[c] : c;
    if (chart[face] < 0) chart[face] = file.chart[c];
  }
  return chart;
}

PolygonMesh with_tile_materials(PolygonMesh polygons, const std::vector<int>& tile) {
  const auto keep = [](const Line& directive) {
    const std::string_view word = directive_words(directive.second).first;
    return word != "usemtl" && word != "mtllib";
  };
  int current = -1;
  rewrite(polygons, keep, [&](std::size_t p) -> std::string {
    if (tile[p] < 0 || tile[p] == current) return {};
    current = tile[p];
    return fmt::format("usemtl {}", udim(current));
  });
  return polygons;
}

PolygonMesh with_chart_groups(PolygonMesh polygons, const std::vector<int>& chart) {
  std::string names, written = " ";  // names of the groups of the input; the previous line
  const auto keep = [&](const Line& directive) {
    const auto [word, rest] = directive_words(directive.second);
    if (word != "g") return true;
    names = rest;
    return false;
  };
  int current = -1;
  rewrite(polygons, keep, [&](std::size_t p) -> std::string {
    if (chart[p] >= 0) current = chart[p];
    if (current < 0) return {};
    std::string line = names.empty() ? fmt::format("g chart_{}", current)
                                     : fmt::format("g {} chart_{}", names, current);
    if (line == written) return {};
    written = line;
    return line;
  });
  return polygons;
}

PolygonMesh with_object_names(PolygonMesh polygons, const MeshObjects& objects) {
  std::string label;  // the previous line
  const auto keep = [&](const Line& directive) {
    const auto [word, rest] = directive_words(directive.second);
    if (word != "o") return true;
    label = rest;
    return false;
  };
  std::vector<std::string> names(to_size(objects.count()));
  std::set<std::string> taken;
  Index current = -1;
  rewrite(polygons, keep, [&](std::size_t p) -> std::string {
    const Index object = objects.of_polygon[p];
    if (object == current) return {};
    current = object;
    std::string& name = names[to_size(object)];
    if (name.empty()) {
      if (label.empty()) label = "object";
      name = label;
      for (int k = 2; !taken.insert(name).second; ++k) name = fmt::format("{}_{}", label, k);
      label.clear();
    }
    return "o " + name;
  });
  return polygons;
}

std::vector<std::string> material_of_polygons(const PolygonMesh& polygons) {
  std::vector<std::string> materials;
  std::string material;
  auto directive = polygons.directives.begin();
  for (std::size_t p = 0; p < polygons.polygons.size(); ++p) {
    for (; directive != polygons.directives.end() && to_size(directive->first) <= p; ++directive)
      if (const auto [word, rest] = directive_words(directive->second); word == "usemtl")
        material = rest;
    materials.push_back(material);
  }
  return materials;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
