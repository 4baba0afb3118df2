#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"
#include "majorant/io/base64.h"
#include "majorant/io/byte_cursor.h"
#include "majorant/io/input_file.h"
#include "majorant/io/internal/inflate.h"
#include "majorant/io/internal/line_cursor.h"
#include "majorant/io/internal/xml_tree.h"
#include "majorant/io/io.h"
#include "majorant/io/lagrange_cell.h"
#include "majorant/io/map_check.h"
#include "majorant/io/reading_limit.h"
#include "majorant/parametrization/maps/bezier_cell.h"

namespace majorant {
namespace {

// Decodes the arrays of a VTK XML file, whatever their encoding. For read_vtu.

enum class DataEncoding { Raw, Base64 };

class VtuArrays {
 public:
  // Takes the appended section out of `content` (it may hold bytes that are no XML); afterwards
  // `content` is XML. Throws Error(Unreadable) if the section is broken. `file` and `stop`, which
  // all that reads values polls, must outlive this.
  VtuArrays(const std::string& file, std::string& content, const StopCheck& stop);

  // Byte order, header type and compression, from the attributes of <VTKFile>.
  // Throws Error(Unreadable) for compression other than zlib's and unknown types.
  void configure(const XmlElement& root);

  // All values of an array, components interleaved. integers() refuses floating-point types.
  // Throw Error(Unreadable) naming the array, Error(Unsupported) for more than a ReadingLimit
  // allows.
  std::vector<double> doubles(const XmlElement& array) const;
  std::vector<long long> integers(const XmlElement& array) const;
  // Text: the bytes of an array of integers, or the first string of one of type String.
  std::string string(const XmlElement& array) const;

 private:
  template <class T>
  std::vector<T> values(const XmlElement& array) const;
  std::string bytes(const XmlElement& array) const;
  std::string encoded_bytes(const XmlElement& array, std::string_view text) const;
  std::string raw_bytes(const XmlElement& array, std::string_view data) const;
  std::string compressed_bytes(const XmlElement& array, std::string_view data,
                               DataEncoding encoding) const;
  std::string part(const XmlElement& array, std::string_view data, DataEncoding encoding,
                   std::size_t count) const;
  std::size_t length(std::string_view header) const;
  [[noreturn]] void fail(const XmlElement& array, std::string_view problem) const;

  const std::string& file_;
  const StopCheck& stop_;
  std::string appended_;
  std::string appended_encoding_;
  ByteOrder order_ = ByteOrder::Little;
  std::size_t header_size_ = 4;
  bool is_compressed_ = false;
  ReadingLimit limit_;
  std::size_t compressed_ = 0;        // bytes of the file
  mutable std::size_t unpacked_ = 0;  // of all arrays until now
};

[[noreturn]] void refuse_file(const std::string& file, std::string_view problem) {
  throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", file, problem));
}

// Calls visit(T{}) with the C++ type of a VTK type name; false if the name is unknown.
template <class Visitor>
bool with_type(std::string_view name, Visitor&& visit) {
  if (name == "Float64") return visit(double{}), true;
  if (name == "Float32") return visit(float{}), true;
  if (name == "Int64" || name == "vtkIdType") return visit(std::int64_t{}), true;
  if (name == "UInt64") return visit(std::uint64_t{}), true;
  if (name == "Int32") return visit(std::int32_t{}), true;
  if (name == "UInt32") return visit(std::uint32_t{}), true;
  if (name == "Int16") return visit(std::int16_t{}), true;
  if (name == "UInt16") return visit(std::uint16_t{}), true;
  if (name == "Int8") return visit(std::int8_t{}), true;
  if (name == "UInt8") return visit(std::uint8_t{}), true;
  return false;
}

bool is_xml_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

// Base64 without the space around it and, in a copy, without that between its characters.
class Compacted {
 public:
  explicit Compacted(std::string_view text) : text_(text) {
    while (!text_.empty() && is_xml_space(text_.front())) text_.remove_prefix(1);
    while (!text_.empty() && is_xml_space(text_.back())) text_.remove_suffix(1);
    if (std::none_of(text_.begin(), text_.end(), is_xml_space)) return;
    std::remove_copy_if(text_.begin(), text_.end(), std::back_inserter(copy_), is_xml_space);
    text_ = copy_;
  }
  Compacted(const Compacted&) = delete;
  Compacted& operator=(const Compacted&) = delete;

