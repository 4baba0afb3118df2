// The `mtllib` lines of an OBJ, and those of one that is written into another folder than it was
// read from.
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

// The names in what follows `mtllib`, which may have blanks in them. Time and memory grow with the
// length of a line, whatever it names: the folder is listed once.
class MaterialNames {
 public:
  // folder: of the OBJ.
  explicit MaterialNames(std::filesystem::path folder);

  // A name is as long as files of the folder are called so, else up to a word that ends with .mtl,
  // else a word. What follows " #" is a comment.
  std::vector<std::string> split(const std::string& names) const;

 private:
  std::size_t end_of_name(const std::string& names, std::size_t from,
                          std::size_t first_material) const;
  std::size_t end_of_file(const std::string& names, std::size_t from) const;
  std::size_t end_of_file_below(const std::string& names, std::size_t from, std::size_t end) const;
  bool is_file(const std::string& name) const;

  std::filesystem::path folder_;
  std::unordered_set<std::string> with_blanks_;  // names in the folder
  std::size_t longest_ = 0;                      // of these
};

class MaterialFiles {
 public:
  // from, to: the OBJ files.
  MaterialFiles(const std::string& from, const std::string& to);

  // An `mtllib` line: relative names lead to the same files. Unchanged where both are in one
  // folder. Names with blanks get a line of their own, since readers take the whole line for one
  // name, or divide it.
  std::string repointed(const std::string& line) const;

 private:
  std::string moved(const std::string& name) const;

  std::filesystem::path old_folder_, new_folder_;
  std::string way_;                     // from the new folder to the old one
  std::optional<MaterialNames> names_;  // where they are different
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
