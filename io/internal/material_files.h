// `mtllib` lines of an OBJ, and their adaptation when the OBJ is written to another folder.
//
//   const MaterialFiles materials("in/a.obj", "out/b.obj");
//   const std::string line = materials.repointed("mtllib a.mtl");   // mtllib ../in/a.mtl
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

namespace majorant {

// Splits the text after `mtllib` into names, which may contain blanks. Time and memory are linear
// in the length of a line; the folder is listed once.
class MaterialNames {
 public:
  // folder: of the OBJ.
  explicit MaterialNames(std::filesystem::path folder);

  // A name is the longest one of a file in the folder; else it ends with a word in .mtl; else it is
  // one word. " #" begins a comment.
  std::vector<std::string> split(const std::string& names) const;

 private:
  std::size_t end_of_name(const std::string& names, std::size_t from,
                          std::size_t first_material) const;
  std::size_t end_of_file(const std::string& names, std::size_t from) const;
  std::size_t end_of_file_below(const std::string& names, std::size_t from, std::size_t end) const;
  bool is_file(const std::string& name) const;

  std::filesystem::path folder_;
  std::unordered_set<std::string> with_blanks_;  // names with blanks in the folder
  std::size_t longest_ = 0;                      // length of the longest one
};

class MaterialFiles {
 public:
  // from, to: the OBJ files.
  MaterialFiles(const std::string& from, const std::string& to);

  // Returns an `mtllib` line whose relative names lead to the same files; unchanged if both OBJ
  // files are in one folder. Names with blanks get lines of their own, since readers treat such
  // lines differently.
  std::string repointed(const std::string& line) const;

 private:
  std::string moved(const std::string& name) const;

  std::filesystem::path old_folder_, new_folder_;
  std::string way_;                     // path from the new folder to the old one
  std::optional<MaterialNames> names_;  // set if the folders differ
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
