#include "distributed/internal/checkpoint_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "majorant/framework/error.h"
#include "majorant/io/internal/atomic_file.h"
#include "majorant/io/internal/byte_cursor.h"
#include "majorant/io/internal/input_file.h"

namespace majorant {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as memory has them");

constexpr std::string_view kMagic = "majorckp";
// Of the format. Origin: raised where the bytes or what the header must have change.
constexpr std::uint64_t kVersion = 1;

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

void append(std::string& bytes, const Vec& values) {
  append(bytes, values.data(), static_cast<std::size_t>(values.size()));
}

std::uint64_t hashed(std::string_view bytes) {
  return majorant::hashed(std::as_bytes(std::span(bytes.data(), bytes.size())));
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw Error(ErrorKind::Unreadable,
              fmt::format("{}: {}; resume from another checkpoint, or start anew without --resume",
                          path, why));
}

// What is in the cache of the system only is lost with it.
void flush(const std::string& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
  const bool done = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int code = errno;
  if (descriptor >= 0) ::close(descriptor);
  // There are file systems that have no fsync of folders.
  if (!done && !(code == EINVAL && (flags & O_DIRECTORY)))
    throw Error(ErrorKind::Usage, fmt::format("cannot write {}: {}", path, std::strerror(code)));
}

Vec numbers(ByteCursor& in, std::size_t count) {
  Vec values(static_cast<Index>(count));
  for (double& v : values) v = in.next<double>();
  return values;
}

// Of the rest after the header; what it should be, where the header says so.
struct Sizes {
  std::size_t vertices, faces, others;
  explicit Sizes(const Json& header) : vertices(header.at("vertices")), faces(header.at("faces")) {
    const std::size_t degree = header.at("degree");
    others = faces * ((degree + 1) * (degree + 2) / 2 - 3);
  }
  std::size_t bytes() const { return 2 * sizeof(double) * (2 * vertices + others) + faces; }
};

}  // namespace

std::uint64_t hashed(std::span<const std::byte> bytes, std::uint64_t hash) {
  constexpr std::uint64_t kPrime = 0x100000001b3;
  for (const std::byte b : bytes) hash = (hash ^ static_cast<std::uint64_t>(b)) * kPrime;
  return hash;
}

void write_checkpoint_file(const std::string& path, const CheckpointFile& file) {
  const std::string header = file.header.dump();
  const std::uint64_t lengths[] = {kVersion, header.size()};
  std::string bytes(kMagic);
  bytes.reserve(bytes.size() + sizeof lengths + header.size() + Sizes(file.header).bytes() +
                sizeof(std::uint64_t));
  append(bytes, lengths, std::size(lengths));
  bytes += header;
  append(bytes, file.start);
  append(bytes, file.vertex_points);
  append(bytes, file.other_points);
  append(bytes, file.levels.data(), file.levels.size());
  const std::uint64_t check = hashed(bytes);
  append(bytes, &check, 1);
  write_file_atomically(path, bytes,
                        [](const std::string& temporary) { flush(temporary, O_RDONLY); });
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  flush(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY);
}

CheckpointFile read_checkpoint_file(const std::string& path) {
  const std::string bytes = read_whole_file(path);
  ByteCursor in(path, bytes, ByteOrder::Little);
  if (!bytes.starts_with(kMagic)) refuse(path, "it is no checkpoint of majorant-mpi");
  in.skip(kMagic.size());
  if (in.remaining() < 3 * sizeof(std::uint64_t)) refuse(path, "it is cut short");
  if (const auto version = in.next<std::uint64_t>(); version != kVersion)
    refuse(path, fmt::format("its format has version {}, this majorant-mpi reads version {}",
                             version, kVersion));
  const std::string_view content(bytes.data(), bytes.size() - sizeof(std::uint64_t));
  if (hashed(content) !=
      load_bytes<std::uint64_t>(content.data() + content.size(), ByteOrder::Little))
    refuse(path, "it is damaged or cut short, its checksum does not fit");
  const auto length = in.next<std::uint64_t>();
  const std::string_view header = content.substr(bytes.size() - in.remaining(), length);
  in.skip(length);
  CheckpointFile file;
  const Sizes sizes = [&] {
    try {
      file.header = Json::parse(header);
      return Sizes(file.header);
    } catch (const Json::exception&) {
      refuse(path, "its header cannot be read");
    }
  }();
  if (in.remaining() != sizes.bytes() + sizeof(std::uint64_t))
    refuse(path, "its header does not say how long it is");
  file.start = numbers(in, 2 * sizes.vertices);
  file.vertex_points = numbers(in, 2 * sizes.vertices);
  file.other_points = numbers(in, 2 * sizes.others);
  file.levels.resize(sizes.faces);
  for (std::uint8_t& level : file.levels) level = in.next<std::uint8_t>();
  return file;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
