// The file that a mesh was read from, as far as the mesh needs it: what is written back is this
// file, but for what was changed. The formats make these (io/internal/source_file.h).
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
  // Returns the content of the file with these points. Throws Error(Unsupported) for points that it
  // cannot hold.
  virtual std::string with_points(const Points3& points) const = 0;
  // Returns the mesh that the file holds once it lists the nodes of these cells the other way
  // round; blocks: those of the mesh. Throws Error(Unsupported) where its lists are compressed;
  // Stopped.
  virtual VolumeMesh with_turned(const std::vector<CellBlock>& blocks,
                                 const std::vector<CellName>& cells,
                                 const StopCheck& stop) const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
