#include "majorant/io/internal/vtk_source.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <optional>
#include <utility>

#include "majorant/io/base64.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/text_cursor.h"

namespace majorant {
namespace {

// Points in one base64 text: a length and doubles.
class EncodedPoints final : public SourceFile {
 public:
  struct Region {
    std::size_t begin, size;  // of the text in the file
    std::size_t header_size;
    ByteOrder order;
  };
  EncodedPoints(std::string file, std::string content, Points3 original, NodeLists lists,
                const Region& region)
      : SourceFile(std::move(file), std::move(content), std::move(original), std::move(lists)),
        region_(region) {}

  std::string with_points(const Points3& points) const override {
    bool is_any_moved = false;
    for (Index p = 0; p < points.rows(); ++p)
      for (int axis = 0; axis < 3; ++axis) is_any_moved = is_any_moved || is_moved(points, p, axis);
    if (!is_any_moved) return content_;
    std::string data(region_.header_size, '\0');
    const auto bytes = static_cast<std::uint64_t>(points.size()) * sizeof(double);
    put(bytes, region_.header_size, data.data());
    data.resize(region_.header_size + bytes);
    for (Index k = 0; k < points.size(); ++k)
      put(points.data()[k], sizeof(double),
          data.data() + region_.header_size + to_size(k) * sizeof(double));
    std::string out = content_.substr(0, region_.begin);
    append_base64(data, out);
    out.append(content_, region_.begin + region_.size);
    return out;
  }

 private:
  // Stores the first `size` bytes of a little-endian value in the byte order of the file.
  template <class T>
  void put(const T& value, std::size_t size, char* to) const {
    std::memcpy(to, &value, size);
    if (region_.order == ByteOrder::Big) std::reverse(to, to + size);
  }
  Region region_;
};

// The source of a file whose points cannot be replaced in place.
class UnwritablePoints final : public SourceFile {
 public:
  UnwritablePoints(std::string file, std::string content, Points3 original, NodeLists lists,
                   std::string why)
      : SourceFile(std::move(file), std::move(content), std::move(original), std::move(lists)),
        why_(std::move(why)) {}
  std::string with_points(const Points3& points) const override {
    for (Index p = 0; p < points.rows(); ++p)
      for (int axis = 0; axis < 3; ++axis)
        if (is_moved(points, p, axis)) refuse_mesh(file_, why_);
    return content_;
  }

 private:
  std::string why_;
};

// Returns where the values of an appended array begin; none if they are base64.
std::optional<std::size_t> appended_begin(const VtkFile& file, const XmlElement& array) {
  const std::size_t tag = file.content.find("<AppendedData");
  const std::size_t end = file.content.find('>', tag), mark = file.content.find('_', end);
  if (file.content.substr(tag, end - tag).find("base64") != std::string::npos) return std::nullopt;
  std::size_t offset = 0;
  const std::string_view text = array.attribute("offset");
  std::from_chars(text.data(), text.data() + text.size(), offset);
  return mark + 1 + offset + file.document.arrays().header_size();
}

// Returns where the text of an array begins in the file: as in its XML, since appended data, which
// were removed, follow behind. None if the text is behind such data.
std::optional<std::size_t> text_begin(const VtkFile& file, const XmlElement& array) {
  const auto begin = static_cast<std::size_t>(array.text.data() - file.document.xml().data());
  if (file.content.compare(begin, array.text.size(), array.text) != 0) return std::nullopt;
  return begin;
}

// Returns the begin and the size of a text without the white space around it.
std::pair<std::size_t, std::size_t> trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n"),
                    last = text.find_last_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {text.size(), 0};
  return {first, last + 1 - first};
}

}  // namespace

std::size_t VtkEntries::place_of(std::size_t entry) const {
  if (lists.coding == NodeLists::Coding::Words) return entry < words.size() ? words[entry] : 0;
  return begin + entry * lists.width;
}

