#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>

#include "majorant/framework/error.h"
#include "majorant/io/base64.h"
#include "majorant/io/internal/cell_collector.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/source_file.h"
#include "majorant/io/internal/text_cursor.h"
#include "majorant/io/internal/vtk_document.h"
#include "majorant/io/internal/vtk_types.h"

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

class VtkCellReader {
 public:
  VtkCellReader(const std::string& path, std::string content, const StopCheck& stop)
      : path_(path),
        stop_(stop),
        original_(std::move(content)),
        file_(path, original_, stop),
        arrays_(file_.arrays()) {}

  VolumeMesh read() {
    VolumeMesh mesh;
    mesh.file = path_;
    mesh.points = file_.points();
    if (mesh.points.rows() == 0) file_.fail("no points");
    if (mesh.points.rows() > std::numeric_limits<Index>::max() / 4)
      refuse_mesh(path_, "too many points");
    read_cells(mesh);
    mesh.source = source_of(file_.points_array(), mesh.points);
    return mesh;
  }

 private:
  // Returns how the points are written back. The place in the file is that in its XML, since
  // appended data, which were removed, follow behind.
  std::shared_ptr<const MeshSource> source_of(const XmlElement& array,
                                              const Points3& points) const {
    using Placed = PlacedCoordinates;
    const bool is_double = array.attribute("type") == "Float64";
    const std::string_view format = array.attribute("format", "ascii");
    const auto unwritable = [&](const char* why) {
      return std::make_shared<const UnwritablePoints>(path_, original_, points, lists_, why);
    };
    if (!is_double) return unwritable("points that are no Float64 cannot be written back");
    if (arrays_.is_compressed() && format != "ascii")
      return unwritable("compressed points cannot be written back");
    if (format == "appended") return appended(array, points, unwritable);
    const auto begin = static_cast<std::size_t>(array.text.data() - file_.xml().data());
    if (original_.compare(begin, array.text.size(), array.text) != 0)
      return unwritable("points behind the appended data cannot be written back");
    if (format == "ascii") {
      TextCursor words(path_, array.text, TextLines::Space, stop_);
      std::vector<Placed::Place> places;
      for (Index k = 0; k < points.size(); ++k) {
        const std::size_t size = words.next_token().size();
        places.push_back({begin + words.begin(), static_cast<std::uint32_t>(size)});
      }
      return std::make_shared<const Placed>(path_, original_, points, lists_, std::move(places),
                                            Placed::Coding::Words);
    }
    const std::size_t first = array.text.find_first_not_of(" \t\r\n"),
                      last = array.text.find_last_not_of(" \t\r\n");
    return std::make_shared<const EncodedPoints>(
        path_, original_, points, lists_,
        EncodedPoints::Region{begin + first, last + 1 - first, arrays_.header_size(),
                              arrays_.order()});
  }

  template <class Unwritable>
  std::shared_ptr<const MeshSource> appended(const XmlElement& array, const Points3& points,
                                             const Unwritable& unwritable) const {
    using Placed = PlacedCoordinates;
    const std::optional<std::size_t> first = appended_begin(array);
    if (!first) return unwritable("points appended as base64 cannot be written back");
    std::vector<Placed::Place> places;
    for (Index k = 0; k < points.size(); ++k)
      places.push_back({*first + to_size(k) * sizeof(double), sizeof(double)});
    return std::make_shared<const Placed>(path_, original_, points, lists_, std::move(places),
                                          arrays_.order() == ByteOrder::Little
                                              ? Placed::Coding::Doubles
                                              : Placed::Coding::SwappedDoubles);
  }

  // Returns whether a quad, hexahedron or wedge with different degrees per direction may have so
  // many points.
  static bool is_of_more_degrees(CellShape shape, std::size_t points) {
    if (shape == CellShape::Quad) return is_grid(points, 2);
    if (shape == CellShape::Hexahedron) return is_grid(points, 3);
    if (shape != CellShape::Wedge) return false;
    for (std::size_t side = 2; side <= points; ++side) {
      const std::size_t of_triangle = side * (side + 1) / 2;
      if (points % of_triangle == 0 && is_grid(points / of_triangle, 1)) return true;
    }
    return false;
  }
  // Returns whether `points` is a product of so many factors of at least 2.
  static bool is_grid(std::size_t points, int directions) {
    if (directions == 1) return points >= 2;
    for (std::size_t a = 2; a < points; ++a)
      if (points % a == 0 && is_grid(points / a, directions - 1)) return true;
    return false;
  }

