#include "apps/mpi/write_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "apps/mpi/internal/collect.h"
#include "apps/mpi/internal/rethrow_collectively.h"
#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/pvtu.h"
#include "majorant/io/vtu_text.h"

namespace majorant {
namespace {

void require_same(const std::string& path, const MapFile& written, const MapFile& read) {
  if (written.uv == read.uv && written.points == read.points && written.cells == read.cells &&
      written.input_vertex == read.input_vertex && written.input_face == read.input_face)
    return;
  throw Error(ErrorKind::Invalid, path + ": the file does not read back as it was written");
}

class PieceNames {
 public:
  explicit PieceNames(const std::string& path)
      : folder_(std::filesystem::path(path).parent_path()),
        stem_(std::filesystem::path(path).stem().string()) {}

  std::string of(int rank) const { return fmt::format("{}_{}.vtu", stem_, rank); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  bool is_one(const std::string& name) const {
    const std::size_t digits = name.find_first_not_of("0123456789", stem_.size() + 1);
    return name.starts_with(stem_ + "_") && digits > stem_.size() + 1 && digits < name.size() &&
           name.substr(digits) == ".vtu";
  }

 private:
  std::filesystem::path folder_;
  std::string stem_;
};

// Removes the result of an earlier run at `path` before the first new piece appears, so that old
// and new pieces cannot be mixed up.
void remove_older(const std::string& path, const PieceNames& names,
                  const std::vector<std::string>& pieces) {
  std::vector<std::string> older;
  try {
    if (std::filesystem::exists(path)) older = pvtu_pieces(path);
  } catch (const Error&) {
    // The file is not one of ours: only the file itself is replaced.
  }
  std::error_code code;
  if (std::filesystem::exists(path))
    std::filesystem::remove(std::filesystem::canonical(path), code);
  for (const std::string& name : older)
    if (!code && names.is_one(name) &&
        std::find(pieces.begin(), pieces.end(), name) == pieces.end())
      std::filesystem::remove(names.path(name), code);
  if (code) throw Error(ErrorKind::Usage, fmt::format("cannot write {}: {}", path, code.message()));
}

// Runs `work` on this rank. If it fails on one rank, all ranks throw.
template <class Work>
void together(const Ranks& ranks, const Work& work) {
  std::exception_ptr failure;
  try {
    work();
  } catch (...) {
    failure = std::current_exception();
  }
  rethrow_collectively(ranks, failure);
}

}  // namespace

void write_parts(const std::string& path, const MeshPart& part, const ParametrizationResult& result,
                 const std::string& claims) {
  const Ranks& ranks = part.ranks();
  const bool is_first = ranks.rank() == 0, has_faces = part.mesh->face_count() > 0;
  const PieceNames names(path);
  std::vector<std::string> pieces;
  const auto counts = gathered(ranks, {static_cast<double>(part.mesh->face_count())});
  for (std::size_t r = 0; r < counts.size(); ++r)
    if (counts[r][0] > 0) pieces.push_back(names.of(static_cast<int>(r)));
  std::unique_ptr<PendingFile> piece, whole;
  together(ranks, [&] {
    MapFile file;
    if (has_faces) {
      file = to_map_file(*result.map);
      file.distortion = result.measures.face_value;
      file.min_det = result.measures.min_det;
      file.claims = claims;
      const std::string name = names.path(names.of(ranks.rank()));
      piece = std::make_unique<PendingFile>(
          name, vtu_text(name, file, VtuCells::Bezier),
          [&](const std::string& temporary) { require_same(name, file, read_vtu(temporary)); });
    }
    if (is_first) whole = std::make_unique<PendingFile>(path, pvtu_text(file, pieces));
  });
  together(ranks, [&] {
    if (is_first) remove_older(path, names, pieces);
  });
  together(ranks, [&] {
    if (piece) piece->take_place();
  });
  together(ranks, [&] {
    if (whole) whole->take_place();
  });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
