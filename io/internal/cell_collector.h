// Collects cells in the order of a file and sorts them into blocks of one type.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "majorant/framework/argument_check.h"
#include "majorant/io/internal/source_file.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

class CellCollector {
 public:
  // nodes: in the order of the file; node k is order[k] in VTK's order. corners: in VTK's order;
  // empty if the cells share their first nodes. place: where the file lists the nodes.
  void add(const CellType& type, const std::vector<int>& order, std::span<const Index> nodes,
           std::int64_t number, int region, std::size_t place,
           std::span<const Index> corners = {}) {
    if (last_ == nullptr || last_type_ != type) {
      last_ = &found_[type];
      last_type_ = type;
      if (last_->place == 0) {
        last_->place = found_.size();
        last_->lists.order = order;
      }
    }
    const std::size_t begin = last_->nodes.size();
    last_->nodes.resize(begin + nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k)
      last_->nodes[begin + static_cast<std::size_t>(order[k])] = nodes[k];
    last_->vertices.insert(last_->vertices.end(), corners.begin(), corners.end());
    last_->numbers.push_back(number);
    last_->regions.push_back(region);
    last_->lists.begins.push_back(place);
  }

  // Returns where the file lists the nodes of the cells, in the order of take(). Call it before
  // take().
  std::vector<NodeLists::OfBlock> lists() const {
    std::vector<NodeLists::OfBlock> out(found_.size());
    for (const auto& [type, cells] : found_) out[cells.place - 1] = cells.lists;
    return out;
  }

  // Returns the blocks in the order of the first cells of each type.
  std::vector<CellBlock> take() {
    std::vector<CellBlock> out(found_.size());
    for (auto& [type, cells] : found_) {
      CellBlock& block = out[cells.place - 1];
      const Index count = counted("cells", cells.numbers.size());
      block.type = type;
      block.nodes = Eigen::Map<const Cells>(cells.nodes.data(), count, type.node_count());
      if (!cells.vertices.empty())
        block.vertices =
            Eigen::Map<const Cells>(cells.vertices.data(), count, corner_count(type.shape));
      block.numbers = std::move(cells.numbers);
      block.regions = std::move(cells.regions);
    }
    return out;
  }

 private:
  struct Collected {
    std::size_t place = 0;  // from 1
    std::vector<Index> nodes, vertices;
    std::vector<std::int64_t> numbers;
    std::vector<int> regions;
    NodeLists::OfBlock lists;
  };
  std::map<CellType, Collected> found_;
  Collected* last_ = nullptr;
  CellType last_type_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
