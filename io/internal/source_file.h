// The file that a mesh was read from. Writing a mesh back changes only the coordinates of moved
// points in it. Everything else stays: version, encoding, numbers, order, tags, unknown sections.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "majorant/io/internal/text_cursor.h"
#include "majorant/volumes/mesh_source.h"

namespace majorant {

// The places where a file lists the nodes of its cells: as consecutive words; as integers of
// `width` bytes; or as one base64 text of a length and integers. Hidden: compressed.
struct NodeLists {
  enum class Coding { Hidden, Words, Bytes, Base64 };
  struct OfBlock {
    std::vector<std::size_t> begins;  // by cell; for base64, within the bytes
    std::vector<int> order;           // by entry of a list, its place in VTK's order
  };
  Coding coding = Coding::Hidden;
  TextComments comments = TextComments::Hash;  // for words
  std::size_t width = 0;                       // of a node; bytes
  std::size_t text_begin = 0, text_size = 0;   // of the base64 text
  std::vector<OfBlock> blocks;                 // in the order of the mesh's blocks
};

class SourceFile : public MeshSource {
 public:
  VolumeMesh with_turned(const std::vector<CellBlock>& blocks, const std::vector<CellName>& cells,
                         const StopCheck& stop) const override;

 protected:
  SourceFile(std::string file, std::string content, Points3 original, NodeLists lists)
      : original_(std::move(original)),
        file_(std::move(file)),
        content_(std::move(content)),
        lists_(std::move(lists)) {}
  bool is_moved(const Points3& points, Index point, int axis) const;

  Points3 original_;
  std::string file_, content_;

 private:
  std::string turned_content(const std::vector<CellBlock>& blocks,
                             const std::vector<CellName>& cells) const;

  NodeLists lists_;
};

// Coordinates as words, or as doubles in the byte order of the file, each at its own place.
class PlacedCoordinates final : public SourceFile {
 public:
  enum class Coding { Words, Doubles, SwappedDoubles };
  struct Place {
    std::size_t begin = 0;
    std::uint32_t size = 0;  // 0: the file lacks this coordinate
  };
  // places: three for each point; the order in the file may differ.
  PlacedCoordinates(std::string file, std::string content, Points3 original, NodeLists lists,
                    std::vector<Place> places, Coding coding)
      : SourceFile(std::move(file), std::move(content), std::move(original), std::move(lists)),
        places_(std::move(places)),
        coding_(coding) {}
  std::string with_points(const Points3& points) const override;

 private:
  std::string coded(double x) const;

  std::vector<Place> places_;
  Coding coding_;
};

// Formats a number with the fewest digits that read back as the same number.
std::string shortest(double x);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
