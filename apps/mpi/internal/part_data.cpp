#include "apps/mpi/internal/part_data.h"

#include <algorithm>

#include "apps/mpi/internal/collect.h"

namespace majorant {
namespace {

Vec of_items(const Ranks& ranks, const std::vector<Index>& items, const Vec& whole, Index width) {
  if (ranks.of_first(whole.size()) == 0) return {};
  const auto lists = gathered(ranks, {items.begin(), items.end()});
  std::vector<std::vector<double>> values(lists.size());
  for (std::size_t r = 0; r < lists.size(); ++r)
    for (const double item : lists[r])
      for (Index k = 0; k < width; ++k)
        values[r].push_back(whole[width * static_cast<Index>(item) + k]);
  const std::vector<double> mine = scattered(ranks, std::move(values));
  return Eigen::Map<const Vec>(mine.data(), static_cast<Index>(mine.size()));
}

// whole: the number of items.
Vec whole_of_items(const Ranks& ranks, const std::vector<Index>& items, const Vec& mine,
                   GlobalIndex whole, Index width) {
  if (width == 0) return {};
  std::vector<double> sent(items.begin(), items.end());
  sent.insert(sent.end(), mine.begin(), mine.end());
  const auto lists = gathered(ranks, std::move(sent));
  if (ranks.rank() > 0) return {};
  Vec all(static_cast<Index>(whole) * width);
  for (const std::vector<double>& list : lists) {
    const std::size_t count = list.size() / static_cast<std::size_t>(1 + width);
    for (std::size_t k = 0; k < count; ++k)
      all.segment(width * static_cast<Index>(list[k]), width) =
          Eigen::Map<const Vec>(list.data() + count + k * static_cast<std::size_t>(width), width);
  }
  return all;
}

}  // namespace

Vec whole_of_vertices(const MeshPart& part, const Vec& mine, Index width) {
  return whole_of_items(part.ranks(), part.vertex, mine, part.whole.vertices, width);
}

Vec whole_of_faces(const MeshPart& part, const Vec& mine, Index width) {
  return whole_of_items(part.ranks(), part.face, mine, part.whole.faces, width);
}

Vec of_vertices(const MeshPart& part, const Vec& whole, Index width) {
  return of_items(part.ranks(), part.vertex, whole, width);
}

Vec of_faces(const MeshPart& part, const Vec& whole, Index width) {
  return of_items(part.ranks(), part.face, whole, width);
}

std::vector<Pin> pins_of_part(const MeshPart& part, const std::vector<Pin>& whole, Copies copies) {
  std::vector<double> sent;
  for (const Pin& p : whole) {
    const Vector2 target = p.target.value_or(Vector2::Zero());
    sent.insert(sent.end(),
                {static_cast<double>(p.vertex), p.target ? 1.0 : 0.0, target.x(), target.y()});
  }
  sent = broadcast(part.ranks(), std::move(sent));
  const Partition vertices = part.vertices();
  std::vector<Pin> points;
  for (std::size_t k = 0; k < sent.size(); k += 4) {
    const auto range =
        std::equal_range(part.vertex.begin(), part.vertex.end(), static_cast<Index>(sent[k]));
    for (auto v = range.first; v != range.second; ++v) {
      Pin point{static_cast<Index>(v - part.vertex.begin()), {}};
      if (copies == Copies::Owner && !vertices.owns(point.vertex)) continue;
      if (sent[k + 1] != 0) point.target = Vector2(sent[k + 2], sent[k + 3]);
      points.push_back(point);
    }
  }
  return points;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
