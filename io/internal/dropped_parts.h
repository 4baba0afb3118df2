// Parts of a file that readers leave out because they are broken and do not define the shape. Each
// kind gets one warning with the first place and the number of occurrences.
//
//   DroppedParts dropped(Strictness::Shape);
//   dropped.add(DroppedPart::Normal, [] { return "a.obj:7: normal 'nan' is not finite"; });
//   dropped.conclude(polygons);   // warnings: "a.obj:7: normal 'nan' is not finite: left out"
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "majorant/io/read_mesh.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

enum class DroppedPart {
  Texcoord,
  FaceTexcoords,     // all coordinates of a face
  PartialTexcoords,  // all coordinates of a face, because some corners have none
  Normal,
  FaceNormals,
  PartialNormals,
  Color,
  Slash,    // after the last index of a corner
  Element,  // points and lines of an OBJ
  Line,     // a line more than the header announces
  Faces,    // fewer than the header announces
};

class DroppedParts {
 public:
  explicit DroppedParts(Strictness strictness) : strictness_(strictness) {}

  // Calls problem() for the first part of a kind: "file:line: what is wrong there". Throws
  // Error(Unreadable) with that text if the part must not be left out.
  template <class Problem>
  void add(DroppedPart part, const Problem& problem) {
    Entry& entry = entries_[static_cast<std::size_t>(part)];
    if (entry.count++ == 0) begin(part, entry, problem());
  }

  bool is_empty() const {
    return std::all_of(entries_.begin(), entries_.end(),
                       [](const Entry& e) { return e.count == 0; });
  }

  // Adds the warnings to the mesh.
  void conclude(PolygonMesh& mesh) const;

 private:
  struct Entry {
    long count = 0;
    std::string problem;  // of the first occurrence
  };
  void begin(DroppedPart part, Entry& entry, std::string problem) const;

  Strictness strictness_;
  std::array<Entry, static_cast<std::size_t>(DroppedPart::Faces) + 1> entries_;
};

// Empties those of `lists` that name a missing value, or one that is not finite, after calling
// dropped(list, index). Then removes values that are not finite from `values`, and their entries
// from `companions` (as many, or none), and renumbers the rest.
template <class Vector, class Dropped>
void drop_unusable(std::vector<Vector>& values, std::vector<Vector>& companions, IndexLists& lists,
                   const Dropped& dropped) {
  const auto is_bad = [&](Index k) {
    return k < 0 || to_size(k) >= values.size() || !values[k].allFinite();
  };
  if (std::any_of(lists.indices().begin(), lists.indices().end(), is_bad)) {
    IndexLists usable;
    for (std::size_t p = 0; p < lists.size(); ++p) {
      const std::span<const Index> list = lists[p];
      const auto bad = std::find_if(list.begin(), list.end(), is_bad);
      if (bad != list.end()) dropped(p, *bad);
      usable.push_back(bad == list.end() ? list : std::span<const Index>());
    }
    lists = std::move(usable);
  }
  std::vector<Index> numbers(values.size());
  std::size_t kept = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    numbers[k] = static_cast<Index>(kept);
    if (!values[k].allFinite()) continue;
    if (!companions.empty()) companions[kept] = companions[k];
    values[kept++] = values[k];
  }
  if (kept == values.size()) return;
  values.resize(kept);
  if (!companions.empty()) companions.resize(kept);
  for (Index& k : lists.indices()) k = numbers[k];
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