VtkEntries vtk_entries(const VtkFile& file, const XmlElement& array, std::size_t entries) {
  using Coding = NodeLists::Coding;
  const VtuArrays& arrays = file.document.arrays();
  VtkEntries found;
  NodeLists& lists = found.lists;
  const std::string_view format = array.attribute("format", "ascii"),
                         type = array.attribute("type");
  found.begin = arrays.header_size();
  if (type.ends_with("64"))
    lists.width = 8;
  else if (type.ends_with("32"))
    lists.width = 4;
  else
    lists.width = type.ends_with("16") ? 2 : 1;
  if (arrays.is_compressed() && format != "ascii") return found;
  if (format == "appended") {
    const std::optional<std::size_t> first = appended_begin(file, array);
    if (!first) return found;
    found.begin = *first;
    lists.coding = Coding::Bytes;
    return found;
  }
  const std::optional<std::size_t> begin = text_begin(file, array);
  if (!begin) return found;
  if (format == "ascii") {
    TextCursor words(file.path, array.text, TextLines::Space, file.stop);
    for (std::size_t k = 0; k < entries; ++k) {
      words.next_token();
      found.words.push_back(*begin + words.begin());
    }
    lists.coding = Coding::Words;
    return found;
  }
  const auto [first, size] = trimmed(array.text);
  if (size == 0) return found;
  lists.text_begin = *begin + first;
  lists.text_size = size;
  // The length and the integers are one text or two.
  const std::optional<std::string> bytes = decode_base64(array.text.substr(first, size));
  if (bytes && bytes->size() == arrays.header_size() + entries * lists.width)
    lists.coding = Coding::Base64;
  return found;
}

std::shared_ptr<const MeshSource> vtk_source(const VtkFile& file, const Points3& points,
                                             NodeLists lists) {
  using Placed = PlacedCoordinates;
  const XmlElement& array = file.document.points_array();
  const VtuArrays& arrays = file.document.arrays();
  const std::string_view format = array.attribute("format", "ascii");
  const auto unwritable = [&](const char* why) {
    return std::make_shared<const UnwritablePoints>(file.path, file.content, points,
                                                    std::move(lists), why);
  };
  const auto placed = [&](std::vector<Placed::Place> places, Placed::Coding coding) {
    return std::make_shared<const Placed>(file.path, file.content, points, std::move(lists),
                                          std::move(places), coding);
  };
  if (array.attribute("type") != "Float64")
    return unwritable("points that are no Float64 cannot be written back");
  if (arrays.is_compressed() && format != "ascii")
    return unwritable("compressed points cannot be written back");
  std::vector<Placed::Place> places;
  if (format == "appended") {
    const std::optional<std::size_t> first = appended_begin(file, array);
    if (!first) return unwritable("points appended as base64 cannot be written back");
    for (Index k = 0; k < points.size(); ++k)
      places.push_back({*first + to_size(k) * sizeof(double), sizeof(double)});
    return placed(std::move(places), arrays.order() == ByteOrder::Little
                                         ? Placed::Coding::Doubles
                                         : Placed::Coding::SwappedDoubles);
  }
  const std::optional<std::size_t> begin = text_begin(file, array);
  if (!begin) return unwritable("points behind the appended data cannot be written back");
  if (format == "ascii") {
    TextCursor words(file.path, array.text, TextLines::Space, file.stop);
    for (Index k = 0; k < points.size(); ++k) {
      const std::size_t size = words.next_token().size();
      places.push_back({*begin + words.begin(), static_cast<std::uint32_t>(size)});
    }
    return placed(std::move(places), Placed::Coding::Words);
  }
  const auto [first, size] = trimmed(array.text);
  return std::make_shared<const EncodedPoints>(
      file.path, file.content, points, std::move(lists),
      EncodedPoints::Region{*begin + first, size, arrays.header_size(), arrays.order()});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
