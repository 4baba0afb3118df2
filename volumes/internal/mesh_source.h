// The file that a mesh was read from: what is written back is this file, but for the coordinates of
// the points that were moved. So everything else comes back as it was: version, encoding, numbers,
// order, tags, sections that nothing is known of.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "majorant/volumes/volume_mesh.h"

namespace majorant {

class MeshSource {
 public:
  virtual ~MeshSource() = default;
  // The file with these points. Throws Error(Unsupported) for what it cannot hold.
  virtual std::string with_points(const Points3& points) const = 0;

 protected:
  explicit MeshSource(Points3 original) : original_(std::move(original)) {}
  bool is_moved(const Points3& points, Index point, int axis) const;

  Points3 original_;
};

// Coordinates as words, or as doubles in the byte order of the file, each at a place of its own.
class PlacedCoordinates final : public MeshSource {
 public:
  enum class Coding { Words, Doubles, SwappedDoubles };
  struct Place {
    std::size_t begin = 0;
    std::uint32_t size = 0;  // 0: the file has no such coordinate
  };
  // places: three for each point, the file's order may be another one.
  PlacedCoordinates(std::string file, std::string content, Points3 original,
                    std::vector<Place> places, Coding coding)
      : MeshSource(std::move(original)),
        file_(std::move(file)),
        content_(std::move(content)),
        places_(std::move(places)),
        coding_(coding) {}
  std::string with_points(const Points3& points) const override;

 private:
  std::string coded(double x) const;

  std::string file_, content_;
  std::vector<Place> places_;
  Coding coding_;
};

// A number in as few digits as read back as itself.
std::string shortest(double x);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
