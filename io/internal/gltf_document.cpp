#include "majorant/io/internal/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/base64.h"
#include "majorant/io/byte_cursor.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files/reading_limit.h"
#include "majorant/io/internal/gltf_compression.h"

namespace majorant {
namespace {

constexpr std::size_t kLargestStride = 252;

constexpr std::array<std::pair<std::string_view, std::size_t>, 7> kWidths = {
    {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};

}  // namespace

std::size_t size_of(GltfComponent component) {
  switch (component) {
    case GltfComponent::Byte:
    case GltfComponent::UByte:
      return 1;
    case GltfComponent::Short:
    case GltfComponent::UShort:
      return 2;
    case GltfComponent::UInt:
    case GltfComponent::Float:
      return 4;
  }
  return 0;
}

std::uint32_t GltfElements::integer(std::size_t element, std::size_t k) const {
  const char* at = bytes.data() + element * element_size() + k * size_of(component);
  if (component == GltfComponent::UByte) return load_bytes<std::uint8_t>(at, ByteOrder::Little);
  if (component == GltfComponent::UShort) return load_bytes<std::uint16_t>(at, ByteOrder::Little);
  return load_bytes<std::uint32_t>(at, ByteOrder::Little);
}

double GltfElements::value(std::size_t element, std::size_t k) const {
  const char* at = bytes.data() + element * element_size() + k * size_of(component);
  const auto number = [&]<class T>(T) -> double {
    const auto x = static_cast<double>(load_bytes<T>(at, ByteOrder::Little));
    if (!normalized || component == GltfComponent::Float) return x;
    return std::max(x / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
  };
  switch (component) {
    case GltfComponent::Byte:
      return number(std::int8_t{});
    case GltfComponent::UByte:
      return number(std::uint8_t{});
    case GltfComponent::Short:
      return number(std::int16_t{});
    case GltfComponent::UShort:
      return number(std::uint16_t{});
    case GltfComponent::UInt:
      return number(std::uint32_t{});
    case GltfComponent::Float:
      return number(float{});
  }
  return 0;
}

GltfDocument::GltfDocument(const std::string& path, const std::string& content,
                           const StopCheck& stop)
    : path_(path), given_(content.size()) {
  GltfContent parts = parse_gltf(path, content);
  json_ = std::move(parts.json);
  load_buffers(std::move(parts.binary), stop);
  decode_geometry();
  std::size_t ignored = 0;
  for (std::size_t k = 0; k < list("bufferViews").size(); ++k) view(k, ignored);
  for (std::size_t k = 0; k < list("accessors").size(); ++k) layout(k, "accessors");
}

std::size_t GltfDocument::index(const Gltf& object, const char* key, const char* name) const {
  // Sums and products with small numbers stay below 2^64.
  constexpr std::uint64_t kLargest = std::uint64_t{1} << 53;
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_unsigned() ||
      found->get<std::uint64_t>() > kLargest)
    damaged(fmt::format("{}: {} is no number of anything", name, key));
  return found->get<std::size_t>();
}

std::optional<std::size_t> GltfDocument::optional_index(const Gltf& object, const char* key,
                                                        const char* name) const {
  if (!object.contains(key)) return std::nullopt;
  return index(object, key, name);
}

// name: the list of the entry with the URI.
std::string GltfDocument::bytes_of(const std::string& uri, const char* name,
                                   const StopCheck& stop) const {
  if (!is_data_uri(uri)) return read_whole_file(file_of_uri(path_, uri), stop);
  constexpr std::string_view kBase64 = ";base64,";
  const std::size_t begin = uri.find(kBase64);
  if (begin == std::string::npos) damaged(fmt::format("{}: uri is no base64 data", name));
  std::string text = uri.substr(begin + kBase64.size());
  constexpr std::size_t kGroup = 4;
  while (text.size() % kGroup != 0) text += '=';
  std::optional<std::string> bytes = decode_base64(text);
  if (!bytes) damaged(fmt::format("{}: uri is no base64 data", name));
  return *std::move(bytes);
}

std::string GltfDocument::image(std::size_t k, const StopCheck& stop) const {
  if (k >= list("images").size()) damaged(fmt::format("image {} out of range", k));
  const Gltf& entry = list("images")[k];
  if (entry.contains("uri")) return bytes_of(entry["uri"].get<std::string>(), "images", stop);
  std::size_t stride = 0;
  return std::string(view(index(entry, "bufferView", "images"), stride));
}

void GltfDocument::load_buffers(std::optional<std::string> binary, const StopCheck& stop) {
  const ReadingLimit limit(path_);
  std::map<std::string, std::size_t> known;  // by URI, so that each file is read once
  std::size_t held = given_;
  for (const Gltf& entry : list("buffers")) {
    const std::size_t size = index(entry, "byteLength", "buffers");
    std::string bytes;
    if (entry.contains("uri")) {
      if (!entry["uri"].is_string()) damaged("buffers: uri is no text");
      const auto uri = entry["uri"].get<std::string>();
      const auto [place, is_new] = known.try_emplace(uri, buffers_.size());
      bytes = is_new ? bytes_of(uri, "buffers", stop) : buffers_[place->second];
      if (is_new) given_ += bytes.size();
    } else if (is_meshopt_fallback(entry)) {
      limit.require(held + size);
      bytes.assign(size, '\0');
    } else if (buffers_.empty() && binary) {
      bytes = *std::move(binary);
    } else if (size > 0) {
      damaged(fmt::format("buffers: there are no bytes of buffer {}", buffers_.size()));
    }
    if (bytes.size() < size)
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}: buffer {} has {} bytes, announced are {}; the file is truncated",
                              path_, buffers_.size(), bytes.size(), size));
    held += bytes.size();
    limit.require(held);
    bytes.resize(size);
    buffers_.push_back(std::move(bytes));
  }
}

