// The input of the problems in this folder: arrays by name, read from meshes or generated.
#pragma once

#include <map>
#include <string>

#include "majorant/framework/types.h"

namespace majorant::tinyad {

class Input {
 public:
  void set(const std::string& name, RowMatrix array) { arrays_[name] = std::move(array); }
  // Throws std::out_of_range if there is no array of that name.
  const RowMatrix& array(const std::string& name) const { return arrays_.at(name); }
  Cells cells(const std::string& name) const { return array(name).cast<Index>(); }
  Vec vector(const std::string& name) const { return array(name).reshaped<Eigen::RowMajor>(); }

  // Writes FOLDER/NAME.txt for each array: numbers of rows and columns, then a line per row with
  // all digits.
  void write(const std::string& folder) const;

 private:
  std::map<std::string, RowMatrix> arrays_;
};

// folder: the folder of the meshes of TinyAD's examples; empty: small meshes are generated.
Input disk(const std::string& folder);    // positions, faces, start: Tutte's map
Input cube(const std::string& folder);    // positions, cells, pins, targets
Input sphere(const std::string& folder);  // faces, start
// positions; bases of triangles, two vectors each; edges, two vertices and two triangles each;
// start
Input frame_field(const std::string& folder);
Input quads(const std::string& folder);  // positions, faces: in a box of volume 1
Input nothing(const std::string& folder);

}  // namespace majorant::tinyad

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