  std::string_view text() const { return text_; }

 private:
  std::string copy_;
  std::string_view text_;
};

std::size_t encoded_size(DataEncoding encoding, std::size_t bytes) {
  return encoding == DataEncoding::Raw ? bytes : base64_length(bytes);
}

VtuArrays::VtuArrays(const std::string& file, std::string& content, const StopCheck& stop)
    : file_(file), stop_(stop), limit_(file), compressed_(content.size()) {
  const std::size_t tag = content.find("<AppendedData");
  if (tag == std::string::npos) return;
  const std::size_t tag_end = content.find('>', tag);
  const std::size_t close = content.rfind("</AppendedData>");
  if (tag_end == std::string::npos || close == std::string::npos || close < tag_end) {
    refuse_file(file_, "AppendedData is not closed; the file is truncated");
  }
  const std::string start_tag = content.substr(tag, tag_end - tag) + "/>";
  appended_encoding_ = parse_xml(file_, start_tag).attribute("encoding", "raw");
  const std::size_t begin = content.find_first_not_of(" \t\r\n", tag_end + 1);
  if (content[begin] != '_') refuse_file(file_, "AppendedData does not begin with '_'");
  appended_ = content.substr(begin + 1, close - begin - 1);
  content.erase(tag, close + std::string_view("</AppendedData>").size() - tag);
}

void VtuArrays::configure(const XmlElement& root) {
  const std::string_view compressor = root.attribute("compressor");
  is_compressed_ = compressor == "vtkZLibDataCompressor";
  if (!compressor.empty() && !is_compressed_) {
    refuse_file(file_,
                fmt::format("arrays compressed by {} are not supported; save the file without "
                            "compression, or with zlib's",
                            in_quotes(compressor)));
  }
  const std::string_view order = root.attribute("byte_order", "LittleEndian");
  const std::string_view header = root.attribute("header_type", "UInt32");
  if (order != "LittleEndian" && order != "BigEndian") refuse_file(file_, "unknown byte_order");
  if (header != "UInt32" && header != "UInt64") refuse_file(file_, "unknown header_type");
  order_ = order == "BigEndian" ? ByteOrder::Big : ByteOrder::Little;
  header_size_ = header == "UInt64" ? 8 : 4;
}

void VtuArrays::fail(const XmlElement& array, std::string_view problem) const {
  refuse_file(file_, fmt::format("array {}: {}", in_quotes(array.attribute("Name", "?")), problem));
}

// The number of bytes of an array, which precedes it.
std::size_t VtuArrays::length(std::string_view header) const {
  return header_size_ == 8 ? load_bytes<std::uint64_t>(header.data(), order_)
                           : load_bytes<std::uint32_t>(header.data(), order_);
}

std::string VtuArrays::raw_bytes(const XmlElement& array, std::string_view data) const {
  if (data.size() < header_size_ || length(data) > data.size() - header_size_) {
    fail(array, "the data end too early; the file is truncated");
  }
  return std::string(data.substr(header_size_, length(data)));
}

// Header and data are one base64 stream, or two when the header ends with padding.
std::string VtuArrays::encoded_bytes(const XmlElement& array, std::string_view text) const {
  const auto decode = [&](std::size_t characters) {
    if (characters > text.size()) fail(array, "the data end too early; the file is truncated");
    auto decoded = decode_base64(text.substr(0, characters));
    if (!decoded || decoded->size() < header_size_) fail(array, "the base64 data are damaged");
    return std::move(*decoded);
  };
  const std::size_t header_characters = base64_length(header_size_);
  const std::string header = decode(header_characters);
  const std::size_t size = length(header);
  if (size > text.size()) fail(array, "the data end too early; the file is truncated");
  const bool separate = header.size() == header_size_;
  std::string all = decode(separate ? header_characters + base64_length(size)
                                    : base64_length(header_size_ + size));
  if (all.size() < header_size_ + size) fail(array, "the base64 data are damaged");
  all.resize(header_size_ + size);
  all.erase(0, header_size_);
  return all;
}

// The first `count` bytes that `data` stand for.
std::string VtuArrays::part(const XmlElement& array, std::string_view data, DataEncoding encoding,
                            std::size_t count) const {
  const std::size_t size = encoded_size(encoding, count);
  if (count > data.size() || size > data.size()) {
    fail(array, "the data end too early; the file is truncated");
  }
  data = data.substr(0, size);
  if (encoding == DataEncoding::Raw) return std::string(data);
  auto decoded = decode_base64(data);
  if (!decoded || decoded->size() < count) fail(array, "the base64 data are damaged");
  decoded->resize(count);
  return std::move(*decoded);
}

// Header: the number of blocks, the bytes of each and of a last smaller one (0: there is none),
// then the compressed bytes of each. Header and blocks, one after the other, are encoded
// separately.
std::string VtuArrays::compressed_bytes(const XmlElement& array, std::string_view data,
                                        DataEncoding encoding) const {
  const auto number = [this](const std::string& header, std::size_t k) {
    return length(std::string_view(header).substr(k * header_size_));
  };
  const std::size_t blocks = number(part(array, data, encoding, header_size_), 0);
  if (blocks == 0) return {};
  if (blocks > data.size()) fail(array, "the data end too early; the file is truncated");
  const std::string header = part(array, data, encoding, (3 + blocks) * header_size_);
  data.remove_prefix(encoded_size(encoding, header.size()));
  std::size_t total = 0;
  for (std::size_t k = 0; k < blocks; ++k) {
    if (number(header, 3 + k) > data.size() - total) fail(array, "a size is damaged");
    total += number(header, 3 + k);
  }
  const std::string compressed = part(array, data, encoding, total);
  std::string bytes;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < blocks; ++k) {
    stop_.poll();
    const bool is_smaller = k + 1 == blocks && number(header, 2) != 0;
    const std::string_view block =
        std::string_view(compressed).substr(begin, number(header, 3 + k));
    const std::size_t size = number(header, is_smaller ? 2 : 1);
    if (!can_stand_for(block, size)) fail(array, "a size is damaged");
    unpacked_ += size;
    limit_.require_unpacked(unpacked_, compressed_);
    if (!append_inflated(block, size, bytes)) fail(array, "the compressed data are damaged");
    begin += block.size();
  }
  return bytes;
}

std::string VtuArrays::bytes(const XmlElement& array) const {
  const std::string_view format = array.attribute("format");
  const auto decode = [&](std::string_view data, DataEncoding encoding) {
    if (is_compressed_) return compressed_bytes(array, data, encoding);
    return encoding == DataEncoding::Raw ? raw_bytes(array, data) : encoded_bytes(array, data);
  };
  if (format == "binary") return decode(Compacted(array.text).text(), DataEncoding::Base64);
  if (format != "appended") fail(array, fmt::format("unknown format {}", in_quotes(format)));
  const std::string_view text = array.attribute("offset");
  std::size_t offset = 0;
  const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), offset);
  if (code != std::errc() || stop != text.data() + text.size() || offset > appended_.size()) {
    fail(array, "its offset lies outside of AppendedData; the file is truncated");
  }
  const std::string_view data = std::string_view(appended_).substr(offset);
  if (appended_encoding_ == "raw") return decode(data, DataEncoding::Raw);
  if (appended_encoding_ != "base64") fail(array, "unknown encoding of AppendedData");
  return decode(data, DataEncoding::Base64);
}