void GltfDocument::decode_geometry() {
  const ReadingLimit limit(path_);
  std::size_t held = given_;
  for (const std::string& bytes : buffers_) held += bytes.size();
  const GltfDecoding decoding{
      .damaged = [this](const std::string& problem) { damaged(problem); },
      .reserve =
          [&](std::size_t bytes) {
            held += bytes;
            limit.require(held);
          },
  };
  decode_meshopt(json_, buffers_, decoding);
  decode_draco(json_, buffers_, decoding);
}

std::string_view GltfDocument::view(std::size_t k, std::size_t& stride) const {
  const Gltf& views = list("bufferViews");
  if (k >= views.size()) damaged(fmt::format("bufferView {} out of range", k));
  const Gltf& entry = views[k];
  const std::size_t b = index(entry, "buffer", "bufferViews");
  if (b >= buffers_.size()) damaged(fmt::format("bufferViews: buffer {} out of range", b));
  const std::size_t offset = optional_index(entry, "byteOffset", "bufferViews").value_or(0);
  const std::size_t size = index(entry, "byteLength", "bufferViews");
  if (offset > buffers_[b].size() || size > buffers_[b].size() - offset)
    damaged(fmt::format("bufferView {} goes beyond its buffer", k));
  stride = optional_index(entry, "byteStride", "bufferViews").value_or(0);
  if (stride > kLargestStride) damaged(fmt::format("bufferView {}: byteStride {}", k, stride));
  return std::string_view(buffers_[b]).substr(offset, size);
}

void GltfDocument::take(std::size_t bytes) const {
  // The limit of sparse data. Real morph targets, of which few vertices move, stay below it.
  constexpr std::size_t kMaxExpansion = 100;
  const std::size_t most = ReadingLimit::kOnTop + kMaxExpansion * given_;
  if (bytes > most || taken_ > most - bytes)
    damaged("it announces far more elements than it has bytes");
  taken_ += bytes;
}

