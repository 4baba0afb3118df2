// A job that makes quads of a surface, from the polygons of a mesh to files and reports: what
// MapJob is for maps. Programs that only want the quads of a sound surface call quad_mesh().
//
//   QuadJob job(record);
//   job.open(read_mesh(path));
//   job.options.count = 4000;
//   job.solve();
//   write_quads("quads.obj", job.quads, *job.surface.mesh);
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "majorant/apps/jobs/report.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/repair.h"
#include "majorant/pictures/quad_picture.h"
#include "majorant/quads/quad_mesh.h"

namespace majorant {

// The surface that quads are made of, and judged by: repaired as unwrap() does, but edges without a
// length are collapsed, edges at equal places joined, and solids that share an edge apart, each
// closed. Throws as repair().
RepairedSurface surface_for_quads(const PolygonMesh& input, const StopCheck& stop = {});

// Filled in this order: open(), `options`, solve().
struct QuadJob {
  // record: outlives the job.
  explicit QuadJob(RunRecord& of_run) : record(of_run) {}

  // Repairs the surface: surface_for_quads(), at the limits of the run's start.
  void open(PolygonMesh input);
  // Every component by itself, with its share of the count by area. cones of the options: vertices
  // of the input; source: who names them, for messages. Throws as quad_mesh().
  void solve(const std::string& source = {});

  RunRecord& record;
  QuadMeshOptions options;
  Json options_json = Json::object();  // the options as given, for reports

  PolygonMesh polygons;
  RepairedSurface surface;
  PolygonMesh quads;  // of all components
  // 3 #F of the surface: features that are covered; how many lines of those asked for there are,
  // and how many of them were relaxed, shorter ones than this in any case.
  std::vector<char> features;
  Index feature_lines = 0;
  std::vector<std::array<Index, 2>> relaxed;  // their ends: vertices of the input
  double shortest_feature = 0;
  std::vector<std::string> conflicts;  // of components, as QuadMesh has it
  QuadCheck check;
  long requested_count = 0;
  std::optional<long> least_count;  // as QuadMesh has it, of all components together
  Index patches = 0;
  int degree = 1;                                   // the highest of the components' (QuadMesh)
  std::vector<Index> patch_of;                      // by quad, 0 to patches - 1
  std::vector<std::array<Index, 2>> feature_edges;  // of the quads, those that cover features
  std::vector<std::string> warnings;  // a count that is not close to the one asked for
  Status status = Status::Converged;  // of the maps: a limit may have ended their optimization
  double read_seconds = 0;
  QuadSeconds seconds;  // of all components

 private:
  QuadMesh quads_of(const SurfacePiece& piece, std::size_t number, std::size_t components,
                    const QuadMeshOptions& of_piece);
};

// Whole but for what writing adds to it: the seconds "write" and "total".
RunReport quad_report(const QuadJob& job);

// title: of what it is a picture.
QuadPicture picture_of(const QuadJob& job, const std::string& title);
// .obj (v and f alone), .ply (binary, doubles) or .vtu: quads, whose region is patch_of, 0 where
// that is empty, and the irregular vertices as cells, whose region is how many quads they have. The
// bytes are read back and judged by check_quads() with the surface and these features before the
// file takes its name: throws Error(Invalid) with what is wrong; Error(Usage) for other extensions
// and where it cannot be written.
void write_quads(const std::string& path, const PolygonMesh& quads, const SurfaceMesh& surface,
                 const std::vector<char>& features = {}, const std::vector<Index>& patch_of = {},
                 double border_turn = kCornerTurn);
// Returns whether quads are cells in a file of that name, as in .vtu, and no mesh of read_mesh().
bool has_quads_as_cells(const std::string& path);
// Any mesh as read_mesh() has it, and such cells. Throws as read_mesh(), and Error(Unsupported)
// for a .vtu of other cells.
PolygonMesh read_quads(const std::string& path, const StopCheck& stop = {},
                       Strictness strictness = Strictness::Shape);

// Features as users say them: "none", degrees (sharp_edges() in features.h), or a file of edges
// (read_seams()). 3 #F flags of the surface; none: an empty list. Throws Error(Usage) for degrees
// beyond 180; as read_seams() and flags_of_edges(); Stopped.
std::vector<char> features_of(const std::string& said, const PolygonMesh& polygons,
                              const RepairedSurface& surface, const StopCheck& stop = {});
// The file that such words name, or nothing.
std::string feature_file(const std::string& said);
// Of pairs of vertices of the input. source: of them, for messages.
std::vector<char> features_of(const std::vector<std::array<Index, 2>>& edges,
                              const std::string& source, const RepairedSurface& surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
