#include "majorant/parametrization/seams/internal/pieces.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/cut_graph.h"
#include "majorant/mesh/cut_shortening.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {
namespace {

// The parts of a cut that can be removed one by one while its pieces stay planar.
//
//   std::vector<char> opened = planar_cut(*mesh, edge_lengths(*mesh));
//   const std::vector<char> no_terminal(mesh->vertex_count(), 0);
//   for (const CutChain& chain : cut_chains(*mesh, opened, no_terminal))
//     set_cut(*mesh, chain, 0, opened);   // closed again
//
// Closing a cut along a chain joins two boundary loops, or splits one in two. The first makes a
// handle if the loops belong to one piece, the second never does.

// A maximal path of cut edges between nodes, or a closed path without nodes. Nodes are terminals,
// vertices of the boundary, and vertices where one cut edge ends or three or more meet.
struct CutChain {
  std::vector<Index> half_edges;  // one after the other
};

// Returns the chains in the order of their smallest half-edges. is_cut: 3 #F flags, both sides of
// an edge or none; is_terminal: #V.
std::vector<CutChain> cut_chains(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                                 const std::vector<char>& is_terminal) {
  std::vector<std::vector<Index>> leaving(to_size(mesh.vertex_count()));
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_cut[h]) leaving[mesh.from_vertex(h)].push_back(h);
  const std::vector<char> is_boundary = mesh.boundary_flags();
  const auto is_node = [&](Index v) {
    return is_terminal[v] || is_boundary[v] || leaving[v].size() != 2;
  };
  std::vector<char> seen(is_cut.size(), 0);
  std::vector<CutChain> chains;
  const auto follow = [&](Index h) {
    CutChain chain;
    for (;;) {
      chain.half_edges.push_back(h);
      seen[h] = seen[mesh.opposite(h)] = 1;
      const Index v = mesh.to_vertex(h);
      if (is_node(v)) break;
      h = leaving[v][leaving[v][0] == mesh.opposite(h) ? 1 : 0];
      if (seen[h]) break;
    }
    chains.push_back(std::move(chain));
  };
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_cut[h] && !seen[h] && is_node(mesh.from_vertex(h))) follow(h);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_cut[h] && !seen[h]) follow(h);
  return chains;
}

void set_cut(const SurfaceMesh& mesh, const CutChain& chain, char value,
             std::vector<char>& is_cut) {
  for (const Index h : chain.half_edges) is_cut[h] = is_cut[mesh.opposite(h)] = value;
}

// Returns for every half-edge on the boundary of the cut surface (cut, or without an opposite) the
// number of its loop there, -1 for the others. Loops are numbered in the order of their smallest
// half-edges.
std::vector<Index> boundary_loops_of_cut(const SurfaceMesh& mesh, const std::vector<char>& is_cut) {
  std::vector<Index> opposite = mesh.opposites();
  for (std::size_t h = 0; h < opposite.size(); ++h)
    if (is_cut[h]) opposite[h] = -1;
  std::vector<Index> loop(opposite.size(), -1);
  Index count = 0;
  for (const std::vector<Index>& half_edges : border_loops<3>(opposite)) {
    for (const Index h : half_edges) loop[h] = count;
    ++count;
  }
  return loop;
}

// Returns flags of cuts of a connected surface whose pieces are disks with holes; none for a
// surface that is planar already. A closed surface is cut along at least two edges, a handle along
// one loop. Computes cut_graph and closes its most expensive chains again.
std::vector<char> planar_cut(const SurfaceMesh& mesh, const Vec& edge_cost, const StopCheck& stop) {
  const Topology& t = mesh.topology();
  std::vector<char> is_cut(to_size(mesh.half_edge_count()), 0);
  if (is_planar(mesh)) return is_cut;
  is_cut = cut_graph(mesh, {}, edge_cost, stop);
  if (t.boundary_loops == 0 && t.euler_characteristic() == 2) return is_cut;
  const std::vector<char> no_terminal(to_size(mesh.vertex_count()), 0);
  // Closing a chain joins its neighbours into one, so the list is computed anew each time.
  for (bool any = true; any;) {
    any = false;
    std::vector<std::pair<double, CutChain>> chains;  // minus the cost: the most expensive first
    for (CutChain& chain : cut_chains(mesh, is_cut, no_terminal)) {
      double cost = 0;
      for (const Index h : chain.half_edges) cost += edge_cost[h];
      chains.emplace_back(-cost, std::move(chain));
    }
    std::stable_sort(chains.begin(), chains.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    const std::vector<Index> loops = boundary_loops_of_cut(mesh, is_cut);
    for (const auto& [cost, chain] : chains) {
      stop.poll();
      const Index h = chain.half_edges.front();
      if (loops[h] != loops[mesh.opposite(h)]) continue;
      set_cut(mesh, chain, 0, is_cut);
      any = true;
      break;
    }
  }
  prune_cut(mesh, no_terminal, is_cut);
  return is_cut;
}

}  // namespace

std::vector<std::vector<Index>> component_faces(const std::vector<Index>& opposites) {
  const std::vector<Index> component = face_components(opposites);
  std::vector<std::vector<Index>> faces;
  for (std::size_t f = 0; f < component.size(); ++f) {
    if (to_size(component[f]) >= faces.size()) faces.resize(to_size(component[f]) + 1);
    faces[component[f]].push_back(static_cast<Index>(f));
  }
  return faces;
}

void open_pieces(const SurfaceMesh& mesh, const Vec& edge_cost, std::vector<char>& is_cut,
                 const StopCheck& stop) {
  for (const auto& [part, faces, vertices] : mesh.cut_along(is_cut, nullptr).split(stop)) {
    stop.poll();
    const SurfaceMesh& piece = *part;
    if (is_planar(piece)) continue;
    Vec cost(piece.half_edge_count());
    for (Index h = 0; h < cost.size(); ++h)
      cost[h] = edge_cost[3 * faces[face_of(h)] + corner_of(h)];
    const std::vector<char> more = planar_cut(piece, cost, stop);
    for (Index h = 0; h < cost.size(); ++h)
      if (more[h]) is_cut[3 * faces[face_of(h)] + corner_of(h)] = 1;
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
