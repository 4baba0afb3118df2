#include "majorant/io/internal/gltf_attribute_extension.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace majorant {
namespace {

constexpr const char* kTangent = "TANGENT";

std::uint32_t nearest(const Blend& blend) {
  Index largest = 0;
  blend.weights.maxCoeff(&largest);
  return blend.from[to_size(largest)];
}

std::vector<double> element_of(const GltfElements& elements, std::size_t e) {
  std::vector<double> values;
  for (std::size_t k = 0; k < elements.width; ++k) values.push_back(elements.value(e, k));
  return values;
}

std::vector<double> between(const GltfElements& elements, const std::string& name,
                            const Blend& blend) {
  std::vector<double> values(elements.width, 0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = blend.weights[static_cast<Index>(k)];
    if (weight == 0) continue;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] += weight * elements.value(blend.from[k], i);
  }
  const bool is_normal = name == "NORMAL" && values.size() == 3;
  const bool is_tangent = name == kTangent && values.size() == 4;
  if (!is_normal && !is_tangent) return values;
  const Vector3 direction = Eigen::Map<const Vector3>(values.data()).stableNormalized();
  if (!(direction.norm() > 0)) return element_of(elements, nearest(blend));
  std::copy(direction.begin(), direction.end(), values.begin());
  if (is_tangent) values[3] = elements.value(nearest(blend), 3);  // handedness: 1 or -1
  return values;
}

std::size_t set_of(const std::string& name) {
  return static_cast<std::size_t>(std::atoi(name.c_str() + name.find('_') + 1));
}

}  // namespace

std::size_t AttributeExtension::extended(const Gltf& attributes, const std::string& name,
                                         std::size_t accessor) {
  const auto [entry, is_new] = extended_.try_emplace(accessor, 0);
  if (!is_new) return entry->second;
  if (vertices_.added().empty()) return entry->second = accessor;
  const GltfElements old = document_.elements(accessor, name);
  Gltf json = document_.list("accessors")[accessor];
  for (const char* key : {"bufferView", "byteOffset", "sparse"}) json.erase(key);
  json["count"] = vertices_.count();
  const bool is_whole = name.starts_with("JOINTS_") || name.starts_with("_");
  if (!vertices_.has_blends() || is_whole) {
    entry->second = out_.add_accessor(std::move(json), whole_elements(attributes, name, old),
                                      old.element_size(), GltfOutput::Target::Vertices);
    return entry->second;
  }
  json["componentType"] = static_cast<int>(GltfComponent::Float);
  json.erase("normalized");
  std::string bytes;
  std::vector<double> low(old.width, INFINITY), high(old.width, -INFINITY);
  const auto add = [&](const std::vector<double>& element) {
    for (std::size_t i = 0; i < old.width; ++i) {
      append_float(element[i], bytes);
      low[i] = std::min(low[i], element[i]);
      high[i] = std::max(high[i], element[i]);
    }
  };
  for (std::size_t e = 0; e < old.count; ++e) add(element_of(old, e));
  for (const Blend& blend : vertices_.added()) add(value_of(blend, attributes, name, old));
  const bool has_bounds = json.contains("min") || json.contains("max");
  entry->second = out_.add_accessor(std::move(json), bytes, old.width * sizeof(float),
                                    GltfOutput::Target::Vertices);
  if (has_bounds) out_.set_bounds(entry->second, low, high);
  return entry->second;
}

std::string AttributeExtension::whole_elements(const Gltf& attributes, const std::string& name,
                                               const GltfElements& old) {
  std::string bytes = old.bytes;
  for (const Blend& blend : vertices_.added())
    bytes += blend.is_vertex() || name.starts_with("_") ? old.element(nearest(blend))
                                                        : joints_of(attributes, name, old, blend);
  return bytes;
}

std::vector<double> AttributeExtension::value_of(const Blend& blend, const Gltf& attributes,
                                                 const std::string& name, const GltfElements& old) {
  if (blend.is_vertex()) return element_of(old, blend.from[0]);
  return name.starts_with("WEIGHTS_") ? weights_of(attributes, name, blend)
                                      : between(old, name, blend);
}

// Returns the joints of a new vertex with their weights: the largest ones of its corners, as many
// as its sets hold.
std::vector<std::pair<std::uint32_t, double>> AttributeExtension::influences(const Gltf& attributes,
                                                                             const Blend& blend) {
  std::map<std::uint32_t, double> of_joint;
  std::size_t sets = 0;
  for (;; ++sets) {
    const std::string joints = fmt::format("JOINTS_{}", sets);
    const std::string weights = fmt::format("WEIGHTS_{}", sets);
    if (!attributes.contains(joints) || !attributes.contains(weights)) break;
    const GltfElements& of = cached(attributes, joints);
    const GltfElements& by = cached(attributes, weights);
    for (std::size_t k = 0; k < 3; ++k)
      if (const double weight = blend.weights[static_cast<Index>(k)]; weight != 0)
        for (std::size_t i = 0; i < of.width; ++i)
          if (const double w = by.value(blend.from[k], i); w != 0)
            of_joint[of.integer(blend.from[k], i)] += weight * w;
  }
  std::vector<std::pair<std::uint32_t, double>> list(of_joint.begin(), of_joint.end());
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  list.resize(4 * sets);
  double sum = 0;
  for (const auto& [joint, weight] : list) sum += weight;
  for (auto& [joint, weight] : list) weight /= sum > 0 ? sum : 1;
  return list;
}

std::string AttributeExtension::joints_of(const Gltf& attributes, const std::string& name,
                                          const GltfElements& old, const Blend& blend) {
  const auto list = influences(attributes, blend);
  std::string bytes;
  for (std::size_t i = 0; i < old.width; ++i) {
    const std::size_t at = 4 * set_of(name) + i;
    const std::uint32_t joint = at < list.size() ? list[at].first : 0;
    bytes.append(reinterpret_cast<const char*>(&joint), size_of(old.component));
  }
  return bytes;
}

std::vector<double> AttributeExtension::weights_of(const Gltf& attributes, const std::string& name,
                                                   const Blend& blend) {
  const auto list = influences(attributes, blend);
  std::vector<double> values;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t at = 4 * set_of(name) + i;
    values.push_back(at < list.size() ? list[at].second : 0);
  }
  return values;
}

const GltfElements& AttributeExtension::cached(const Gltf& attributes, const std::string& name) {
  const std::size_t accessor = document_.index(attributes, name.c_str(), "attributes");
  const auto found = elements_.find(accessor);
  if (found != elements_.end()) return found->second;
  return elements_.emplace(accessor, document_.elements(accessor, name)).first->second;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
