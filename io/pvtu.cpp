#include "majorant/io/pvtu.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "majorant/framework/error.h"
#include "majorant/io/input_file.h"
#include "majorant/io/internal/merge_pieces.h"
#include "majorant/io/internal/xml_tree.h"
#include "majorant/io/vtu.h"

namespace majorant {
namespace {

std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c == '&')
      text += "&amp;";
    else if (c == '<')
      text += "&lt;";
    else if (c == '"')
      text += "&quot;";
    else
      text += c;
  }
  return text;
}

}  // namespace

std::string pvtu_text(const MapFile& like, const std::vector<std::string>& pieces) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PUnstructuredGrid GhostLevel=\"0\">\n";
  const auto array = [&](std::string_view type, std::string_view name, int components) {
    fmt::format_to(std::back_inserter(text),
                   "<PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", type, name,
                   components);
  };
  text += "<PPointData>\n";
  array("Float64", "uv", 2);
  array("Int32", "input_vertex", 1);
  text += "</PPointData>\n<PCellData>\n";
  if (like.distortion.size() > 0) array("Float64", "distortion", 1);
  if (like.min_det.size() > 0) array("Float64", "min_det", 1);
  array("Int32", "input_face", 1);
  text += "</PCellData>\n<PPoints>\n";
  array("Float64", "Points", 3);
  text += "</PPoints>\n";
  for (const std::string& piece : pieces)
    fmt::format_to(std::back_inserter(text), "<Piece Source=\"{}\"/>\n", escaped(piece));
  text += "</PUnstructuredGrid>\n</VTKFile>\n";
  return text;
}

std::vector<std::string> pvtu_pieces(const std::string& path, const StopCheck& stop) {
  const std::string text = read_whole_file(path, stop);
  const XmlElement root = parse_xml(path, text);
  const XmlElement* grid = root.child("PUnstructuredGrid");
  if (root.name != "VTKFile" || !grid)
    throw Error(ErrorKind::Unreadable, path + ": no VTK file of type PUnstructuredGrid");
  std::vector<std::string> pieces;
  for (const XmlElement& piece : grid->children) {
    if (piece.name != "Piece") continue;
    const std::filesystem::path source(piece.attribute("Source"));
    if (source.is_absolute() || std::find(source.begin(), source.end(), "..") != source.end())
      throw Error(
          ErrorKind::Unreadable,
          fmt::format("{}: the piece {} is in another folder; pieces are beside their file, "
                      "or below",
                      path, in_quotes(source.string())));
    pieces.push_back(source.string());
  }
  if (pieces.empty()) throw Error(ErrorKind::Unreadable, path + ": it names no pieces");
  return pieces;
}

MapFile read_pvtu(const std::string& path, const StopCheck& stop) {
  std::vector<MapFile> pieces;
  std::vector<std::string> names;
  for (const std::string& source : pvtu_pieces(path, stop)) {
    stop.poll();
    names.push_back((std::filesystem::path(path).parent_path() / source).string());
    pieces.push_back(read_vtu(names.back(), stop));
  }
  return merged(pieces, names, path);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
