// Names of standard input and output that include a format: /dev/stdin.obj, /dev/stdout.vtu.
//
//   const PolygonMesh mesh = read_mesh(standard_input("obj"));
//   const std::string flat = standard_output(".vtu");   // /dev/stdout.vtu
#pragma once

#include <string>
#include <string_view>

namespace majorant {

inline constexpr std::string_view kInputStream = "/dev/stdin.", kOutputStream = "/dev/stdout.";

// format: an extension, with or without its dot.
inline std::string stream_name(std::string_view stream, std::string_view format) {
  return std::string(stream.substr(0, stream.size() - 1)) + (format.starts_with('.') ? "" : ".") +
         std::string(format);
}
inline std::string standard_input(std::string_view format) {
  return stream_name(kInputStream, format);
}
inline std::string standard_output(std::string_view format) {
  return stream_name(kOutputStream, format);
}
inline bool is_standard_input(std::string_view path) { return path.starts_with(kInputStream); }
inline bool is_standard_output(std::string_view path) { return path.starts_with(kOutputStream); }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
