// Decodes the arrays of a VTK XML file in any encoding, for the readers of .vtu.
//
//   VtuArrays arrays(path, text, stop);                 // text: of the whole file
//   const XmlElement root = parse_xml(path, text);
//   arrays.configure(root);
//   const XmlElement* const piece = root.child("UnstructuredGrid")->child("Piece");
//   arrays.doubles(*piece->child("Points")->child("DataArray"));
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/io/byte_cursor.h"
#include "majorant/io/files/reading_limit.h"
#include "majorant/io/xml_tree.h"

namespace majorant {

class VtuArrays {
 public:
  enum class DataEncoding { Raw, Base64 };

  // Removes the appended section from `content`, because it may hold bytes that are no XML. Throws
  // Error(Unreadable) if the section is broken. `file` and `stop`, which is polled while values are
  // read, must outlive this.
  VtuArrays(const std::string& file, std::string& content, const StopCheck& stop);

  // Sets byte order, header type and compression from the attributes of <VTKFile>. Throws
  // Error(Unreadable) for compression other than zlib's and for unknown types.
  void configure(const XmlElement& root);

  // These return all values of an array, components interleaved. integers() refuses floating-point
  // types. They throw Error(Unreadable) naming the array, and Error(Unsupported) for more than a
  // ReadingLimit allows.
  std::vector<double> doubles(const XmlElement& array) const;
  std::vector<long long> integers(const XmlElement& array) const;
  // Returns a text: the bytes of an array of integers, or the first string of an array of type
  // String.
  std::string string(const XmlElement& array) const;

  ByteOrder order() const { return order_; }
  std::size_t header_size() const {
    return header_size_;
  }  // size in bytes of the length of an
     // array
  bool is_compressed() const { return is_compressed_; }

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
  mutable std::size_t unpacked_ = 0;  // bytes of all arrays so far
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
