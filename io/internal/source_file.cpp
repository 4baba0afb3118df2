#include "majorant/io/internal/source_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "majorant/framework/error.h"
#include "majorant/io/base64.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/text_cursor.h"
#include "majorant/volumes/node_orders.h"

namespace majorant {

std::string shortest(double x) { return fmt::format("{}", x); }

bool SourceFile::is_moved(const Points3& points, Index point, int axis) const {
  return std::bit_cast<std::uint64_t>(points(point, axis)) !=
         std::bit_cast<std::uint64_t>(original_(point, axis));
}

VolumeMesh SourceFile::with_turned(const std::vector<CellBlock>& blocks,
                                   const std::vector<CellName>& cells,
                                   const StopCheck& stop) const {
  return read_volume_content(file_, turned_content(blocks, cells), stop);
}

std::string SourceFile::turned_content(const std::vector<CellBlock>& blocks,
                                       const std::vector<CellName>& cells) const {
  using enum NodeLists::Coding;
  if (lists_.coding == Hidden)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: elements are turned around, and compressed lists of them cannot "
                            "be written back; save the mesh uncompressed",
                            file_));
  std::string bytes;  // changed in place, if the coding is not words
  if (lists_.coding == Bytes) bytes = content_;
  if (lists_.coding == Base64)
    bytes = decode_base64(content_.substr(lists_.text_begin, lists_.text_size)).value();
  std::vector<std::pair<std::size_t, std::vector<std::string_view>>> changes;  // replaced words
  for (const CellName& name : cells) {
    const NodeLists::OfBlock& lists = lists_.blocks[to_size(name.block)];
    const std::vector<int>& reflection = reflected_nodes(blocks[to_size(name.block)].type);
    const std::size_t begin = lists.begins[to_size(name.cell)];
    std::vector<std::size_t> from;  // new place of an entry -> old place
    for (const int place : lists.order)
      from.push_back(static_cast<std::size_t>(
          std::find(lists.order.begin(), lists.order.end(), reflection[to_size(place)]) -
          lists.order.begin()));
    if (lists_.coding == Words) {
      changes.emplace_back(begin, std::vector<std::string_view>());
      TextCursor words(file_, content_, TextLines::Space, {}, lists_.comments);
      words.go_to(begin);
      std::vector<std::string_view> old;
      for (std::size_t k = 0; k < from.size(); ++k) old.push_back(words.next_token());
      for (const std::size_t k : from) changes.back().second.push_back(old[k]);
      continue;
    }
    const std::string old = bytes.substr(begin, from.size() * lists_.width);
    for (std::size_t k = 0; k < from.size(); ++k)
      bytes.replace(begin + k * lists_.width, lists_.width, old, from[k] * lists_.width,
                    lists_.width);
  }
  if (lists_.coding == Bytes) return bytes;
  std::string out;
  if (lists_.coding == Base64) {
    out = content_.substr(0, lists_.text_begin);
    append_base64(bytes, out);
    return out.append(content_, lists_.text_begin + lists_.text_size);
  }
  std::sort(changes.begin(), changes.end());
  std::size_t at = 0;
  TextCursor words(file_, content_, TextLines::Space, {}, lists_.comments);
  for (const auto& [begin, list] : changes) {
    words.go_to(begin);
    for (const std::string_view word : list) {
      words.next_token();
      out.append(content_, at, words.begin() - at);
      out += word;
      at = words.place();
    }
  }
  return out.append(content_, at);
}

std::string PlacedCoordinates::coded(double x) const {
  if (coding_ == Coding::Words) return shortest(x);
  std::string bytes(sizeof(x), '\0');
  std::memcpy(bytes.data(), &x, sizeof(x));
  if (coding_ == Coding::SwappedDoubles) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string PlacedCoordinates::with_points(const Points3& points) const {
  struct Change {
    Place place;
    double value;
  };
  std::vector<Change> changes;
  for (Index p = 0; p < points.rows(); ++p)
    for (int axis = 0; axis < 3; ++axis) {
      if (!is_moved(points, p, axis)) continue;
      const Place& place = places_[to_size(3 * p + axis)];
      if (place.size == 0)
        throw Error(ErrorKind::Unsupported,
                    fmt::format("{}: point {} has no coordinate {} there", file_, p + 1, axis + 1));
      changes.push_back({place, points(p, axis)});
    }
  std::sort(changes.begin(), changes.end(),
            [](const Change& a, const Change& b) { return a.place.begin < b.place.begin; });
  std::string out;
  out.reserve(content_.size() + 8 * changes.size());
  std::size_t at = 0;
  for (const auto& [place, value] : changes) {
    out.append(content_, at, place.begin - at);
    out += coded(value);
    at = place.begin + place.size;
  }
  out.append(content_, at);
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
