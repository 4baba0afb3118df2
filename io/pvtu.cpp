#include "majorant/io/pvtu.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/formats.h"
#include "majorant/io/io.h"
#include "majorant/io/written_mark.h"
#include "majorant/io/xml_tree.h"
#include "majorant/maps/bezier_cell.h"
#include "majorant/maps/map_file.h"

namespace majorant {
namespace {

// Joins pieces of a map that meet in points of the same input vertices (pvtu.h).
//
//     const MapFile map = merged(pieces, names, "all.pvtu");

// The identity of a point on the whole surface: an input vertex, or the k-th point on the edge from
// the smaller vertex to the larger one.
using NodeName = std::array<Index, 3>;

class Merger {
 public:
  Merger(const std::vector<MapFile>& pieces, const std::vector<std::string>& names,
         const std::string& path)
      : pieces_(pieces), names_(names), path_(path), degree_(pieces.front().degree) {
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      if (pieces[p].degree != degree_)
        throw Error(ErrorKind::Unreadable, fmt::format("{}: its pieces have degrees {} and {}",
                                                       path, degree_, pieces[p].degree));
      if (pieces[p].input_vertex.size() == 0 || pieces[p].input_face.size() == 0)
        refuse(p, "has no input_vertex or no input_face");
      if (pieces[p].seam_edges.size() > 0 || pieces[p].cone.size() > 0)
        refuse(p, "is a piece of a map with seams");
      points_ += pieces[p].points.rows();
      cells_ += pieces[p].cells.rows();
    }
  }

  MapFile merge() {
    out_.degree = degree_;
    out_.points.resize(points_, 3);
    out_.uv.resize(points_, 2);
    out_.input_vertex.resize(points_);
    out_.cells.resize(cells_, bezier_cell_size(degree_));
    out_.input_face.resize(cells_);
    for (std::size_t p = 0; p < pieces_.size(); ++p) add(p);
    out_.points.conservativeResize(next_point_, Eigen::NoChange);
    out_.uv.conservativeResize(next_point_, Eigen::NoChange);
    out_.input_vertex.conservativeResize(next_point_);
    add_measures();
    order_cells();
    return std::move(out_);
  }

 private:
  [[noreturn]] void refuse(std::size_t piece, const std::string& what) const {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {} {}", path_, names_[piece], what));
  }

  void add(std::size_t p) {
    const MapFile& piece = pieces_[p];
    std::vector<Index> number(static_cast<std::size_t>(piece.points.rows()), -1);
    for (Index c = 0; c < piece.cells.rows(); ++c, ++next_cell_) {
      const auto cell = piece.cells.row(c);
      for (int edge = 0; edge < 3; ++edge) number_edge(p, cell, edge, number);
      for (Index k = 0; k < cell.size(); ++k) {
        Index& n = number[cell[k]];
        if (n < 0) n = new_point(piece, cell[k]);
        out_.cells(next_cell_, k) = n;
      }
      out_.input_face[next_cell_] = piece.input_face[c];
    }
    if (out_.claims.empty()) out_.claims = piece.claims;
    out_.warnings.insert(out_.warnings.end(), piece.warnings.begin(), piece.warnings.end());
  }

  template <class Cell>
  void number_edge(std::size_t p, const Cell& cell, int edge, std::vector<Index>& number) {
    const MapFile& piece = pieces_[p];
    std::vector<int> along = bezier_edge_points(degree_, edge);
    const auto vertex = [&](int local) { return piece.input_vertex[cell[local]]; };
    if (vertex(along.front()) < 0 || vertex(along.back()) < 0)
      refuse(p, "has corners that are no vertices of the input");
    if (vertex(along.front()) > vertex(along.back())) std::reverse(along.begin(), along.end());
    const Index a = vertex(along.front()), b = vertex(along.back());
    for (int k = 0; k <= degree_; ++k) {
      const Index point = cell[along[static_cast<std::size_t>(k)]];
      Index& n = number[point];
      if (n >= 0) continue;
      NodeName name{a, b, k};
      if (k == 0 || k == degree_) name = {k == 0 ? a : b, -1, 0};
      const auto [place, is_new] = named_.try_emplace(name, -1);
      if (is_new)
        place->second = new_point(piece, point);
      else
        require_same(p, point, place->second);
      n = place->second;
    }
  }

  Index new_point(const MapFile& piece, Index point) {
    out_.points.row(next_point_) = piece.points.row(point);
    out_.uv.row(next_point_) = piece.uv.row(point);
    out_.input_vertex[next_point_] = piece.input_vertex[point];
    return next_point_++;
  }

  void require_same(std::size_t p, Index point, Index known) const {
    const MapFile& piece = pieces_[p];
    if (std::memcmp(&piece.uv(point, 0), &out_.uv(known, 0), 2 * sizeof(double)) != 0 ||
        std::memcmp(&piece.points(point, 0), &out_.points(known, 0), 3 * sizeof(double)) != 0)
      refuse(p, fmt::format("has point {} elsewhere than the pieces before it", point));
  }

  void add_measures() {
    for (Vec MapFile::*values : {&MapFile::distortion, &MapFile::min_det}) {
      const bool all = std::all_of(pieces_.begin(), pieces_.end(), [&](const MapFile& piece) {
        return (piece.*values).size() == piece.cells.rows();
      });
      if (!all) continue;
      Vec& joined = out_.*values;
      joined.resize(cells_);
      Index next = 0;
      for (const MapFile& piece : pieces_) {
        joined.segment(next, piece.cells.rows()) = piece.*values;
        next += piece.cells.rows();
      }
    }
  }

  void order_cells() {
    std::vector<Index> order(to_size(cells_));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return out_.input_face[a] < out_.input_face[b]; });
    out_.cells = out_.cells(order, Eigen::all).eval();
    out_.input_face = out_.input_face(order).eval();
    for (Vec* values : {&out_.distortion, &out_.min_det})
      if (values->size() > 0) *values = (*values)(order).eval();
  }

  const std::vector<MapFile>& pieces_;
  const std::vector<std::string>& names_;
  const std::string& path_;
  const int degree_;
  Index points_ = 0, cells_ = 0, next_point_ = 0, next_cell_ = 0;
  std::map<NodeName, Index> named_;
  MapFile out_;
};

// pieces: at least one; names: of the pieces, for messages. Throws Error(Unreadable).
MapFile merged(const std::vector<MapFile>& pieces, const std::vector<std::string>& names,
               const std::string& path) {
  return Merger(pieces, names, path).merge();
}

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
      "<?xml version=\"1.0\"?>\n" + mark_text(MarkStyle::XmlComment) +
      "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PUnstructuredGrid GhostLevel=\"0\">\n";
  const auto array = [&](std::string_view type, std::string_view name, int components) {
    fmt::format_to(std::back_inserter(text),
                   "<PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", type, name,
                   components);
  };
  text += "<PPointData TCoords=\"uv\">\n";
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
