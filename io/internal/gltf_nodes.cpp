#include "majorant/io/internal/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace majorant {
namespace {

const Gltf& array(const GltfDocument& document, const Gltf& object, const char* key,
                  const char* name) {
  static const Gltf kNone = Gltf::array();
  const auto found = object.find(key);
  if (found == object.end()) return kNone;
  if (!found->is_array()) document.damaged(fmt::format("{}: {} is no list", name, key));
  return *found;
}

std::vector<double> numbers(const GltfDocument& document, const Gltf& node, const char* key,
                            std::size_t count) {
  std::vector<double> values;
  for (const Gltf& entry : array(document, node, key, "nodes")) {
    if (!entry.is_number()) document.damaged(fmt::format("nodes: {} has no numbers", key));
    values.push_back(entry.get<double>());
  }
  const bool is_finite =
      std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  if ((!values.empty() && values.size() != count) || !is_finite)
    document.damaged(fmt::format("nodes: {} has no {} finite numbers", key, count));
  return values;
}

NodeTransform local_transform(const GltfDocument& document, const Gltf& node) {
  NodeTransform out = NodeTransform::Identity();
  constexpr std::size_t kMatrix = 16, kVector = 3, kQuaternion = 4;
  if (const auto m = numbers(document, node, "matrix", kMatrix); !m.empty()) {
    out.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix4d>(m.data()).topRows<3>();
    return out;
  }
  if (const auto t = numbers(document, node, "translation", kVector); !t.empty())
    out.translate(Vector3(t[0], t[1], t[2]));
  if (const auto r = numbers(document, node, "rotation", kQuaternion); !r.empty())
    if (const Eigen::Quaterniond q(r[3], r[0], r[1], r[2]); q.norm() > 0)
      out.rotate(q.normalized());
  if (const auto s = numbers(document, node, "scale", kVector); !s.empty())
    out.scale(Vector3(s[0], s[1], s[2]));
  return out;
}

}  // namespace

NodeTransforms::NodeTransforms(const GltfDocument& document)
    : document_(document), nodes_(document.list("nodes")) {
  of_mesh_.resize(document.list("meshes").size());
  is_visited_.assign(nodes_.size(), 0);
  find_parents();
  visit_scenes();
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (!has_parent_[k]) visit(k);
  if (const auto left = std::find(is_visited_.begin(), is_visited_.end(), 0);
      left != is_visited_.end())
    document_.damaged(fmt::format("node {} is its own ancestor", left - is_visited_.begin()));
}

std::vector<std::size_t> NodeTransforms::node_numbers(const Gltf& object, const char* key,
                                                      const char* name) const {
  std::vector<std::size_t> numbers;
  for (const Gltf& entry : array(document_, object, key, name)) {
    if (!entry.is_number_unsigned() || entry.get<std::uint64_t>() >= nodes_.size())
      document_.damaged(fmt::format("{}: {} names a node that is not there", name, key));
    numbers.push_back(entry.get<std::size_t>());
  }
  return numbers;
}

void NodeTransforms::find_parents() {
  has_parent_.assign(nodes_.size(), 0);
  for (const Gltf& node : nodes_)
    for (const std::size_t child : node_numbers(node, "children", "nodes")) {
      if (has_parent_[child]) document_.damaged(fmt::format("node {} has two parents", child));
      has_parent_[child] = 1;
    }
}

// The shown scene comes first.
void NodeTransforms::visit_scenes() {
  const Gltf& scenes = document_.list("scenes");
  const auto visit_roots = [&](const Gltf& scene) {
    for (const std::size_t root : node_numbers(scene, "nodes", "scenes")) visit(root);
  };
  const std::size_t shown = document_.optional_index(document_.json(), "scene", "glTF").value_or(0);
  if (shown < scenes.size()) visit_roots(scenes[shown]);
  for (const Gltf& scene : scenes) visit_roots(scene);
}

// Visits nodes depth first, in the order of the file. A node below two roots is visited once.
void NodeTransforms::visit(std::size_t root) {
  struct Visit {
    std::size_t node;
    NodeTransform parent;
  };
  std::vector<Visit> open{{root, NodeTransform::Identity()}};
  while (!open.empty()) {
    const auto [k, parent] = open.back();
    open.pop_back();
    if (is_visited_[k]) continue;
    is_visited_[k] = 1;
    const Gltf& node = nodes_[k];
    const NodeTransform here = parent * local_transform(document_, node);
    show_mesh(node, here);
    const std::vector<std::size_t> children = node_numbers(node, "children", "nodes");
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      open.push_back({*child, here});
  }
}

// A skinned mesh is placed by its joints, not by its node. If the node scales a mesh to nothing,
// its transform is ignored.
void NodeTransforms::show_mesh(const Gltf& node, const NodeTransform& here) {
  const auto mesh = document_.optional_index(node, "mesh", "nodes");
  if (!mesh) return;
  if (*mesh >= of_mesh_.size()) document_.damaged(fmt::format("nodes: no mesh {}", *mesh));
  if (of_mesh_[*mesh]) return;
  const double det = here.linear().determinant();
  const bool is_usable = here.matrix().allFinite() && det != 0 && std::isfinite(det);
  of_mesh_[*mesh] = node.contains("skin") || !is_usable ? NodeTransform::Identity() : here;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
