#include "majorant/io/internal/material_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

namespace majorant {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBlanks = " \t";

// One past the end of the word that begins at `from`.
std::size_t end_of_word(const std::string& text, std::size_t from) {
  return std::min(text.find_first_of(kBlanks, from), text.size());
}

bool ends_as_material(std::string_view name) {
  constexpr std::string_view kExtension = ".mtl";
  if (name.size() < kExtension.size()) return false;
  name.remove_prefix(name.size() - kExtension.size());
  return std::equal(name.begin(), name.end(), kExtension.begin(),
                    [](unsigned char c, char wanted) { return std::tolower(c) == wanted; });
}

// One past the end of the name that begins at `from`.
std::size_t end_of_name(const std::string& names, std::size_t from, const fs::path& folder) {
  std::size_t longest_file = 0, first_material = 0;
  for (std::size_t end = from; end < names.size();) {
    end = end_of_word(names, names.find_first_not_of(kBlanks, end));
    const std::string name = names.substr(from, end - from);
    std::error_code ignored;
    if (fs::is_regular_file(folder / name, ignored)) longest_file = end;
    if (first_material == 0 && ends_as_material(name)) first_material = end;
  }
  if (longest_file > 0) return longest_file;
  return first_material > 0 ? first_material : end_of_word(names, from);
}

fs::path real_folder_of(const std::string& file) {
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(file, ignored).parent_path(), ignored);
}

}  // namespace

std::vector<std::string> split_material_names(const std::string& names, const std::string& folder) {
  std::vector<std::string> result;
  std::string trimmed = names.substr(0, names.find(" #"));  // a comment
  trimmed.resize(trimmed.find_last_not_of(kBlanks) + 1);
  for (std::size_t at = trimmed.find_first_not_of(kBlanks); at < trimmed.size();) {
    const std::size_t end = end_of_name(trimmed, at, folder);
    result.push_back(trimmed.substr(at, end - at));
    at = trimmed.find_first_not_of(kBlanks, end);
  }
  return result;
}

std::string repoint_materials(const std::string& line, const std::string& from,
                              const std::string& to) {
  const fs::path old_folder = real_folder_of(from), new_folder = real_folder_of(to);
  if (old_folder == new_folder) return line;
  std::string together, apart;
  for (const std::string& name :
       split_material_names(line.substr(end_of_word(line, 0)), old_folder.string())) {
    const fs::path path(name);
    const std::string moved =
        path.is_absolute()
            ? name
            : (old_folder / path).lexically_normal().lexically_relative(new_folder).string();
    if (moved.find_first_of(kBlanks) == std::string::npos)
      together += " " + moved;
    else
      apart += "\nmtllib " + moved;
  }
  if (together.empty()) return apart.empty() ? line : apart.substr(1);
  return "mtllib" + together + apart;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
