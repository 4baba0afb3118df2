// Where the nodes of a glTF document put its meshes: the product of the transforms of a node and
// its ancestors.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/io/internal/gltf_document.h"

namespace majorant {

using NodeTransform = Eigen::Affine3d;

// Where the first node that shows a mesh puts it; nothing for meshes that no node shows.
class NodeTransforms {
 public:
  // Throws Error(Unreadable) for nodes that are no forest or have no finite numbers.
  explicit NodeTransforms(const GltfDocument& document);

  NodeTransform of_mesh(std::size_t mesh) const {
    return of_mesh_[mesh].value_or(NodeTransform::Identity());
  }

 private:
  std::vector<std::size_t> node_numbers(const Gltf& object, const char* key,
                                        const char* name) const;
  void find_parents();
  void visit_scenes();
  void visit(std::size_t root);
  void show_mesh(const Gltf& node, const NodeTransform& here);

  const GltfDocument& document_;
  const Gltf& nodes_;
  std::vector<std::optional<NodeTransform>> of_mesh_;
  std::vector<char> has_parent_, is_visited_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
