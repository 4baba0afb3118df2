#include "majorant/io/internal/gltf_compression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "majorant/io/read_mesh.h"

#ifdef MAJORANT_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif
#ifdef MAJORANT_HAS_DRACO
#include <draco/compression/decode.h>
#endif

namespace majorant {
namespace {

using Json = nlohmann::json;

[[maybe_unused]] const Json* member(const Json& object, std::string_view key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

[[maybe_unused]] const Json* extension(const Json& object, std::string_view name) {
  const Json* extensions = member(object, "extensions");
  return extensions ? member(*extensions, name) : nullptr;
}

[[maybe_unused]] void remove_extension(Json& object, std::string_view name) {
  Json& extensions = object["extensions"];
  extensions.erase(std::string(name));
  if (extensions.empty()) object.erase("extensions");
}

[[maybe_unused]] void remove_name(Json& json, std::string_view name) {
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
    if (!json.contains(key)) continue;
    Json& names = json[key];
    names.erase(std::remove(names.begin(), names.end(), Json(name)), names.end());
    if (names.empty()) json.erase(key);
  }
}

// Checked numbers of an object. Sums and products with small numbers stay below 2^64.
class Numbers {
 public:
  Numbers(const Json& object, std::string name, const GltfDecoding& decoding)
      : object_(object), name_(std::move(name)), decoding_(decoding) {}

  std::size_t operator[](const char* key) const {
    constexpr std::uint64_t kLargest = std::uint64_t{1} << 40;
    const Json* value = member(object_, key);
    if (!value || !value->is_number_unsigned() || value->get<std::uint64_t>() > kLargest)
      fail(fmt::format("{} is no number of anything", key));
    return value->get<std::size_t>();
  }
  std::size_t value(const char* key, std::size_t otherwise) const {
    return member(object_, key) ? (*this)[key] : otherwise;
  }
  std::string text(const char* key, const char* otherwise) const {
    const Json* value = member(object_, key);
    if (value && !value->is_string()) fail(fmt::format("{} is no text", key));
    return value ? value->get<std::string>() : otherwise;
  }
  [[noreturn]] void fail(const std::string& problem) const {
    decoding_.damaged(fmt::format("{}: {}", name_, problem));
    std::abort();  // damaged() has thrown
  }

