// The places of points and node lists in a VTK file, for writing it back with only its changes.
//
//     const VtkFile file{path, content, document, stop};
//     VtkEntries entries = vtk_entries(file, connectivity, connectivity_size);
//     entries.lists.blocks = cells.lists();
//     mesh.source = vtk_source(file, mesh.points, std::move(entries.lists));
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/io/internal/source_file.h"
#include "majorant/io/internal/vtk_document.h"

namespace majorant {

// A VTK file that was read. All members must outlive this object.
struct VtkFile {
  const std::string& path;
  const std::string& content;  // of the whole file
  const VtkDocument& document;
  const StopCheck& stop;
};

// The coding of the connectivity, without its blocks, and the places of its entries.
struct VtkEntries {
  NodeLists lists;
  std::size_t begin = 0;           // of the connectivity, if it is not text
  std::vector<std::size_t> words;  // of each entry, if it is text

  std::size_t place_of(std::size_t entry) const;
};

// array: the connectivity, with so many entries.
VtkEntries vtk_entries(const VtkFile& file, const XmlElement& array, std::size_t entries);

// Returns the source of the mesh with these points. It refuses moved points if the file cannot hold
// them.
std::shared_ptr<const MeshSource> vtk_source(const VtkFile& file, const Points3& points,
                                             NodeLists lists);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