template <class T>
std::vector<T> VtuArrays::values(const XmlElement& array) const {
  std::vector<T> result;
  if (array.attribute("format", "ascii") == "ascii") {
    const std::string name = fmt::format("{}: array {}", file_, array.attribute("Name", "?"));
    LineCursor cursor(name, array.text, Continuation::None, stop_);
    while (cursor.next_line()) {
      while (!cursor.at_end_of_line()) {
        if constexpr (std::is_same_v<T, double>) {
          const double value = cursor.next_number("value");
          const bool is_float = array.attribute("type") == "Float32";
          result.push_back(is_float ? double(static_cast<float>(value)) : value);
          if (!std::isfinite(result.back())) fail(array, "a value is not finite");
        } else {
          result.push_back(cursor.next_integer("value"));
        }
      }
    }
    return result;
  }
  const bool known = with_type(array.attribute("type"), [&](auto sample) {
    using Stored = decltype(sample);
    if (std::is_integral_v<T> && !std::is_integral_v<Stored>) fail(array, "integers are needed");
    const std::string data = bytes(array);
    if (data.size() % sizeof(Stored) != 0) fail(array, "its size is no multiple of the type's");
    limit_.require(data.size() + data.size() / sizeof(Stored) * sizeof(T));
    result.resize(data.size() / sizeof(Stored));
    for (std::size_t first = 0; first < result.size(); first += StopCheck::kPeriod) {
      stop_.poll();
      const std::size_t last = std::min(result.size(), first + StopCheck::kPeriod);
      for (std::size_t i = first; i < last; ++i)
        result[i] = static_cast<T>(load_bytes<Stored>(data.data() + i * sizeof(Stored), order_));
      if constexpr (std::is_same_v<T, double>)
        if (!Eigen::Map<const Vec>(result.data() + first, static_cast<Index>(last - first))
                 .allFinite())
          fail(array, "a value is not finite");
    }
  });
  if (!known) fail(array, fmt::format("unknown type {}", in_quotes(array.attribute("type"))));
  return result;
}

