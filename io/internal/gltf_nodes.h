// The transforms of a glTF document's meshes: products of the transforms of nodes and their
// ancestors.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/io/internal/gltf_document.h"

namespace majorant {

using NodeTransform = Eigen::Affine3d;

// The transform of each mesh by the first node that shows it; none for meshes that no node shows.
class NodeTransforms {
 public:
  // Throws Error(Unreadable) for nodes that are no forest, or have numbers that are not finite.
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
