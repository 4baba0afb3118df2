#include "majorant/io/written_mark.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <optional>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/formats.h"
#include "majorant/io/internal/gltf_content.h"
#include "majorant/io/internal/json_strings.h"
#include "majorant/io/vtu_text.h"

namespace majorant {
namespace {

constexpr std::string_view kName = "majorant", kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kHead = std::size_t{1} << 16, kMaxJson = std::size_t{16} << 20;  // bytes

// The text around the mark of a style.
struct MarkFrame {
  MarkStyle style;
  std::string_view before, after;
};
constexpr std::array<MarkFrame, 5> kFrames = {
    {{MarkStyle::FirstLine, "# ", "\n"},
     {MarkStyle::BelowVersion, "# ", "\n"},
     {MarkStyle::PlyComment, "comment ", "\n"},
     {MarkStyle::GmshSection, "$Comments\n", "\n$EndComments\n"},
     {MarkStyle::XmlComment, "<!-- ", " -->\n"}}};

const MarkFrame* frame_of(MarkStyle style) {
  const auto found = std::find_if(kFrames.begin(), kFrames.end(),
                                  [&](const MarkFrame& frame) { return frame.style == style; });
  return found == kFrames.end() ? nullptr : &*found;
}

// Returns the end of the line that contains `from`.
std::size_t behind_line(std::string_view text, std::size_t from) {
  const std::size_t end = text.find('\n', from);
  return end == std::string_view::npos ? text.size() : end + 1;
}

// Returns the end of the first word from `from` on, after comments from # to the end of a line.
std::size_t behind_word(std::string_view text, std::size_t from) {
  constexpr std::string_view kSpace = " \t\r\n\v\f";
  std::size_t begin = text.find_first_not_of(kSpace, from);
  while (begin < text.size() && text[begin] == '#')
    begin = text.find_first_not_of(kSpace, behind_line(text, begin));
  if (begin >= text.size()) return text.size();
  return std::min(text.find_first_of(kSpace, begin), text.size());
}

// Returns where the mark of a style begins, in a file or in its first bytes.
std::size_t place_of_mark(MarkStyle style, std::string_view text) {
  const std::size_t begin = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  if (style == MarkStyle::PlyComment) return behind_line(text, behind_line(text, begin));
  if (style == MarkStyle::GmshSection) {
    const std::size_t end = text.find("$EndMeshFormat");
    return end == std::string_view::npos ? text.size() : behind_line(text, end);
  }
  if (style == MarkStyle::BelowVersion) {  // on the line of MFEM's first word, after Medit's
    const std::size_t end = behind_word(text, begin);
    const bool is_medit = text.substr(0, end).ends_with("MeshVersionFormatted");
    return behind_line(text, is_medit ? behind_word(text, end) : end);
  }
  if (style == MarkStyle::XmlComment && text.substr(begin).starts_with("<?xml")) {
    const std::size_t end = text.find("?>", begin);
    if (end == std::string_view::npos) return text.size();
    const std::size_t next = text.find_first_not_of(" \t\r", end + 2);
    return next < text.size() && text[next] == '\n' ? next + 1 : end + 2;
  }
  return begin;
}

// Returns the size of the mark at the beginning of a text; 0: no mark.
std::size_t mark_size(const MarkFrame& frame, std::string_view text) {
  if (!text.starts_with(frame.before)) return 0;
  const std::size_t begin = frame.before.size(), end = text.find(frame.after, begin);
  if (end == std::string_view::npos || !is_written_mark(text.substr(begin, end - begin))) return 0;
  return end + frame.after.size();
}

// Returns whether the claims in the first bytes of a .vtu have the form of write_vtu(). Programs
// that rewrite a file copy the array in a form of their own.
bool has_written_claims(std::string_view text) {
  const std::string_view begin = claims_begin(), field = "<FieldData>\n";
  const std::size_t at = text.find(field);
  if (at == std::string_view::npos || text.find("<Piece") < at) return false;
  text.remove_prefix(at + field.size());
  if (!text.starts_with(begin)) return false;
  text.remove_prefix(begin.size());
  return text.substr(text.find_first_not_of("0123456789")).starts_with(claims_end());
}

// Returns the first `count` bytes of a file, decompressed if it ends in .gz, or all if it has
// fewer.
std::string first_bytes(const std::string& path, std::size_t count) {
  std::string bytes;
  read_blocks(path, [&](std::string_view block) {
    bytes += block.substr(0, count - bytes.size());
    return bytes.size() < count;
  });
  return bytes;
}

bool has_gltf_mark(const std::string& path) {
  bool is_marked = false;
  visit_strings(gltf_json(path, kMaxJson), [&](std::string_view place, const std::string& value) {
    is_marked = (place == "asset/generator" && is_written_generator(value)) ||
                place == "asset/extras/majorant";
    return !is_marked;
  });
  return is_marked;
}

}  // namespace

std::string written_version() { return MAJORANT_VERSION; }

std::string written_mark() { return fmt::format("{} {}", kName, written_version()); }

bool is_written_mark(std::string_view text) {
  if (!text.starts_with(kName)) return false;
  text.remove_prefix(kName.size());
  return text.size() > 1 && text[0] == ' ' && text[1] >= '0' && text[1] <= '9' &&
         text.find_first_not_of("0123456789.", 1) == std::string_view::npos;
}

bool is_written_generator(std::string_view generator) {
  return generator == kName || is_written_mark(generator);
}

std::string mark_text(MarkStyle style) {
  const MarkFrame* const frame = frame_of(style);
  return frame ? fmt::format("{}{}{}", frame->before, written_mark(), frame->after) : "";
}

std::string with_mark(MarkStyle style, std::string content) {
  const MarkFrame* const frame = frame_of(style);
  if (frame == nullptr) return content;
  const std::size_t place = place_of_mark(style, content);
  const std::size_t size = mark_size(*frame, std::string_view(content).substr(place));
  content.replace(place, size, mark_text(style));
  return content;
}

MarkStyle mark_style(std::string_view extension) {
  if (extension == ".mtl") return MarkStyle::FirstLine;
  const Format* const format = find_format(extension);
  return format == nullptr ? MarkStyle::None : format->mark;
}

bool takes_mark(const std::string& path) { return mark_style(format_of(path)) != MarkStyle::None; }

bool has_mark(const std::string& path) {
  const MarkStyle style = mark_style(format_of(path));
  std::error_code failed;
  if (style == MarkStyle::None || !std::filesystem::is_regular_file(path, failed)) return false;
  try {
    if (style == MarkStyle::GltfGenerator) return has_gltf_mark(path);
    const std::string text = first_bytes(path, kHead);
    const std::size_t place = place_of_mark(style, text);
    return mark_size(*frame_of(style), std::string_view(text).substr(place)) > 0 ||
           (style == MarkStyle::XmlComment && has_written_claims(text));
  } catch (const Error&) {
    return false;
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