 private:
  const Json& object_;
  std::string name_;
  const GltfDecoding& decoding_;
};

// Returns the bytes that `part` takes from its buffer.
[[maybe_unused]] std::string_view bytes_of(const Numbers& part,
                                           const std::vector<std::string>& buffers) {
  const std::size_t b = part["buffer"], begin = part.value("byteOffset", 0),
                    size = part["byteLength"];
  if (b >= buffers.size()) part.fail(fmt::format("buffer {} out of range", b));
  if (begin > buffers[b].size() || size > buffers[b].size() - begin)
    part.fail("it goes beyond its buffer");
  return std::string_view(buffers[b]).substr(begin, size);
}

}  // namespace

bool is_meshopt_fallback(const Json& buffer) {
  const Json* meshopt = extension(buffer, kMeshopt);
  const Json* is_fallback = meshopt ? member(*meshopt, "fallback") : nullptr;
  return has_meshopt() && is_fallback && *is_fallback == true && !buffer.contains("uri");
}

#ifdef MAJORANT_HAS_MESHOPTIMIZER

bool has_meshopt() { return true; }

namespace {

enum class Filter { None, Octahedral, Quaternion, Exponential };

// Decodes one buffer view into `to`, of count * stride bytes. The library only asserts these
// requirements.
void decode_view(const Numbers& view, std::string_view bytes, std::size_t count, std::size_t stride,
                 std::string& to) {
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  const std::string mode = view.text("mode", ""), filter = view.text("filter", "NONE");
  const auto require = [&view](bool holds, const char* problem) {
    if (!holds) view.fail(problem);
  };
  int error = 0;
  if (mode == "ATTRIBUTES") {
    constexpr std::size_t kLargest = 256;
    require(stride > 0 && stride % 4 == 0 && stride <= kLargest, "byteStride of no attributes");
    error = meshopt_decodeVertexBuffer(to.data(), count, stride, data, bytes.size());
  } else {
    require(stride == 2 || stride == 4, "byteStride of no indices");
    require(filter == "NONE", "a filter of indices");
    if (mode == "TRIANGLES") {
      require(count % 3 == 0, "triangles of a count that is no multiple of 3");
      error = meshopt_decodeIndexBuffer(to.data(), count, stride, data, bytes.size());
    } else if (mode == "INDICES") {
      error = meshopt_decodeIndexSequence(to.data(), count, stride, data, bytes.size());
    } else {
      view.fail("unknown mode");
    }
  }
  require(error == 0, "the compressed bytes cannot be decoded");
  if (filter == "OCTAHEDRAL") {
    require(stride == 4 || stride == 8, "byteStride of no octahedral filter");
    meshopt_decodeFilterOct(to.data(), count, stride);
  } else if (filter == "QUATERNION") {
    require(stride == 8, "byteStride of no filter of quaternions");
    meshopt_decodeFilterQuat(to.data(), count, stride);
  } else if (filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(to.data(), count, stride);
  } else {
    require(filter == "NONE", "unknown filter");
  }
}

}  // namespace

void decode_meshopt(Json& json, std::vector<std::string>& buffers, const GltfDecoding& decoding) {
  if (Json* views = json.contains("bufferViews") ? &json["bufferViews"] : nullptr) {
    for (std::size_t k = 0; k < views->size(); ++k) {
      Json& entry = (*views)[k];
      const Json* compressed = extension(entry, kMeshopt);
      if (!compressed) continue;
      const std::string name = fmt::format("bufferView {} ({})", k, kMeshopt);
      const Numbers view(*compressed, name, decoding);
      const Numbers place(entry, name, decoding);
      const std::size_t count = view["count"], stride = view["byteStride"];
      const std::string_view room = bytes_of(place, buffers);
      if (stride == 0 || count > room.size() / stride) view.fail("more elements than it has room");
      std::string decoded(count * stride, '\0');
      decode_view(view, bytes_of(view, buffers), count, stride, decoded);
      buffers[place["buffer"]].replace(place.value("byteOffset", 0), decoded.size(), decoded);
      remove_extension(entry, kMeshopt);
    }
  }
  if (json.contains("buffers"))
    for (Json& buffer : json["buffers"])
      if (extension(buffer, kMeshopt)) remove_extension(buffer, kMeshopt);
  remove_name(json, kMeshopt);
}

#else

bool has_meshopt() { return false; }
void decode_meshopt(Json&, std::vector<std::string>&, const GltfDecoding&) {}

#endif

#ifdef MAJORANT_HAS_DRACO

bool has_draco() { return true; }

namespace {

// Targets of bufferViews: vertex attributes, indices.
constexpr unsigned kArrayBuffer = 34962, kElementArrayBuffer = 34963;
enum class Component { Byte = 5120, UByte, Short, UShort, UInt = 5125, Float };

template <class T>
void append(T value, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

// The values of an attribute, in the form of an accessor.
struct AttributeValues {
  std::string bytes;
  std::size_t stride = 0;  // of a vertex: a multiple of 4, as glTF requires
  Json low, high;          // by component; null if values are not finite
};

// Returns the values at every point, each of `width` components of type T; none if they have
// another type.
template <class T>
std::optional<AttributeValues> values_as(const draco::PointAttribute& attribute, std::size_t points,
                                         int width) {
  constexpr std::size_t kAlignment = 4;
  const std::size_t components = static_cast<std::size_t>(width), size = components * sizeof(T);
  AttributeValues out;
  out.stride = (size + kAlignment - 1) / kAlignment * kAlignment;
  out.bytes.reserve(points * out.stride);
  std::array<T, 16> value{}, low{}, high{};  // of the widest type, a matrix
  bool is_finite = points > 0;
  for (std::size_t p = 0; p < points; ++p) {
    const auto k = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(p)));
    if (k.value() >= attribute.size() ||
        !attribute.ConvertValue<T>(k, static_cast<std::int8_t>(width), value.data()))
      return std::nullopt;
    out.bytes.append(reinterpret_cast<const char*>(value.data()), size);
    out.bytes.append(out.stride - size, '\0');
    for (std::size_t c = 0; c < components; ++c) {
      is_finite = is_finite && std::isfinite(static_cast<double>(value[c]));
      low[c] = p == 0 ? value[c] : std::min(low[c], value[c]);
      high[c] = p == 0 ? value[c] : std::max(high[c], value[c]);
    }
  }
  if (!is_finite) return out;
  out.low = out.high = Json::array();
  for (std::size_t c = 0; c < components; ++c) {
    out.low.push_back(low[c]);
    out.high.push_back(high[c]);
  }
  return out;
}

std::optional<AttributeValues> values_of(const draco::PointAttribute& attribute, Component type,
                                         std::size_t points, int width) {
  switch (type) {
    case Component::Byte:
      return values_as<std::int8_t>(attribute, points, width);
    case Component::UByte:
      return values_as<std::uint8_t>(attribute, points, width);
    case Component::Short:
      return values_as<std::int16_t>(attribute, points, width);
    case Component::UShort:
      return values_as<std::uint16_t>(attribute, points, width);
    case Component::UInt:
      return values_as<std::uint32_t>(attribute, points, width);
    case Component::Float:
      return values_as<float>(attribute, points, width);
  }
  return std::nullopt;
}

int width_of(const std::string& type) {
  constexpr std::array<std::pair<std::string_view, int>, 7> kWidths = {{{"SCALAR", 1},
                                                                        {"VEC2", 2},
                                                                        {"VEC3", 3},
                                                                        {"VEC4", 4},
                                                                        {"MAT2", 4},
                                                                        {"MAT3", 9},
                                                                        {"MAT4", 16}}};
  for (const auto& [name, width] : kWidths)
    if (type == name) return width;
  return 0;
}

// Decodes the Draco primitives of a document.
class DracoDecoder {
 public:
  DracoDecoder(Json& json, std::vector<std::string>& buffers, const GltfDecoding& decoding)
      : json_(json), buffers_(buffers), decoding_(decoding) {}

