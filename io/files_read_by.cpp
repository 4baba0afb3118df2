#include "majorant/io/files_read_by.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files_below.h"
#include "majorant/io/formats.h"
#include "majorant/io/internal/gltf_content.h"
#include "majorant/io/internal/json_strings.h"
#include "majorant/io/internal/material_files.h"
#include "majorant/io/internal/text_cursor.h"
#include "majorant/io/material_lines.h"
#include "majorant/io/pvtu.h"

namespace majorant {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kLibrary = "mtllib";

bool is_regular(const std::string& path) {
  std::error_code failed;
  return fs::is_regular_file(path, failed);
}

// Calls visit(line) with every `mtllib` line of an OBJ. Continued lines are joined.
template <class Visit>
class LibraryLines {
 public:
  LibraryLines(const std::string& path, const Visit& visit) : path_(path), visit_(visit) {}

  void read(const StopCheck& stop) {
    read_blocks(
        path_,
        [&](std::string_view block) {
          text_ += block;
          const std::size_t end = end_of_lines();
          visit_lines(std::string_view(text_).substr(0, end));
          text_.erase(0, end);
          if (text_.size() > kLongestLine) text_.clear();
          return true;
        },
        stop);
    visit_lines(text_);
  }

 private:
  static constexpr std::string_view kBlanks = " \t\v\f", kEnds = "\r\n";
  // bytes; real names are far shorter
  static constexpr std::size_t kLongestLine = std::size_t{1} << 20;

  // Returns the end of the last line that is not continued; 0 if there is none.
  std::size_t end_of_lines() const {
    for (std::size_t end = text_.find_last_of(kEnds); end != std::string::npos && end > 0;
         end = text_.find_last_of(kEnds, end - 1)) {
      const std::size_t last = text_.find_last_not_of(" \t\v\f\r", end - 1);
      if (last == std::string::npos || text_[last] != '\\') return end + 1;
    }
    return 0;
  }

  static bool begins_line(std::string_view text, std::size_t at) {
    if (at == 0) return true;
    const std::size_t last = text.find_last_not_of(kBlanks, at - 1);
    return last == std::string_view::npos || kEnds.find(text[last]) != std::string_view::npos ||
           text.substr(0, last + 1) == "\xEF\xBB\xBF";
  }

  // Returns the text up to a lone carriage return, which ends a line.
  static std::string_view up_to_return(std::string_view line) {
    std::size_t end = line.find('\r');
    while (end < line.size() && line.substr(end + 1).starts_with('\n'))
      end = line.find('\r', end + 1);
    return line.substr(0, end);
  }

  void visit_lines(std::string_view text) const {
    for (std::size_t at = text.find(kLibrary); at != std::string_view::npos;
         at = text.find(kLibrary, at)) {
      TextCursor cursor(path_, text.substr(at), TextLines::Continued);
      if (begins_line(text, at) && cursor.next_line() && cursor.next_token() == kLibrary) {
        const std::string_view line = up_to_return(cursor.whole_line());
        at += line.size();
        visit_(joined_line(line));
      } else {
        at += kLibrary.size();
      }
    }
  }

  const std::string& path_;
  const Visit& visit_;
  std::string text_;  // not searched yet
};

class FileList {
 public:
  explicit FileList(const StopCheck& stop) : stop_(stop) {}

  void add_materials(const std::string& obj) {
    std::optional<MaterialNames> names;  // lists the folder when it is made
    std::set<std::string> known;         // lines that were visited
    const auto visit = [&](const std::string& line) {
      if (!known.insert(line).second) return;
      const std::string_view rest = split_keyword(line).second;
      if (!names) names.emplace(folder_of(obj));
      for (const std::string& text : spellings(rest)) {
        add_library(obj, text);
        for (const std::string& name : names->split(text)) add_library(obj, name);
      }
    };
    LibraryLines(obj, visit).read(stop_);
  }

  void add_gltf(const std::string& path) {
    visit_strings(gltf_json(path, std::numeric_limits<std::size_t>::max(), stop_),
                  [&](std::string_view place, const std::string& uri) {
                    if ((place == "buffers/uri" || place == "images/uri") && !is_data_uri(uri))
                      add(path, name_of_uri(uri));
                    return true;
                  });
  }

  void add_pieces(const std::string& path) {
    for (const std::string& piece : pvtu_pieces(path, stop_)) add(path, piece);
  }

  std::vector<std::string> take() { return std::move(files_); }

 private:
  static fs::path folder_of(const std::string& file) {
    const fs::path folder = fs::path(file).parent_path();
    return folder.empty() ? "." : folder;
  }

  // Returns the name, also with slashes instead of backslashes.
  static std::set<std::string> spellings(std::string_view name) {
    std::string other(name);
    std::replace(other.begin(), other.end(), '\\', '/');
    return {std::string(name), other};
  }

  // Adds the file that the one at `path` names. Returns it if it exists and is new, else an empty
  // string.
  std::string add(const std::string& path, const std::string& name) {
    if (name.empty() || name.find('\0') != std::string::npos) return {};
    std::string file = (fs::path(path).parent_path() / name).string();
    std::error_code failed;
    if (!fs::exists(file, failed) || fs::is_directory(file, failed) || !known_.insert(file).second)
      return {};
    files_.push_back(file);
    return file;
  }

  void add_library(const std::string& obj, const std::string& name) {
    const std::string library = add(obj, name);
    if (library.empty() || !is_below(obj, name) || !is_regular(library)) return;
    try {
      std::string text = read_whole_file(library, stop_);
      require_text(library, text);
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);)
        if (const std::optional<MaterialImage> image = material_image(line))
          add(library, image->name);
    } catch (const Error&) {  // its reader reports the error
    }
  }

  const StopCheck& stop_;
  std::vector<std::string> files_;
  std::set<std::string> known_;
};

}  // namespace

std::vector<std::string> files_read_by(const std::string& path, const StopCheck& stop) {
  FileList files(stop);
  const Format* const format = find_format(format_of(path));
  if (format == nullptr || !is_regular(path)) return {};
  using Materials = Format::Materials;
  try {
    if (format->materials == Materials::InFilesBeside) files.add_materials(path);
    if (format->materials == Materials::Inside) files.add_gltf(path);
    if (format->has_pieces) files.add_pieces(path);
  } catch (const Error&) {  // the reader of the mesh reports the error
  }
  return files.take();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
