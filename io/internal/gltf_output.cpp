#include "majorant/io/internal/gltf_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/base64.h"
#include "majorant/io/written_mark.h"

namespace majorant {
namespace {

constexpr std::size_t kBuffer = 0;  // the only buffer

static_assert(std::endian::native == std::endian::little, "memory is written as it is");

void pad(std::string& bytes, char with) {
  bytes.resize((bytes.size() + kGltfAlignment - 1) / kGltfAlignment * kGltfAlignment, with);
}

// Call visit(reference) with every number of an accessor, and of a buffer view.
using Visit = std::function<void(Gltf&)>;

void visit_member(Gltf& object, const char* key, const Visit& visit) {
  if (object.is_object() && object.contains(key)) visit(object[key]);
}

void visit_all(Gltf& object, const char* key, const Visit& visit) {
  visit_member(object, key, [&](Gltf& list) {
    if (list.is_structured())
      for (Gltf& entry : list) visit(entry);
  });
}

void visit_accessors(Gltf& json, const Visit& visit) {
  visit_all(json, "meshes", [&](Gltf& mesh) {
    visit_all(mesh, "primitives", [&](Gltf& primitive) {
      visit_member(primitive, "indices", visit);
      visit_all(primitive, "attributes", visit);
      visit_member(primitive, "targets", [&](Gltf& targets) {
        for (Gltf& target : targets)
          for (Gltf& entry : target) visit(entry);
      });
    });
  });
  visit_all(json, "skins", [&](Gltf& skin) { visit_member(skin, "inverseBindMatrices", visit); });
  visit_all(json, "animations", [&](Gltf& animation) {
    visit_all(animation, "samplers", [&](Gltf& sampler) {
      visit_member(sampler, "input", visit);
      visit_member(sampler, "output", visit);
    });
  });
  visit_all(json, "nodes", [&](Gltf& node) {
    visit_member(node, "extensions", [&](Gltf& extensions) {
      visit_member(extensions, "EXT_mesh_gpu_instancing",
                   [&](Gltf& instances) { visit_all(instances, "attributes", visit); });
    });
  });
}

void visit_views(Gltf& json, const Visit& visit) {
  visit_all(json, "accessors", [&](Gltf& accessor) {
    visit_member(accessor, "bufferView", visit);
    visit_member(accessor, "sparse", [&](Gltf& sparse) {
      for (const char* part : {"indices", "values"})
        visit_member(sparse, part, [&](Gltf& of) { visit_member(of, "bufferView", visit); });
    });
  });
  visit_all(json, "images", [&](Gltf& image) { visit_member(image, "bufferView", visit); });
}

// Calls visit(reference) with every number of a texture in a value of a material.
void visit_textures_of(Gltf& value, const Visit& visit) {
  if (!value.is_object()) return;
  for (auto& [key, member] : value.items()) {
    if (key == "extras" || !member.is_object()) continue;
    if (key.ends_with("Texture") || key.ends_with("texture")) visit_member(member, "index", visit);
    visit_textures_of(member, visit);
  }
}

void visit_texture_numbers(Gltf& json, const Visit& visit) {
  visit_all(json, "materials", [&](Gltf& material) { visit_textures_of(material, visit); });
}

void visit_image_numbers(Gltf& json, const Visit& visit) {
  visit_all(json, "textures", [&](Gltf& texture) {
    visit_member(texture, "source", visit);
    visit_all(texture, "extensions",
              [&](Gltf& extension) { visit_member(extension, "source", visit); });
  });
}

// Returns whether the functions above follow all references of an extension.
bool is_known(const std::string& extension) {
  static const std::set<std::string> kKnown = {
      "KHR_mesh_quantization", "KHR_texture_transform", "KHR_lights_punctual",
      "KHR_animation_pointer", "KHR_xmp_json_ld",       "EXT_mesh_gpu_instancing",
      "EXT_texture_webp",      "EXT_texture_avif",      "MSFT_texture_dds"};
  return extension.starts_with("KHR_materials_") || kKnown.contains(extension);
}

// A file by another program keeps its generator.
void set_mark(Gltf& asset) {
  const std::string generator = asset.contains("generator") && asset["generator"].is_string()
                                    ? asset["generator"].get<std::string>()
                                    : "";
  const bool is_of_others = !generator.empty() && !is_written_generator(generator);
  const bool has_place = !asset.contains("extras") || asset["extras"].is_object();
  if (is_of_others && has_place)
    asset["extras"]["majorant"] = written_version();
  else
    asset["generator"] = written_mark();
}

using VisitReferences = void (*)(Gltf&, const Visit&);

std::set<std::size_t> references(Gltf& json, VisitReferences each) {
  std::set<std::size_t> numbers;
  each(json, [&](Gltf& number) {
    if (number.is_number_unsigned()) numbers.insert(number.get<std::size_t>());
  });
  return numbers;
}

// Removes entries from a list and renumbers the references to the others.
void drop_entries(Gltf& json, const char* list, const std::set<std::size_t>& before,
                  VisitReferences each) {
  if (!json.contains(list)) return;
  const std::set<std::size_t> now = references(json, each);
  Gltf kept = Gltf::array();
  std::vector<std::size_t> number;
  for (std::size_t k = 0; k < json[list].size(); ++k) {
    number.push_back(kept.size());
    if (now.contains(k) || !before.contains(k)) kept.push_back(std::move(json[list][k]));
  }
  each(json, [&](Gltf& reference) {
    if (reference.is_number_unsigned() && reference.get<std::size_t>() < number.size())
      reference = number[reference.get<std::size_t>()];
  });
  if (kept.empty())
    json.erase(list);
  else
    json[list] = std::move(kept);
}

}  // namespace

void append_float(double value, std::string& bytes) {
  const auto rounded = static_cast<float>(value);
  if (!std::isfinite(rounded))
    throw Error(ErrorKind::Invalid,
                fmt::format("{} is beyond the floats of glTF; scale the mesh, or write .obj, .ply "
                            "or .vtu",
                            value));
  append_bytes(rounded, bytes);
}

std::size_t GltfOutput::add_view(std::string_view bytes, std::size_t stride, Target target) {
  pad(binary_, '\0');
  Gltf view{{"buffer", kBuffer}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
  if (stride > 0) view["byteStride"] = stride;
  if (target != Target::None) view["target"] = static_cast<int>(target);
  binary_ += bytes;
  json_["bufferViews"].push_back(std::move(view));
  return json_["bufferViews"].size() - 1;
}

std::size_t GltfOutput::add_accessor(Gltf entry, std::string_view bytes, std::size_t size,
                                     Target target) {
  const std::size_t stride = (size + kGltfAlignment - 1) / kGltfAlignment * kGltfAlignment;
  if (target == Target::Vertices && stride != size) {
    std::string padded;
    padded.reserve(bytes.size() / size * stride);
    for (std::size_t k = 0; k < bytes.size(); k += size) {
      padded += bytes.substr(k, size);
      padded.append(stride - size, '\0');
    }
    entry["bufferView"] = add_view(padded, stride, target);
  } else {
    entry["bufferView"] = add_view(bytes, 0, target);
  }
  json_["accessors"].push_back(std::move(entry));
  return json_["accessors"].size() - 1;
}

void GltfOutput::set_bounds(std::size_t accessor, const std::vector<double>& low,
                            const std::vector<double>& high) {
  Gltf& entry = json_["accessors"][accessor];
  for (const auto& [key, bounds] : {std::pair("min", low), std::pair("max", high)}) {
    Gltf list = Gltf::array();
    for (const double x : bounds) list.push_back(static_cast<double>(static_cast<float>(x)));
    entry[key] = std::move(list);
  }
}

void GltfOutput::take_buffers(const GltfDocument& document) {
  std::vector<std::string_view> buffers;
  for (std::size_t b = 0; b < document.list("buffers").size(); ++b)
    buffers.push_back(document.buffer(b));
  gather(document, buffers);
}

// Copies the parts of these buffers that buffer views use, each byte once.
void GltfOutput::gather(const GltfDocument& document,
                        const std::vector<std::string_view>& buffers) {
  using Range = std::pair<std::size_t, std::size_t>;  // begin, end
  std::vector<std::vector<Range>> ranges(buffers.size());
  std::string all;
  if (!json_.contains("bufferViews")) return;
  const auto range_of = [&](const Gltf& view) -> std::pair<std::size_t, Range> {
    const std::size_t b = document.index(view, "buffer", "bufferViews");
    const std::size_t begin =
        document.optional_index(view, "byteOffset", "bufferViews").value_or(0);
    const std::size_t size = document.index(view, "byteLength", "bufferViews");
    if (b >= buffers.size() || begin > buffers[b].size() || size > buffers[b].size() - begin)
      document.damaged("a bufferView goes beyond its buffer");
    return {b, {begin / kGltfAlignment * kGltfAlignment, begin + size}};
  };
  for (const Gltf& view : json_["bufferViews"]) {
    const auto [b, range] = range_of(view);
    ranges[b].push_back(range);
  }
  std::vector<std::vector<std::size_t>> places(ranges.size());  // ranges by buffer, as indices into
                                                                // `all`
  for (std::size_t b = 0; b < ranges.size(); ++b) {
    std::sort(ranges[b].begin(), ranges[b].end());
    std::vector<Range> apart;
    for (const Range& range : ranges[b])
      if (!apart.empty() && range.first <= apart.back().second)
        apart.back().second = std::max(apart.back().second, range.second);
      else
        apart.push_back(range);
    ranges[b] = std::move(apart);
    for (const auto& [begin, end] : ranges[b]) {
      pad(all, '\0');
      places[b].push_back(all.size());
      all += buffers[b].substr(begin, end - begin);
    }
  }
  for (Gltf& view : json_["bufferViews"]) {
    const std::size_t b = range_of(view).first;
    const std::size_t begin =
        document.optional_index(view, "byteOffset", "bufferViews").value_or(0);
    const auto behind = std::upper_bound(ranges[b].begin(), ranges[b].end(),
                                         Range(begin, std::numeric_limits<std::size_t>::max()));
    const auto k = static_cast<std::size_t>(behind - ranges[b].begin() - 1);
    view["buffer"] = kBuffer;
    view["byteOffset"] = places[b][k] + begin - ranges[b][k].first;
  }
  binary_ = std::move(all);
}

void GltfOutput::drop_unused(const GltfDocument& document) {
  Gltf before = document.json();
  for (const char* key : {"extensionsUsed", "extensionsRequired"})
    if (before.contains(key))
      for (const Gltf& name : before[key])
        if (!is_known(name.get<std::string>())) return;
  drop_entries(json_, "textures", references(before, visit_texture_numbers), visit_texture_numbers);
  drop_entries(json_, "images", references(before, visit_image_numbers), visit_image_numbers);
  drop_entries(json_, "accessors", references(before, visit_accessors), visit_accessors);
  drop_entries(json_, "bufferViews", references(before, visit_views), visit_views);
  gather(document, {binary_});
}

Gltf GltfOutput::with_buffer() const {
  Gltf json = json_;
  set_mark(json["asset"]);
  Gltf buffer =
      json.contains("buffers") && !json["buffers"].empty() ? json["buffers"][0] : Gltf::object();
  buffer.erase("uri");
  buffer["byteLength"] = binary_.size();
  if (binary_.empty())
    json.erase("buffers");
  else
    json["buffers"] = Gltf::array({buffer});
  return json;
}

std::string GltfOutput::glb() const {
  constexpr std::uint32_t kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  std::string text = with_buffer().dump();
  pad(text, ' ');
  std::string binary = binary_;
  pad(binary, '\0');
  const std::size_t size =
      kHeader + kChunkHeader + text.size() + (binary.empty() ? 0 : kChunkHeader + binary.size());
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorKind::Invalid, "more than 4 GB, which GLB does not hold; write .gltf");
  std::string file = "glTF";
  file.reserve(size);
  append_bytes(kVersion, file);
  append_bytes(static_cast<std::uint32_t>(size), file);
  const auto add_chunk = [&](std::uint32_t kind, const std::string& content) {
    append_bytes(static_cast<std::uint32_t>(content.size()), file);
    append_bytes(kind, file);
    file += content;
  };
  add_chunk(kJsonChunk, text);
  if (!binary.empty()) add_chunk(kBinaryChunk, binary);
  return file;
}

std::string GltfOutput::text() const {
  Gltf json = with_buffer();
  if (!binary_.empty()) {
    std::string uri = "data:application/octet-stream;base64,";
    append_base64(binary_, uri);
    json["buffers"][0]["uri"] = std::move(uri);
  }
  return json.dump(1) + "\n";
}

std::size_t add_indices(GltfOutput& out, const std::vector<std::uint32_t>& indices,
                        std::size_t vertices, GltfComponent component) {
  if (component == GltfComponent::UByte && vertices > std::numeric_limits<std::uint8_t>::max())
    component = GltfComponent::UShort;
  if (component == GltfComponent::UShort && vertices > std::numeric_limits<std::uint16_t>::max())
    component = GltfComponent::UInt;
  std::string bytes;
  bytes.reserve(indices.size() * size_of(component));
  for (const std::uint32_t k : indices) {
    if (component == GltfComponent::UByte)
      append_bytes(static_cast<std::uint8_t>(k), bytes);
    else if (component == GltfComponent::UShort)
      append_bytes(static_cast<std::uint16_t>(k), bytes);
    else
      append_bytes(k, bytes);
  }
  return out.add_accessor({{"componentType", static_cast<int>(component)},
                           {"type", "SCALAR"},
                           {"count", indices.size()}},
                          bytes, size_of(component), GltfOutput::Target::Indices);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
