#include "majorant/io/volume_files.h"

#include <fmt/format.h>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/formats.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/text_cursor.h"
#include "majorant/io/written_mark.h"
#include "majorant/volumes/mesh_source.h"

namespace majorant {
namespace {

std::string first_word(const std::string& path, const std::string& content, const StopCheck& stop) {
  TextCursor words(path, content, TextLines::Space, stop);
  return std::string(words.next_token());
}

// Returns the extension of the file that was read; empty if there was none.
std::string source_format(const VolumeMesh& mesh) {
  return mesh.source ? format_of(mesh.file) : std::string();
}

}  // namespace

void refuse_mesh(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::Unsupported, fmt::format("{}: {}", path, what));
}

VolumeMesh read_volume_mesh(const std::string& path, const StopCheck& stop) {
  if (!is_for(FormatUse::ReadCells, path)) {
    const std::vector<std::string> readable = extensions_for(FormatUse::ReadCells);
    require_format_name(path, in_words(readable, "or"), ErrorKind::Unsupported);
    refuse_mesh(path, fmt::format("meshes of volumes are read from {}, not {}",
                                  in_words(readable, "and"), format_of(path)));
  }
  return read_volume_content(path, read_whole_file(path, stop), stop);
}

VolumeMesh read_volume_content(const std::string& path, std::string content,
                               const StopCheck& stop) {
  return find_format(format_of(path))->read_cells(path, std::move(content), stop);
}

VolumeMesh read_mfem_or_medit_mesh(const std::string& path, std::string content,
                                   const StopCheck& stop) {
  require_text(path, content);
  const bool is_medit = first_word(path, content, stop) == "MeshVersionFormatted";
  return is_medit ? read_medit_mesh(path, std::move(content), stop)
                  : read_mfem_mesh(path, std::move(content), stop);
}

void require_volume_format(const std::string& path, const VolumeMesh& mesh,
                           const GmshChoice& choice) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::Usage, fmt::format("{}: {}", path, what));
  };
  const std::string extension = format_of(path), source = source_format(mesh);
  const Format* const format = find_format(extension);
  if (is_compressed(path)) refuse("meshes are not written compressed; leave out .gz");
  if ((choice.version || choice.encoding) && !is_for(FormatUse::WriteVersions, path))
    refuse(fmt::format("versions and encodings are of {}",
                       in_words(extensions_for(FormatUse::WriteVersions), "and")));
  if (extension == source) return;
  if (format == nullptr || !format->cells_text) {
    std::vector<std::string> written = extensions_for(FormatUse::WriteCells);
    if (const Format* own = find_format(source); own != nullptr && !own->cells_text)
      written.insert(written.begin(), source);
    refuse(fmt::format("a mesh {} is written as {}",
                       source.empty() ? "that was read from no file" : "of " + mesh.file,
                       in_words(written, "or")));
  }
  for (const CellBlock& block : mesh.blocks) {
    const bool is_lattice = block.type.kind == NodeKind::Uniform;
    if (block.type.kind == NodeKind::GaussLobatto || (!is_lattice && !format->has_control_points))
      refuse(fmt::format(
          "{} has no {} whose nodes are {}", extension, describe(block.type),
          block.type.kind == NodeKind::GaussLobatto ? "Gauss-Lobatto points" : "control points"));
    if (block.vertices.rows() > 0)
      refuse(
          fmt::format("{} has no elements with nodes of their own beside the vertices that they "
                      "share",
                      extension));
  }
}

std::string volume_mesh_content(const std::string& path, const VolumeMesh& mesh,
                                const GmshChoice& choice, std::vector<std::string>* left_out) {
  require_volume_format(path, mesh, choice);
  const std::string extension = format_of(path), source = source_format(mesh);
  const Format& format = *find_format(extension);
  if (extension == source) {
    if (choice.version || choice.encoding) return format.cells_in_version(mesh, choice, left_out);
    return with_mark(format.mark, mesh.source->with_points(mesh.points));
  }
  if (left_out != nullptr && !source.empty())
    left_out->push_back(
        fmt::format("what {} has beside nodes, elements and their regions", mesh.file));
  return format.cells_text(mesh, choice);
}

void write_volume_mesh(const std::string& path, const VolumeMesh& mesh, const GmshChoice& choice,
                       std::vector<std::string>* left_out,
                       const std::function<void(const VolumeMesh& written)>& verify) {
  write_file_atomically(
      path, volume_mesh_content(path, mesh, choice, left_out), [&](const std::string& temporary) {
        const VolumeMesh written = read_volume_mesh(temporary);
        if (written.points != mesh.points)
          throw Error(ErrorKind::Invalid, path + ": what would be written has other points");
        if (verify) verify(written);
      });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