  void decode(Json& primitive, std::size_t mesh) {
    const Json compressed = *extension(primitive, kDraco);
    const Numbers numbers(compressed, fmt::format("mesh {} ({})", mesh, kDraco), decoding_);
    const std::size_t view = numbers["bufferView"];
    const draco::Mesh& decoded = mesh_of(view, numbers);
    if (primitive.contains("mode") && primitive["mode"] != 4 && primitive["mode"] != 5)
      numbers.fail("mode of no triangles");
    primitive["mode"] = 4U;  // decoded primitives are triangles
    std::string bytes;
    for (std::uint32_t f = 0; f < decoded.num_faces(); ++f)
      for (const draco::PointIndex& corner : decoded.face(draco::FaceIndex(f)))
        append(corner.value(), bytes);
    const bool is_first = used_views_.insert(view).second;
    std::optional<std::size_t> number;
    Json indices{{"type", "SCALAR"}};
    if (primitive.contains("indices")) {
      number = Numbers(primitive, "primitive", decoding_)["indices"];
      indices = accessor(*number, numbers);
    }
    indices["componentType"] = static_cast<unsigned>(Component::UInt);
    for (const char* bound : {"min", "max"}) indices.erase(bound);
    primitive["indices"] = set_accessor(
        number, std::move(indices), std::move(bytes), std::size_t{3} * decoded.num_faces(),
        is_first ? std::optional(view) : std::nullopt, {{"target", kElementArrayBuffer}});
    const Json* attributes = member(compressed, "attributes");
    if (!attributes || !attributes->is_object()) numbers.fail("attributes is no object");
    for (const auto& [name, id] : attributes->items())
      decode_attribute(primitive, name, Numbers(*attributes, "attributes", decoding_)[name.c_str()],
                       decoded, numbers);
    remove_extension(primitive, kDraco);
  }

 private:
  void decode_attribute(Json& primitive, const std::string& name, std::size_t id,
                        const draco::Mesh& decoded, const Numbers& numbers) {
    const draco::PointAttribute* values =
        decoded.GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
    if (!values || id > std::numeric_limits<std::uint32_t>::max())
      numbers.fail(fmt::format("it has no attribute {} for {}", id, name));
    if (!primitive.contains("attributes") || !member(primitive["attributes"], name))
      numbers.fail(fmt::format("the primitive has no attribute {}", name));
    const std::size_t number =
        Numbers(primitive["attributes"], "attributes", decoding_)[name.c_str()];
    Json entry = accessor(number, numbers);
    const Numbers fields(entry, "accessors", decoding_);
    const int width = width_of(fields.text("type", ""));
    const std::size_t type = fields["componentType"], points = decoded.num_points();
    if (width == 0 || width != values->num_components())
      numbers.fail(fmt::format("{} has other components than its accessor", name));
    std::optional<AttributeValues> found =
        values_of(*values, static_cast<Component>(type), points, width);
    if (!found) numbers.fail(fmt::format("{} cannot be had as its accessor says", name));
    // Quantization changes values and their bounds.
    const auto set_bound = [&entry](const char* bound, Json extremes) {
      if (!entry.contains(bound)) return;
      if (extremes.is_null())
        entry.erase(bound);
      else
        entry[bound] = std::move(extremes);
    };
    set_bound("min", std::move(found->low));
    set_bound("max", std::move(found->high));
    Json view{{"byteStride", found->stride}, {"target", kArrayBuffer}};
    primitive["attributes"][name] = set_accessor(number, std::move(entry), std::move(found->bytes),
                                                 points, std::nullopt, std::move(view));
  }

