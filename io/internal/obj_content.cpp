#include "majorant/io/internal/obj_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/internal/mesh_readers.h"

namespace majorant {
namespace {

std::string out_of_range(const ObjIndexSpace& space, long long index) {
  return fmt::format("{} index {} out of range, the file has {}", space.name, index, space.count);
}

void require_in_range(const ObjContent& content, const ObjIndexSpace& space) {
  if (space.largest <= space.count) return;
  throw Error(ErrorKind::Unreadable,
              fmt::format("{}:{}: {}; correct the face", content.mesh.file, space.largest_line,
                          out_of_range(space, space.largest)));
}

// Records the blocks of vertices if they stand between directives (PolygonMesh::directives).
void mark_blocks(ObjContent& content) {
  const auto all = static_cast<Index>(content.mesh.positions.size());
  if (content.vertices_before.empty() || content.vertices_before.front() == all) return;
  std::vector<std::pair<Index, std::string>> marked;
  Index vertices = 0;
  const auto mark = [&](Index polygon, Index before) {
    if (before > vertices) marked.emplace_back(polygon, fmt::format("v {}", before));
    vertices = std::max(vertices, before);
  };
  for (std::size_t k = 0; k < content.mesh.directives.size(); ++k) {
    mark(content.mesh.directives[k].first, content.vertices_before[k]);
    marked.push_back(std::move(content.mesh.directives[k]));
  }
  mark(static_cast<Index>(content.mesh.polygons.size()), all);
  content.mesh.directives = std::move(marked);
}

std::string warning_of(const SkippedLines& skipped, const std::string& file) {
  return fmt::format("{}:{}: {} line{} skipped that say nothing about polygons, of {}{}", file,
                     skipped.first, skipped.count, skipped.count == 1 ? "" : "s",
                     fmt::join(skipped.names, ", "),
                     skipped.names.size() == SkippedLines::kMaxNames ? " and maybe others" : "");
}

void drop_elements_out_of_range(ObjContent& content) {
  std::vector<char> is_dropped(content.mesh.directives.size(), 0);
  for (const ObjElement& element : content.elements)
    if (to_size(element.largest) >= content.mesh.positions.size()) {
      is_dropped[element.directive] = 1;
      content.dropped.add(DroppedPart::Element, [&] {
        return fmt::format("{}:{}: {}", content.mesh.file, element.line,
                           out_of_range(content.spaces[0], element.largest + 1));
      });
    }
  auto next = is_dropped.begin();
  std::erase_if(content.mesh.directives, [&](const auto&) { return *next++ != 0; });
  next = is_dropped.begin();
  std::erase_if(content.vertices_before, [&](Index) { return *next++ != 0; });
}

void drop_unusable_attributes(ObjContent& content) {
  const auto warn = [&content](DroppedPart part, const ObjIndexSpace& space) {
    return [&content, part, &space](std::size_t polygon, Index index) {
      content.dropped.add(part, [&] {
        return fmt::format("{}:{}: {}", content.mesh.file, content.mesh.polygon_lines[polygon],
                           index < space.count
                               ? fmt::format("{} {} is left out", space.name, index + 1)
                               : out_of_range(space, index + 1LL));
      });
    };
  };
  std::vector<Vector3> nothing;
  drop_unusable(content.mesh.texcoords, content.mesh.texcoord_rounding,
                content.mesh.polygon_texcoords,
                warn(DroppedPart::FaceTexcoords, content.spaces[1]));
  drop_unusable(content.mesh.normals, nothing, content.mesh.polygon_normals,
                warn(DroppedPart::FaceNormals, content.spaces[2]));
}

}  // namespace

void append(ObjContent& content, ObjContent&& next) {
  const long lines = content.lines;
  const auto polygons = static_cast<Index>(content.mesh.polygons.size());
  for (const Index vertices : next.vertices_before)
    content.vertices_before.push_back(vertices + static_cast<Index>(content.mesh.positions.size()));
  if (!content.mesh.colors.empty() || !next.mesh.colors.empty()) {
    content.mesh.colors.resize(content.mesh.positions.size(), no_attribute<3>());
    next.mesh.colors.resize(next.mesh.positions.size(), no_attribute<3>());
  }
  for (const auto lists : {&PolygonMesh::polygon_texcoords, &PolygonMesh::polygon_normals}) {
    if ((content.mesh.*lists).empty() && (next.mesh.*lists).empty()) continue;
    (content.mesh.*lists).resize(content.mesh.polygons.size());
    (next.mesh.*lists).resize(next.mesh.polygons.size());
  }
  for (ObjElement element : next.elements) {
    element.directive += content.mesh.directives.size();
    element.line += lines;
    content.elements.push_back(element);
  }
  for (auto& [polygon, text] : next.mesh.directives)
    content.mesh.directives.emplace_back(polygon + polygons, std::move(text));
  for (long& line : next.mesh.polygon_lines) line += lines;
  const auto move_behind = [](auto& list, auto& more) {
    list.insert(list.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
  };
  move_behind(content.mesh.positions, next.mesh.positions);
  move_behind(content.mesh.colors, next.mesh.colors);
  move_behind(content.mesh.texcoords, next.mesh.texcoords);
  move_behind(content.mesh.texcoord_rounding, next.mesh.texcoord_rounding);
  move_behind(content.mesh.normals, next.mesh.normals);
  move_behind(content.mesh.polygon_lines, next.mesh.polygon_lines);
  content.mesh.polygons.append(next.mesh.polygons);
  content.mesh.polygon_texcoords.append(next.mesh.polygon_texcoords);
  content.mesh.has_partial_layout |= next.mesh.has_partial_layout;
  content.mesh.polygon_normals.append(next.mesh.polygon_normals);
  for (std::size_t k = 0; k < content.spaces.size(); ++k) {
    content.spaces[k].count += next.spaces[k].count;
    if (next.spaces[k].largest <= content.spaces[k].largest) continue;
    content.spaces[k].largest = next.spaces[k].largest;
    content.spaces[k].largest_line = next.spaces[k].largest_line + lines;
  }
  content.lines += next.lines;
}

PolygonMesh conclude(ObjContent content) {
  require_in_range(content, content.spaces[0]);
  require_complete(content.mesh);
  drop_unusable_attributes(content);
  drop_elements_out_of_range(content);
  mark_blocks(content);
  if (!content.mesh.colors.empty())
    content.mesh.colors.resize(content.mesh.positions.size(), no_attribute<3>());
  if (content.skipped.count > 0)
    content.mesh.warnings.push_back(warning_of(content.skipped, content.mesh.file));
  content.dropped.conclude(content.mesh);
  for (auto* lists : {&content.mesh.polygon_texcoords, &content.mesh.polygon_normals})
    if (lists->indices().empty()) lists->clear();
  return std::move(content.mesh);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
