// The file from which a mesh was read, for writing it back with only its changes. The formats make
// these objects (io/internal/source_file.h).
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

class MeshSource {
 public:
  virtual ~MeshSource() = default;
  // Returns the content of the file with these points. Throws Error(Unsupported) if the file cannot
  // hold them.
  virtual std::string with_points(const Points3& points) const = 0;
  // Returns the mesh of the file after the nodes of these cells are listed in the reflected order.
  // blocks: those of the mesh. Throws Error(Unsupported) if the file's lists are compressed, and
  // Stopped.
  virtual VolumeMesh with_turned(const std::vector<CellBlock>& blocks,
                                 const std::vector<CellName>& cells,
                                 const StopCheck& stop) const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