std::vector<double> VtuArrays::doubles(const XmlElement& array) const {
  return values<double>(array);
}

std::vector<long long> VtuArrays::integers(const XmlElement& array) const {
  return values<long long>(array);
}

std::string VtuArrays::string(const XmlElement& array) const {
  const bool is_string = array.attribute("type") == "String";
  std::string text;
  if (is_string && array.attribute("format", "ascii") != "ascii") {
    text = bytes(array);
  } else {
    for (const long long code : values<long long>(array)) {  // signed or unsigned characters
      if (code < -128 || code > 255) fail(array, "a character code is out of range");
      text += static_cast<char>(static_cast<unsigned char>(code));
    }
  }
  const std::size_t end = text.find('\0');
  if (is_string && end == std::string::npos) {
    fail(array, "the string is not terminated; truncated");
  }
  return text.substr(0, end);
}

constexpr long long kTriangle = 5;
constexpr long long kQuadraticTriangle = 22;
constexpr long long kLagrangeTriangle = 69;
constexpr long long kBezierTriangle = 76;

bool is_lagrange(long long type) { return type == kLagrangeTriangle || type == kQuadraticTriangle; }

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

class VtuReader {
 public:
  VtuReader(const std::string& path, const StopCheck& stop)
      : path_(path),
        stop_(stop),
        content_(read_whole_file(path, stop)),
        arrays_(path, content_, stop) {}

  MapFile read() {
    const XmlElement root = parse_xml(path_, content_);
    if (root.name != "VTKFile" || root.attribute("type") != "UnstructuredGrid") {
      fail("not a VTK UnstructuredGrid file");
    }
    arrays_.configure(root);
    const XmlElement& grid = require_child(root, "UnstructuredGrid");
    if (std::count_if(grid.children.begin(), grid.children.end(),
                      [](const XmlElement& e) { return e.name == "Piece"; }) > 1) {
      fail("more than one Piece; merge the pieces into one");
    }
    const XmlElement& piece = require_child(grid, "Piece");
    read_points(piece);
    read_cells(require_child(piece, "Cells"));
    if (const XmlElement* data = piece.child("CellData")) read_cell_data(*data);
    if (const XmlElement* data = grid.child("FieldData")) read_claims(*data);
    if (const std::string defect = map_defect(map_); !defect.empty()) fail(defect);
    if (is_lagrange_) take_as_lagrange_nodes(map_, path_, stop_);
    return std::move(map_);
  }

 private:
  [[noreturn]] void fail(std::string_view problem) const {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", path_, problem));
  }

  const XmlElement& require_child(const XmlElement& parent, std::string_view name) const {
    const XmlElement* child = parent.child(name);
    if (child == nullptr) fail(fmt::format("{} without {}; incomplete file", parent.name, name));
    return *child;
  }

  // The array of a name, upper or lower case; null if there is none. Two are refused: readers would
  // not agree on which one it is.
  const XmlElement* find_array(const XmlElement& section, std::string_view name) const {
    const XmlElement* found = nullptr;
    for (const XmlElement& array : section.children) {
      if ((array.name != "DataArray" && array.name != "Array") ||
          !same_name(array.attribute("Name"), name))
        continue;
      if (found != nullptr) fail(fmt::format("two arrays are called {}", in_quotes(name)));
      found = &array;
    }
    return found;
  }