  CellType type_of(std::size_t cell, long long number, std::size_t points) const {
    const std::optional<VtkType> known = vtk_type(number);
    if (!known)
      refuse_mesh(path_, is_vtk_pyramid(number)
                             ? fmt::format("cell {} is a pyramid; tetrahedra, hexahedra, wedges, "
                                           "triangles and quads are supported",
                                           cell)
                             : fmt::format("cell {} of VTK's type {}; linear, quadratic, Lagrange "
                                           "and Bezier simplices, quads, hexahedra and wedges are "
                                           "supported",
                                           cell, number));
    CellType type{known->shape, known->degree, known->kind, known->set};
    if (type.degree == 0) {
      type.degree = 1;
      while (to_size(type.node_count()) < points && type.degree <= CellType::kMaxDegree)
        ++type.degree;
      const bool is_one = to_size(type.node_count()) == points;
      if (type.degree > CellType::kMaxDegree || (!is_one && is_of_more_degrees(type.shape, points)))
        refuse_degrees(cell, fmt::format("{} points", points));
    }
    if (to_size(type.node_count()) != points)
      file_.fail(fmt::format("cell {} has {} points, {} have {}", cell, points, describe(type),
                             type.node_count()));
    // Straight cells are the same for all kinds of nodes.
    if (type.degree == 1) type.kind = NodeKind::Uniform;
    return type;
  }

  // Returns whether most linear wedges of the file have VTK's order, in which the triangle of the
  // first three nodes faces outwards [vtkWedge.h]. In wedges of higher degree it faces inwards, and
  // many programs write linear wedges like that, too.
  static bool has_outward_wedges(const std::vector<long long>& connectivity,
                                 const std::vector<long long>& offsets,
                                 const std::vector<long long>& types, const Points3& points) {
    constexpr long long kNodes = 6;
    Index outward = 0, inward = 0;
    for (std::size_t c = 0; c < types.size(); ++c) {
      const long long end = offsets[c];
      if (types[c] != kLinearWedge || end < kNodes ||
          end > static_cast<long long>(connectivity.size()))
        continue;
      const auto node = [&](long long k) {
        return connectivity[static_cast<std::size_t>(end - kNodes + k)];
      };
      bool is_known = true;
      for (long long k = 0; k < kNodes; ++k) is_known &= node(k) >= 0 && node(k) < points.rows();
      if (!is_known) continue;
      const auto at = [&](long long k) -> Vector3 {
        return points.row(static_cast<Index>(node(k)));
      };
      const Vector3 up = at(3) + at(4) + at(5) - at(0) - at(1) - at(2);
      const double volume = (at(1) - at(0)).cross(at(2) - at(0)).dot(up);
      outward += volume < 0;
      inward += volume > 0;
    }
    return outward > inward;
  }

  // Before version 2.1 of the format, edges 2-6 and 3-7 of Lagrange and Bezier hexahedra were
  // exchanged.
  std::vector<int> order_of(const CellType& type, long long number) const {
    if (number == kLinearWedge && has_outward_wedges_) return {0, 2, 1, 3, 5, 4};
    std::vector<int> order;
    for (int k = 0; k < type.node_count(); ++k) order.push_back(k);
    if (is_lattice_hexahedron(number) && file_.is_before(2, 1)) {
      const int inner = type.degree - 1, first = 8 + 10 * inner;
      for (int k = 0; k < inner; ++k)
        std::swap(order[to_size(first + k)], order[to_size(first + inner + k)]);
    }
    return order;
  }

  void read_cells(VolumeMesh& mesh) {
    const auto& [connectivity, offsets, types] = file_.cells();
    std::vector<double> regions;
    if (const XmlElement* data = file_.piece().child("CellData"))
      if (const XmlElement* array = file_.find_array(*data, "region"))
        regions = arrays_.doubles(*array);
    // Cells with different weights are rational functions.
    if (file_.is_rational())
      refuse_mesh(path_, "rational cells (RationalWeights that differ, or 0) are not supported");
    require_one_degree(types);
    has_outward_wedges_ = has_outward_wedges(connectivity, offsets, types, mesh.points);
    CellCollector cells;
    const XmlElement& section = file_.require_child(file_.piece(), "Cells");
    lists_ = lists_of(*file_.find_array(section, "connectivity"), connectivity.size());
    std::map<std::pair<long long, std::size_t>, std::pair<CellType, std::vector<int>>> known;
    long long begin = 0;
    std::vector<Index> nodes;
    for (std::size_t c = 0; c < types.size(); ++c) {
      stop_.poll_at(c);
      if (offsets[c] < begin || offsets[c] > static_cast<long long>(connectivity.size()))
        file_.fail(fmt::format("offset {} of cell {} is out of range", offsets[c], c));
      nodes.clear();
      const std::size_t place = place_of_entry(static_cast<std::size_t>(begin));
      for (; begin < offsets[c]; ++begin) {
        const long long point = connectivity[static_cast<std::size_t>(begin)];
        if (point < 0 || point >= mesh.points.rows())
          file_.fail(
              fmt::format("cell {} has point {}, there are {}", c, point, mesh.points.rows()));
        nodes.push_back(static_cast<Index>(point));
      }
      const std::pair key(types[c], nodes.size());
      auto found = known.find(key);
      if (found == known.end()) {
        const CellType type = type_of(c, types[c], nodes.size());
        found = known.emplace(key, std::pair(type, order_of(type, types[c]))).first;
      }
      const double region = c < regions.size() ? regions[c] : 0;
      cells.add(found->second.first, found->second.second, nodes, static_cast<std::int64_t>(c),
                std::abs(region) < 1e9 ? static_cast<int>(region) : 0, place);
    }
    lists_.blocks = cells.lists();
    mesh.blocks = cells.take();
  }

