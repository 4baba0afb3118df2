// Extends attributes of a glTF primitive by added vertices. A copy has the value of its vertex. A
// new vertex between three others has their mean, by its weights:
//     NORMAL, TANGENT   of unit length; the handedness of a tangent is that of the nearest corner
//     JOINTS, WEIGHTS   the joints of largest weight of all corners, as many as before
//     names with _      the value of the nearest corner
// Elements are copied bit by bit, unless new vertices are between them; then they are floats.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "majorant/io/internal/gltf_document.h"
#include "majorant/io/internal/gltf_new_vertices.h"
#include "majorant/io/internal/gltf_output.h"

namespace majorant {

class AttributeExtension {
 public:
  // The arguments must outlive this.
  AttributeExtension(const GltfDocument& document, const NewVertices& vertices, GltfOutput& out)
      : document_(document), vertices_(vertices), out_(out) {}

  // Returns the accessor of the output for one of the document's, an attribute of this name, with
  // the added vertices; the document's own if none are added. Each accessor is extended once.
  // attributes: all attributes that belong together.
  std::size_t extended(const Gltf& attributes, const std::string& name, std::size_t accessor);

 private:
  std::string whole_elements(const Gltf& attributes, const std::string& name,
                             const GltfElements& old);
  std::vector<double> value_of(const Blend& blend, const Gltf& attributes, const std::string& name,
                               const GltfElements& old);
  std::vector<std::pair<std::uint32_t, double>> influences(const Gltf& attributes,
                                                           const Blend& blend);
  std::string joints_of(const Gltf& attributes, const std::string& name, const GltfElements& old,
                        const Blend& blend);
  std::vector<double> weights_of(const Gltf& attributes, const std::string& name,
                                 const Blend& blend);
  const GltfElements& cached(const Gltf& attributes, const std::string& name);

  const GltfDocument& document_;
  const NewVertices& vertices_;
  GltfOutput& out_;
  std::map<std::size_t, std::size_t> extended_;   // by accessor
  std::map<std::size_t, GltfElements> elements_;  // by accessor
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