  // The array that plays a role of VTK's: the one that the section's attribute names, else the one
  // of the role's own name; null if there is none.
  const XmlElement* find_role(const XmlElement& section, std::string_view role) const {
    const std::string_view name = section.attribute(role);
    if (name.empty()) return find_array(section, role);
    const XmlElement* array = find_array(section, name);
    if (array == nullptr)
      fail(fmt::format("{} names array {}, which is not there; incomplete file", role,
                       in_quotes(name)));
    return array;
  }

  // #rows by `columns` out of an array of `components` per row, the first of which are taken.
  template <class Matrix>
  Matrix matrix(const XmlElement& array, int columns, int components) const {
    const std::vector<double> values = arrays_.doubles(array);
    const auto stride = to_size(components);
    if (values.size() % stride != 0) fail("an array does not fit its number of components");
    const auto rows = static_cast<Eigen::Index>(values.size() / stride);
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const RowMajor>(values.data(), rows, components).leftCols(columns);
  }

  void read_points(const XmlElement& piece) {
    const XmlElement& points = require_child(require_child(piece, "Points"), "DataArray");
    map_.points = matrix<Points3>(points, 3, 3);
    if (map_.points.rows() > std::numeric_limits<Index>::max()) fail("too many points");
    if (piece.attribute("NumberOfPoints") != std::to_string(map_.points.rows())) {
      fail(fmt::format("NumberOfPoints says {}, Points holds {}; damaged or truncated",
                       in_quotes(piece.attribute("NumberOfPoints")), map_.points.rows()));
    }
    const XmlElement* data = piece.child("PointData");
    const XmlElement* uv = data == nullptr ? nullptr : find_array(*data, "uv");
    if (uv == nullptr) fail("no PointData array 'uv'; not a parametrization");
    const std::string_view components = uv->attribute("NumberOfComponents");
    if (components != "2" && components != "3") fail("uv must have 2 or 3 components");
    map_.uv = matrix<Points2>(*uv, 2, components == "2" ? 2 : 3);
    if (const XmlElement* array = find_array(*data, "input_vertex")) {
      map_.input_vertex = index_array(*array);
    }
    if (const XmlElement* array = find_array(*data, "cone")) map_.cone = index_array(*array);
    if (const XmlElement* weights = find_role(*data, "RationalWeights")) {
      require_polynomial(arrays_.doubles(*weights));
    }
    cell_count_ = std::string(piece.attribute("NumberOfCells"));
  }

  // Equal weights cancel; others make rational functions of the cells.
  void require_polynomial(const std::vector<double>& weights) const {
    if (static_cast<Eigen::Index>(weights.size()) != map_.points.rows()) {
      fail("RationalWeights is not one number per point");
    }
    if (std::any_of(weights.begin(), weights.end(),
                    [&](double w) { return w != weights[0] || w == 0; })) {
      fail("rational cells (RationalWeights that differ, or 0) are not supported");
    }
  }

  // Three numbers per cell; what VTK makes of the third of a triangle differs between versions.
  void require_degrees(const std::vector<double>& degrees) const {
    const auto cells = static_cast<std::size_t>(map_.cells.rows());
    if (degrees.size() != 3 * cells) fail("HigherOrderDegrees is not 3 numbers per cell");
    for (std::size_t k = 0; k < degrees.size(); ++k) {
      if (degrees[k] != map_.degree && !(k % 3 == 2 && (degrees[k] == 0 || degrees[k] == 1))) {
        fail(fmt::format("cell {}: HigherOrderDegrees says {}, its points make degree {}", k / 3,
                         degrees[k], map_.degree));
      }
    }
  }