  // Returns the coding of the connectivity, and records where its entries begin.
  NodeLists lists_of(const XmlElement& array, std::size_t entries) {
    using Coding = NodeLists::Coding;
    NodeLists lists;
    const std::string_view format = array.attribute("format", "ascii"),
                           type = array.attribute("type");
    entry_begin_ = arrays_.header_size();
    if (type.ends_with("64"))
      lists.width = 8;
    else if (type.ends_with("32"))
      lists.width = 4;
    else
      lists.width = type.ends_with("16") ? 2 : 1;
    if (arrays_.is_compressed() && format != "ascii") return lists;
    if (format == "appended") {
      const std::optional<std::size_t> first = appended_begin(array);
      if (!first) return lists;
      entry_begin_ = *first;
      lists.coding = Coding::Bytes;
      return lists;
    }
    const auto begin = static_cast<std::size_t>(array.text.data() - file_.xml().data());
    if (original_.compare(begin, array.text.size(), array.text) != 0) return lists;
    if (format == "ascii") {
      TextCursor words(path_, array.text, TextLines::Space, stop_);
      for (std::size_t k = 0; k < entries; ++k) {
        words.next_token();
        entry_words_.push_back(begin + words.begin());
      }
      lists.coding = Coding::Words;
      return lists;
    }
    const std::size_t first = array.text.find_first_not_of(" \t\r\n"),
                      last = array.text.find_last_not_of(" \t\r\n");
    if (first == std::string_view::npos) return lists;
    lists.text_begin = begin + first;
    lists.text_size = last + 1 - first;
    // The length and the integers are one text or two.
    const std::optional<std::string> bytes =
        decode_base64(array.text.substr(first, lists.text_size));
    if (bytes && bytes->size() == arrays_.header_size() + entries * lists.width)
      lists.coding = Coding::Base64;
    return lists;
  }

  std::size_t place_of_entry(std::size_t entry) const {
    if (lists_.coding == NodeLists::Coding::Words)
      return entry < entry_words_.size() ? entry_words_[entry] : 0;
    return entry_begin_ + entry * lists_.width;
  }

  // Returns where the values of an appended array begin; none if they are base64.
  std::optional<std::size_t> appended_begin(const XmlElement& array) const {
    const std::size_t tag = original_.find("<AppendedData");
    const std::size_t end = original_.find('>', tag), mark = original_.find('_', end);
    if (original_.substr(tag, end - tag).find("base64") != std::string::npos) return std::nullopt;
    std::size_t offset = 0;
    const std::string_view text = array.attribute("offset");
    std::from_chars(text.data(), text.data() + text.size(), offset);
    return mark + 1 + offset + arrays_.header_size();
  }

  // Refuses quads, hexahedra and wedges with different degrees per direction.
  void require_one_degree(const std::vector<long long>& types) const {
    const XmlElement* data = file_.piece().child("CellData");
    const XmlElement* array =
        data == nullptr ? nullptr : file_.find_role(*data, "HigherOrderDegrees");
    if (array == nullptr) return;
    const std::vector<double> degrees = arrays_.doubles(*array);
    if (degrees.size() != 3 * types.size())
      file_.fail("HigherOrderDegrees is not 3 numbers per cell");
    for (std::size_t c = 0; c < types.size(); ++c) {
      const std::optional<VtkType> type = vtk_type(types[c]);
      if (!type || type->degree != 0 || !has_directions(type->shape)) continue;
      const double* const first = &degrees[3 * c];
      const double* const last = first + dimension(type->shape);
      if (std::count(first, last, *first) != last - first)
        refuse_degrees(c, fmt::format("degrees {}", fmt::join(first, last, ", ")));
    }
  }
  static bool has_directions(CellShape shape) {
    using enum CellShape;
    return shape == Quad || shape == Hexahedron || shape == Wedge;
  }

  [[noreturn]] void refuse_degrees(std::size_t cell, const std::string& what) const {
    refuse_mesh(path_, fmt::format("cell {} of {}; degrees 1 to {}, the same in all directions, "
                                   "are supported",
                                   cell, what, CellType::kMaxDegree));
  }

  const std::string& path_;
  const StopCheck& stop_;
  std::string original_;
  VtkDocument file_;
  const VtuArrays& arrays_;
  bool has_outward_wedges_ = false;
  NodeLists lists_;
  std::size_t entry_begin_ = 0;           // of the connectivity, if it is not text
  std::vector<std::size_t> entry_words_;  // of each entry, if it is text
};

}  // namespace

VolumeMesh read_vtk_mesh(const std::string& path, std::string content, const StopCheck& stop) {
  return VtkCellReader(path, std::move(content), stop).read();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