GltfDocument::Layout GltfDocument::layout(std::size_t accessor, std::string_view what) const {
  const Gltf& accessors = list("accessors");
  if (accessor >= accessors.size())
    damaged(fmt::format("{}: accessor {} out of range", what, accessor));
  const Gltf& entry = accessors[accessor];
  const auto bad = [&](std::string_view problem) {
    damaged(fmt::format("accessor {} ({}): {}", accessor, what, problem));
  };
  Layout layout;
  GltfElements& out = layout.elements;
  const std::size_t component = index(entry, "componentType", "accessors");
  constexpr std::array<std::size_t, 6> kComponents = {5120, 5121, 5122, 5123, 5125, 5126};
  if (std::find(kComponents.begin(), kComponents.end(), component) == kComponents.end())
    bad("unknown componentType");
  out.component = static_cast<GltfComponent>(component);
  const auto type = entry.find("type");
  const auto* const width = std::find_if(kWidths.begin(), kWidths.end(), [&](const auto& known) {
    return type != entry.end() && type->is_string() && *type == known.first;
  });
  if (width == kWidths.end()) bad("unknown type");
  out.width = width->second;
  out.normalized = entry.contains("normalized") && entry["normalized"] == true;
  out.count = index(entry, "count", "accessors");
  if (out.count == 0) bad("it has no elements");
  const std::size_t size = out.element_size();
  const std::size_t offset = optional_index(entry, "byteOffset", "accessors").value_or(0);
  if (const auto k = optional_index(entry, "bufferView", "accessors")) {
    std::size_t stride = 0;
    const std::string_view bytes = view(*k, stride);
    layout.stride = stride == 0 ? size : stride;
    if (offset > bytes.size() || size > bytes.size() - offset ||
        out.count - 1 > (bytes.size() - offset - size) / layout.stride)
      bad("it goes beyond its bufferView");
    layout.first = bytes.substr(offset);
  } else if (out.count > std::numeric_limits<std::uint32_t>::max()) {
    bad("too many elements");
  }
  return layout;
}

std::size_t GltfDocument::count(std::size_t accessor, std::string_view what) const {
  return layout(accessor, what).elements.count;
}

GltfElements GltfDocument::elements(std::size_t accessor, std::string_view what) const {
  const Layout from = layout(accessor, what);
  GltfElements out = from.elements;
  const std::size_t size = out.element_size();
  take(out.count * size);
  if (from.first.empty()) {
    out.bytes.assign(out.count * size, '\0');
  } else {
    out.bytes.reserve(out.count * size);
    for (std::size_t e = 0; e < out.count; ++e)
      out.bytes += from.first.substr(e * from.stride, size);
  }
  const Gltf& entry = list("accessors")[accessor];
  if (const auto sparse = entry.find("sparse"); sparse != entry.end()) scatter_sparse(*sparse, out);
  return out;
}

void GltfDocument::scatter_sparse(const Gltf& sparse, GltfElements& out) const {
  const auto part = [&](const char* key) -> const Gltf& {
    if (!sparse.is_object() || !sparse.contains(key) || !sparse[key].is_object())
      damaged(fmt::format("accessors: sparse.{} is no object", key));
    return sparse[key];
  };
  const Gltf &indices = part("indices"), &values = part("values");
  const std::size_t count = index(sparse, "count", "sparse");
  GltfElements places;
  const std::size_t component = index(indices, "componentType", "sparse.indices");
  places.component = static_cast<GltfComponent>(component);
  if (places.component != GltfComponent::UByte && places.component != GltfComponent::UShort &&
      places.component != GltfComponent::UInt)
    damaged("sparse.indices: componentType is none of indices");
  const auto bytes_of_part = [&](const Gltf& of, std::size_t size, const char* name) {
    std::size_t ignored = 0;
    const std::string_view bytes = view(index(of, "bufferView", name), ignored);
    const std::size_t offset = optional_index(of, "byteOffset", name).value_or(0);
    if (offset > bytes.size() || count > (bytes.size() - offset) / size)
      damaged(fmt::format("{} go beyond their bufferView", name));
    return bytes.substr(offset, count * size);
  };
  const std::size_t size = out.element_size();
  places.bytes = bytes_of_part(indices, size_of(places.component), "sparse.indices");
  const std::string_view elements = bytes_of_part(values, size, "sparse.values");
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t place = places.integer(k);
    if (place >= out.count) damaged(fmt::format("sparse.indices: {} out of range", place));
    out.bytes.replace(place * size, size, elements.substr(k * size, size));
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