  Json accessor(std::size_t k, const Numbers& numbers) const {
    if (!json_.contains("accessors") || k >= json_["accessors"].size())
      numbers.fail(fmt::format("accessor {} out of range", k));
    return json_["accessors"][k];
  }

  // Decodes each view once, even if several primitives name it.
  const draco::Mesh& mesh_of(std::size_t view, const Numbers& numbers) {
    std::unique_ptr<draco::Mesh>& mesh = meshes_[view];
    if (mesh) return *mesh;
    if (!json_.contains("bufferViews") || view >= json_["bufferViews"].size())
      numbers.fail(fmt::format("bufferView {} out of range", view));
    const std::string_view bytes =
        bytes_of(Numbers(json_["bufferViews"][view], fmt::format("bufferView {}", view), decoding_),
                 buffers_);
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) numbers.fail(fmt::format("Draco: {}", decoded.status().error_msg_string()));
    mesh = std::move(decoded).value();
    for (std::uint32_t f = 0; f < mesh->num_faces(); ++f)
      for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(f)))
        if (corner.value() >= mesh->num_points()) numbers.fail("a corner of no vertex");
    return *mesh;
  }

  // Puts these bytes into a new buffer and view, and the accessor at this number, or after all
  // others if another primitive uses the number. Returns its number. at: a compressed view without
  // other uses, whose number is reused. view: the further members of the view.
  std::size_t set_accessor(std::optional<std::size_t> number, Json entry, std::string bytes,
                           std::size_t count, std::optional<std::size_t> at,
                           Json view = Json::object()) {
    decoding_.reserve(bytes.size());
    view["buffer"] = buffers_.size();
    view["byteLength"] = bytes.size();
    json_["buffers"].push_back({{"byteLength", bytes.size()}});
    buffers_.push_back(std::move(bytes));
    if (at)
      freed_.emplace_back(*at, std::move(view));
    else
      json_["bufferViews"].push_back(std::move(view));
    entry["bufferView"] = at ? *at : json_["bufferViews"].size() - 1;
    entry.erase("byteOffset");
    entry.erase("sparse");
    entry["count"] = count;
    Json& accessors = json_["accessors"];
    if (!number || !set_accessors_.insert(*number).second) {
      number = accessors.size();
      accessors.push_back(nullptr);
    }
    accessors[*number] = std::move(entry);
    return *number;
  }

 public:
  // Gives freed views their new content, after everything compressed in them is decoded.
  void finish() {
    for (auto& [k, view] : freed_) json_["bufferViews"][k] = std::move(view);
  }

 private:
  Json& json_;
  std::vector<std::string>& buffers_;
  const GltfDecoding& decoding_;
  std::map<std::size_t, std::unique_ptr<draco::Mesh>> meshes_;
  std::set<std::size_t> used_views_, set_accessors_;
  std::vector<std::pair<std::size_t, Json>> freed_;
};

}  // namespace

void decode_draco(Json& json, std::vector<std::string>& buffers, const GltfDecoding& decoding) {
  DracoDecoder decoder(json, buffers, decoding);
  const std::size_t meshes = json.contains("meshes") ? json["meshes"].size() : 0;
  for (std::size_t m = 0; m < meshes; ++m) {
    if (!json["meshes"][m].contains("primitives") || !json["meshes"][m]["primitives"].is_array())
      continue;
    for (std::size_t p = 0; p < json["meshes"][m]["primitives"].size(); ++p) {
      Json primitive = json["meshes"][m]["primitives"][p];
      if (!extension(primitive, kDraco)) continue;
      decoder.decode(primitive, m);
      json["meshes"][m]["primitives"][p] = std::move(primitive);
    }
  }
  decoder.finish();
  remove_name(json, kDraco);
}

#else

bool has_draco() { return false; }
void decode_draco(Json&, std::vector<std::string>&, const GltfDecoding&) {}

#endif

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
