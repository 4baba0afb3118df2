// A job that makes quads of a surface, from the polygons of a mesh to its files and reports, as
// MapJob does for maps. Programs that only need the quads of a clean surface call quad_mesh().
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

// Returns the surface from which quads are made and by which they are judged. It is repaired as for
// unwrap(); moreover edges without length are collapsed, edges at equal places are joined, and
// solids that share an edge are separated and closed. Throws the errors of repair().
RepairedSurface surface_for_quads(const PolygonMesh& input, const StopCheck& stop = {});

// The state of the job. Fill it in this order: open(), `options`, solve().
struct QuadJob {
  // record: must outlive the job.
  explicit QuadJob(RunRecord& of_run) : record(of_run) {}

  // Repairs the surface by surface_for_quads(), within the limits of the run's start.
  void open(PolygonMesh input);
  // Makes the quads of every component, with its share of the count by area. Cones of the options
  // are vertices of the input; source: their origin, for messages. Throws the errors of
  // quad_mesh().
  void solve(const std::string& source = {});

  RunRecord& record;
  QuadMeshOptions options;
  Json options_json = Json::object();  // the given options, for reports

  PolygonMesh polygons;
  RepairedSurface surface;
  PolygonMesh quads;  // of all components
  // 3 #F flags of the covered features of the surface; the number of requested feature lines; the
  // relaxed ones, which include all lines shorter than a limit.
  std::vector<char> features;
  Index feature_lines = 0;
  std::vector<std::array<Index, 2>> relaxed;  // ends of lines: vertices of the input
  double shortest_feature = 0;
  std::vector<std::string> conflicts;  // of components, see QuadMesh
  QuadCheck check;
  long requested_count = 0;
  std::optional<long> least_count;  // see QuadMesh; of all components together
  Index patches = 0;
  int degree = 1;                                   // the highest of the components; see QuadMesh
  std::vector<Index> patch_of;                      // by quad, 0 to patches - 1
  std::vector<std::array<Index, 2>> feature_edges;  // edges of the quads that cover features
  std::vector<std::string> warnings;                // for a count that is not close to the request
  Status status = Status::Converged;  // of the maps, whose optimization a limit may have ended
  double read_seconds = 0;
  QuadSeconds seconds;  // of all components

 private:
  QuadMesh quads_of(const SurfacePiece& piece, std::size_t number, std::size_t components,
                    const QuadMeshOptions& of_piece);
};

// Returns the report, complete except for the seconds "write" and "total".
RunReport quad_report(const QuadJob& job);

// title: the subject of the picture.
QuadPicture picture_of(const QuadJob& job, const std::string& title);
// Writes .obj (v and f alone), .ply (binary, doubles) or .vtu. The .vtu has quads with patch_of as
// region (0 if that is empty), and irregular vertices as cells with their number of quads as
// region. Before the file gets its name its bytes are read back and judged by check_quads() with
// the surface and these features. Throws Error(Invalid) with the fault; Error(Usage) for other
// extensions and files that cannot be written.
void write_quads(const std::string& path, const PolygonMesh& quads, const SurfaceMesh& surface,
                 const std::vector<char>& features = {}, const std::vector<Index>& patch_of = {},
                 double border_turn = kCornerTurn);
// Returns whether a file of that name holds quads as cells, as .vtu does, which read_mesh() does
// not read.
bool has_quads_as_cells(const std::string& path);
// Reads any mesh of read_mesh(), and quads that are cells. Throws the errors of read_mesh(), and
// Error(Unsupported) for a .vtu of other cells.
PolygonMesh read_quads(const std::string& path, const StopCheck& stop = {},
                       Strictness strictness = Strictness::Shape);

// Returns features in the words of users: "none", degrees (sharp_edges() in features.h), or a file
// of edges (read_seams()). 3 #F flags of the surface; empty for none. Throws Error(Usage) for
// degrees beyond 180; the errors of read_seams() and flags_of_edges(); Stopped.
std::vector<char> features_of(const std::string& words, const PolygonMesh& polygons,
                              const RepairedSurface& surface, const StopCheck& stop = {});
// Returns the file that these words name, or an empty string.
std::string feature_file(const std::string& words);
// Returns features from pairs of vertices of the input. source: their origin, for messages.
std::vector<char> features_of(const std::vector<std::array<Index, 2>>& edges,
                              const std::string& source, const RepairedSurface& surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
