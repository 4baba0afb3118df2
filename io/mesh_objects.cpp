#include "majorant/io/mesh_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/claims.h"
#include "majorant/io/internal/gltf_scene.h"

namespace majorant {
namespace {

class Naming {
 public:
  // key: identifies the object.
  void add(const std::string& key, const std::string& name) {
    const auto next = static_cast<Index>(objects_.names.size());
    const auto [known, is_new] = number_.try_emplace(key, next);
    if (is_new) objects_.names.push_back(name);
    objects_.of_polygon.push_back(known->second);
  }
  MeshObjects take() { return std::move(objects_); }

 private:
  MeshObjects objects_;
  std::map<std::string, Index> number_;
};

MeshObjects objects_of_gltf(const PolygonMesh& mesh) {
  const GltfScene& scene = *mesh.gltf;
  const Gltf& meshes = scene.document.list("meshes");
  Naming naming;
  for (const GltfScene::Face& face : scene.faces) {
    const std::size_t k = scene.vertices[to_size(face.vertices)].mesh;
    const auto name = meshes[k].find("name");
    const bool is_named = name != meshes[k].end() && name->is_string();
    naming.add(std::to_string(k), is_named ? name->get<std::string>() : std::string());
  }
  return naming.take();
}

// Numbers the used elements of a list, in order.
class Used {
 public:
  explicit Used(std::size_t count) : number_(count, -1) {}
  void mark(std::span<const Index> list) {
    for (const Index k : list) number_[to_size(k)] = 0;
  }
  // Returns the used elements, in order.
  std::vector<Index> number() {
    std::vector<Index> used;
    for (std::size_t k = 0; k < number_.size(); ++k) {
      if (number_[k] < 0) continue;
      number_[k] = static_cast<Index>(used.size());
      used.push_back(static_cast<Index>(k));
    }
    return used;
  }
  void renumber(std::span<Index> list) const {
    for (Index& k : list) k = number_[to_size(k)];
  }

 private:
  std::vector<Index> number_;
};

template <class Value>
std::vector<Value> taken(const std::vector<Value>& all, const std::vector<Index>& which) {
  std::vector<Value> part;
  if (all.empty()) return part;
  part.reserve(which.size());
  for (const Index k : which) part.push_back(all[to_size(k)]);
  return part;
}

// Returns the lists of these polygons with the elements that they use; none if they are empty.
std::vector<Index> take_lists(const IndexLists& all, std::size_t count,
                              const std::vector<Index>& polygons, IndexLists& lists) {
  Used used(count);
  for (const Index p : polygons)
    if (!all.empty()) lists.push_back(all[to_size(p)]);
  used.mark(lists.indices());
  const std::vector<Index> which = used.number();
  if (which.empty()) lists.clear();
  used.renumber(lists.indices());
  return which;
}

}  // namespace

std::pair<std::string_view, std::string_view> directive_words(std::string_view line) {
  constexpr std::string_view kSpaces = " \t\r";
  const auto from = [](std::string_view text, std::size_t at) {
    return at == std::string_view::npos ? std::string_view() : text.substr(at);
  };
  line = from(line, line.find_first_not_of(kSpaces));
  const std::size_t end = std::min(line.find_first_of(kSpaces), line.size());
  std::string_view rest = line.substr(end);
  rest = from(rest, rest.find_first_not_of(kSpaces));
  return {line.substr(0, end), rest.substr(0, rest.find_last_not_of(kSpaces) + 1)};
}

MeshObjects objects_of(const PolygonMesh& mesh) {
  if (mesh.gltf) return objects_of_gltf(mesh);
  Naming naming;
  std::string name;
  auto directive = mesh.directives.begin();
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p) {
    for (; directive != mesh.directives.end() && to_size(directive->first) <= p; ++directive)
      if (const auto [word, rest] = directive_words(directive->second); word == "o") name = rest;
    naming.add(name, name);
  }
  return naming.take();
}

std::vector<Index> object_of_cells(const MeshObjects& objects, const MapFile& file) {
  std::vector<Index> layers;
  for (const int polygon : file.input_face) layers.push_back(objects.of_polygon[to_size(polygon)]);
  return layers;
}

std::optional<std::vector<Index>> claimed_object_of_cells(const MapFile& file,
                                                          const std::string& name) {
  const Claims claims = parse_claims(file.claims, name);
  if (!claims.objects) return std::nullopt;
  std::vector<std::int64_t> ends;  // by object: sum of its charts and those before
  for (const ClaimedObject& object : *claims.objects)
    ends.push_back((ends.empty() ? 0 : ends.back()) + object.charts);
  std::vector<Index> layers;
  for (Index c = 0; c < file.cells.rows(); ++c) {
    const Index chart = file.chart.size() > 0 ? file.chart[c] : 0;
    const auto object = std::upper_bound(ends.begin(), ends.end(), std::int64_t{chart});
    if (chart < 0 || object == ends.end())
      throw Error(
          ErrorKind::Unreadable,
          fmt::format("{}: majorant_claims.objects has no chart {}; damaged file", name, chart));
    layers.push_back(static_cast<Index>(object - ends.begin()));
  }
  return layers;
}

ObjectMesh object_mesh(const PolygonMesh& mesh, const MeshObjects& objects, Index object) {
  ObjectMesh part;
  PolygonMesh& out = part.mesh;
  out.file = mesh.file;
  out.position_rounding = mesh.position_rounding;
  std::vector<Index> before;  // for each polygon of the file: polygons of its object before it
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p) {
    before.push_back(static_cast<Index>(part.polygons.size()));
    if (objects.of_polygon[p] == object) part.polygons.push_back(static_cast<Index>(p));
  }
  before.push_back(static_cast<Index>(part.polygons.size()));
  part.vertices = take_lists(mesh.polygons, mesh.positions.size(), part.polygons, out.polygons);
  out.positions = taken(mesh.positions, part.vertices);
  out.colors = taken(mesh.colors, part.vertices);
  out.polygon_lines = taken(mesh.polygon_lines, part.polygons);
  const std::vector<Index> texcoords = take_lists(mesh.polygon_texcoords, mesh.texcoords.size(),
                                                  part.polygons, out.polygon_texcoords);
  out.texcoords = taken(mesh.texcoords, texcoords);
  out.texcoord_rounding = taken(mesh.texcoord_rounding, texcoords);
  out.normals = taken(mesh.normals, take_lists(mesh.polygon_normals, mesh.normals.size(),
                                               part.polygons, out.polygon_normals));
  for (const auto& [polygon, line] : mesh.directives) {
    const std::string_view word = directive_words(line).first;
    if (word == "p" || word == "l" || word == "v") continue;  // lines with numbers of vertices
    out.directives.emplace_back(
        before[to_size(std::min<Index>(polygon, static_cast<Index>(mesh.polygons.size())))], line);
  }
  return part;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