  void read_cells(const XmlElement& section) {
    const auto require = [&](std::string_view name) {
      const XmlElement* array = find_array(section, name);
      if (array == nullptr) fail(fmt::format("Cells without {}; incomplete file", name));
      return arrays_.integers(*array);
    };
    const std::vector<long long> connectivity = require("connectivity");
    const std::vector<long long> offsets = require("offsets");
    const std::vector<long long> types = require("types");
    if (types.empty()) fail("no cells");
    if (offsets.size() != types.size() || cell_count_ != std::to_string(types.size())) {
      fail("NumberOfCells, offsets and types disagree; damaged or truncated");
    }
    map_.degree = bezier_cell_degree(offsets[0]);
    if (map_.degree == 0) {
      fail(fmt::format("a cell of {} points is no triangle of degree 1..{}", offsets[0],
                       kHighestFileDegree));
    }
    const long long size = offsets[0];
    for (std::size_t f = 0; f < types.size(); ++f) {
      if (!fits(types[f]))
        fail(fmt::format("cell {} of type {}; only Bezier and Lagrange triangles are supported", f,
                         types[f]));
      if (is_lagrange(types[f]) != is_lagrange(types[0]))
        fail(fmt::format("cell {} is of another type than cell 0", f));
      if (offsets[f] != size * static_cast<long long>(f + 1)) {
        fail(fmt::format("cell {} has another number of points than cell 0", f));
      }
    }
    if (static_cast<long long>(connectivity.size()) != offsets.back()) {
      fail("connectivity and offsets disagree; damaged or truncated");
    }
    is_lagrange_ = map_.degree > 1 && is_lagrange(types[0]);
    map_.cells.resize(static_cast<Eigen::Index>(types.size()), size);
    std::transform(connectivity.begin(), connectivity.end(), map_.cells.data(),
                   [this](long long id) { return index(id); });
  }

  bool fits(long long type) const {
    return type == kBezierTriangle || type == kLagrangeTriangle ||
           (type == kTriangle && map_.degree == 1) ||
           (type == kQuadraticTriangle && map_.degree == 2);
  }

  // -1 (none) passes; map_defect refuses it where a point is needed.
  Index index(long long id) const {
    if (id < -1 || id > std::numeric_limits<Index>::max()) {
      fail(fmt::format("number {} out of range", id));
    }
    return static_cast<Index>(id);
  }

  Eigen::VectorXi index_array(const XmlElement& array) const {
    const std::vector<long long> values = arrays_.integers(array);
    Eigen::VectorXi result(static_cast<Eigen::Index>(values.size()));
    std::transform(values.begin(), values.end(), result.data(),
                   [this](long long id) { return index(id); });
    return result;
  }

  void read_cell_data(const XmlElement& section) {
    if (const XmlElement* degrees = find_role(section, "HigherOrderDegrees")) {
      require_degrees(arrays_.doubles(*degrees));
    }
    if (const XmlElement* array = find_array(section, "input_face")) {
      map_.input_face = index_array(*array);
    }
    if (const XmlElement* array = find_array(section, "distortion")) {
      map_.distortion = matrix<Vec>(*array, 1, 1);
    }
    if (const XmlElement* array = find_array(section, "min_det")) {
      map_.min_det = matrix<Vec>(*array, 1, 1);
    }
    read_face_distortion(section);
    if (const XmlElement* array = find_array(section, "chart")) map_.chart = index_array(*array);
    if (const XmlElement* array = find_array(section, "seam_edges")) {
      const Eigen::VectorXi values = index_array(*array);
      if (values.size() != 3 * map_.cells.rows()) fail("seam_edges is not 3 numbers per cell");
      map_.seam_edges = values.reshaped<Eigen::RowMajor>(map_.cells.rows(), 3);
    }
  }

  // All of its arrays or none: files of before they were written have none.
  void read_face_distortion(const XmlElement& section) {
    FaceDistortion all(map_.cells.rows(), kFaceDistortionNames.size());
    for (std::size_t k = 0; k < kFaceDistortionNames.size(); ++k) {
      const XmlElement* array = find_array(section, kFaceDistortionNames[k]);
      if (array == nullptr) return;
      const Vec values = matrix<Vec>(*array, 1, 1);
      if (values.size() != all.rows())
        fail(fmt::format("{} is not one number per cell", kFaceDistortionNames[k]));
      all.col(static_cast<Eigen::Index>(k)) = values;
    }
    map_.face_distortion = std::move(all);
  }

  void read_claims(const XmlElement& section) {
    const XmlElement* array = find_array(section, "majorant_claims");
    if (array != nullptr) map_.claims = arrays_.string(*array);
  }

  const std::string& path_;
  const StopCheck& stop_;
  std::string content_;
  VtuArrays arrays_;
  MapFile map_;
  std::string cell_count_;
  bool is_lagrange_ = false;
};

}  // namespace

MapFile read_vtu(const std::string& path, const StopCheck& stop) {
  return VtuReader(path, stop).read();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
