#include "distributed/write_parts.h"

#include <fmt/format.h>

#include <filesystem>

#include "distributed/internal/collect.h"
#include "majorant/framework/error.h"
#include "majorant/io/internal/pvtu.h"
#include "majorant/io/vtu.h"

namespace majorant {
namespace {

void require_same(const std::string& path, const MapFile& written, const MapFile& read) {
  if (written.uv == read.uv && written.points == read.points && written.cells == read.cells &&
      written.input_vertex == read.input_vertex && written.input_face == read.input_face)
    return;
  throw Error(ErrorKind::Invalid, path + ": the file does not read back as it was written");
}

}  // namespace

void write_parts(const std::string& path, const MeshPart& part, const PartResult& result,
                 const std::string& claims) {
  const Ranks& ranks = part.ranks();
  const std::filesystem::path whole(path);
  const auto name_of = [&](int rank) {
    return fmt::format("{}_{}.vtu", whole.stem().string(), rank);
  };
  MapFile file;
  if (part.mesh->face_count() > 0) {
    file = to_map_file(*result.map);
    file.distortion = result.measures.face_value;
    file.min_det = result.measures.min_det;
    file.claims = claims;
    const std::string name = (whole.parent_path() / name_of(ranks.rank())).string();
    write_vtu(name, file,
              [&](const std::string& temporary) { require_same(name, file, read_vtu(temporary)); });
  }
  // Also: everybody is done.
  const auto counts = gathered(ranks, {static_cast<double>(part.mesh->face_count())});
  if (ranks.rank() > 0) return;
  std::vector<std::string> pieces;
  for (std::size_t r = 0; r < counts.size(); ++r)
    if (counts[r][0] > 0) pieces.push_back(name_of(static_cast<int>(r)));
  write_pvtu(path, file, pieces);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
