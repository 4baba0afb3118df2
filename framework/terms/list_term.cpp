#include "majorant/framework/terms/list_term.h"

#include "majorant/framework/argument_check.h"

namespace majorant::detail {

ElementDofs dofs_of_lists(const std::string& name, const ElementLists& lists, int block) {
  std::size_t most = 1;
  for (const auto& list : lists) most = std::max(most, list.size());
  ElementDofs dofs;
  dofs.block = block;
  dofs.nodes.resize(counted("term '" + name + "': elements", lists.size(), most),
                    static_cast<Index>(most));
  for (std::size_t e = 0; e < lists.size(); ++e) {
    const auto& list = lists[e];
    const std::string element = "element " + std::to_string(e);
    if (list.empty()) throw InvalidArgument("term '" + name + "': " + element + " has no nodes");
    for (const Index node : list)
      if (node < 0)
        throw InvalidArgument("term '" + name + "': a node of " + element + " is " +
                              std::to_string(node) + ", they are counted from 0");
    for (std::size_t k = 0; k < most; ++k)
      dofs.nodes(static_cast<Index>(e), static_cast<Index>(k)) = list[k < list.size() ? k : 0];
    dofs.node_counts.push_back(static_cast<int>(list.size()));
  }
  return dofs;
}

}  // namespace majorant::detail

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
