#include "majorant/io/internal/material_files.h"

#include <algorithm>
#include <cctype>
#include <climits>
#include <string_view>

namespace majorant {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBlanks = " \t";

// Returns the end of the word that begins at `from`.
std::size_t end_of_word(const std::string& text, std::size_t from) {
  return std::min(text.find_first_of(kBlanks, from), text.size());
}

// Returns the end of the first word after `end`; text.size() if there is none.
std::size_t end_of_next_word(const std::string& text, std::size_t end) {
  return end_of_word(text, std::min(text.find_first_not_of(kBlanks, end), text.size()));
}

// Returns the first slash in the range; `end` if there is none.
std::size_t find_slash(const std::string& text, std::size_t begin, std::size_t end) {
  const std::size_t at = std::string_view(text).substr(begin, end - begin).find('/');
  return at == std::string_view::npos ? end : begin + at;
}

bool ends_as_material(std::string_view name) {
  constexpr std::string_view kExtension = ".mtl";
  if (name.size() < kExtension.size()) return false;
  name.remove_prefix(name.size() - kExtension.size());
  return std::equal(name.begin(), name.end(), kExtension.begin(),
                    [](unsigned char c, char expected) { return std::tolower(c) == expected; });
}

// Returns the end of the first word from `from` on that ends with .mtl; npos if there is none.
std::size_t end_of_material(const std::string& names, std::size_t from) {
  for (std::size_t end = from; end < names.size();) {
    end = end_of_next_word(names, end);
    if (ends_as_material(std::string_view(names).substr(from, end - from))) return end;
  }
  return std::string::npos;
}

fs::path real_folder_of(const std::string& file) {
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(file, ignored).parent_path(), ignored);
}

}  // namespace

MaterialNames::MaterialNames(fs::path folder) : folder_(std::move(folder)) {
  std::error_code failed;
  for (fs::directory_iterator entry(folder_, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    std::string name = entry->path().filename().string();
    if (name.find_first_of(kBlanks) == std::string::npos) continue;
    longest_ = std::max(longest_, name.size());
    with_blanks_.insert(std::move(name));
  }
}

bool MaterialNames::is_file(const std::string& name) const {
  std::error_code ignored;
  return fs::is_regular_file(folder_ / name, ignored);
}

// Returns the end of the longest file name that begins at `from`; 0 if there is none. Names end
// where words do.
std::size_t MaterialNames::end_of_file(const std::string& names, std::size_t from) const {
  std::size_t end = end_of_word(names, from), longest = 0;
  if (find_slash(names, from, end) < end) return end_of_file_below(names, from, end);
  if (is_file(names.substr(from, end - from))) longest = end;
  while (end < names.size() && end - from < longest_) {
    const std::size_t begin = end;
    end = end_of_next_word(names, end);
    const std::size_t slash = find_slash(names, begin, end);
    const std::string name = names.substr(from, slash - from);
    const bool is_there = with_blanks_.count(name) > 0;
    if (slash < end) {
      const std::size_t below = is_there ? end_of_file_below(names, from, end) : 0;
      return std::max(longest, below);
    }
    if (is_there && is_file(name)) longest = end;
  }
  return longest;
}

// Does the same for names with folders; the first folder ends at `end`.
std::size_t MaterialNames::end_of_file_below(const std::string& names, std::size_t from,
                                             std::size_t end) const {
  std::size_t longest = 0, parent = 0;
  for (; end - from < PATH_MAX; end = end_of_next_word(names, end)) {
    const std::size_t slash = names.rfind('/', end - 1);
    if (end - slash > NAME_MAX + 1) break;
    std::error_code ignored;
    if (slash != parent &&
        !fs::is_directory(folder_ / names.substr(from, slash + 1 - from), ignored))
      break;
    parent = slash;
    if (is_file(names.substr(from, end - from))) longest = end;
    if (end == names.size()) break;
  }
  return longest;
}

// Returns the end of the name that begins at `from`.
std::size_t MaterialNames::end_of_name(const std::string& names, std::size_t from,
                                       std::size_t first_material) const {
  if (const std::size_t end = end_of_file(names, from); end > 0) return end;
  return first_material != std::string::npos ? first_material : end_of_word(names, from);
}

std::vector<std::string> MaterialNames::split(const std::string& names) const {
  std::vector<std::string> result;
  std::string trimmed = names.substr(0, names.find(" #"));  // cuts a comment off
  trimmed.resize(trimmed.find_last_not_of(kBlanks) + 1);
  std::size_t material = 0;
  for (std::size_t at = trimmed.find_first_not_of(kBlanks); at < trimmed.size();) {
    if (material <= at) material = end_of_material(trimmed, at);
    const std::size_t end = end_of_name(trimmed, at, material);
    result.push_back(trimmed.substr(at, end - at));
    at = trimmed.find_first_not_of(kBlanks, end);
  }
  return result;
}

MaterialFiles::MaterialFiles(const std::string& from, const std::string& to)
    : old_folder_(real_folder_of(from)), new_folder_(real_folder_of(to)) {
  if (old_folder_ == new_folder_) return;
  way_ = old_folder_.lexically_relative(new_folder_).string();
  names_.emplace(old_folder_);
}

std::string MaterialFiles::moved(const std::string& name) const {
  if (name.find('/') == std::string::npos) return way_ + "/" + name;
  const fs::path path(name);
  if (path.is_absolute() || name.size() >= PATH_MAX) return name;
  return (old_folder_ / path).lexically_normal().lexically_relative(new_folder_).string();
}

std::string MaterialFiles::repointed(const std::string& line) const {
  if (!names_) return line;
  std::string together, apart;
  for (const std::string& name : names_->split(line.substr(end_of_word(line, 0)))) {
    const std::string there = moved(name);
    if (there.find_first_of(kBlanks) == std::string::npos)
      together += " " + there;
    else
      apart += "\nmtllib " + there;
  }
  if (together.empty()) return apart.empty() ? line : apart.substr(1);
  return "mtllib" + together + apart;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
