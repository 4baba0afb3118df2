// The demo creature (creature_shape.h), meshed and cut open to a disk.
//
//   g++ -std=c++20 -O2 -I/usr/include/eigen3 generate_creature.cpp -o generate_creature -lgmp
//   -lmpfr
//   ./generate_creature creature.obj             # about 2000 faces
//   ./generate_creature creature_700.obj 700     # the same animal, coarser; 600 is the least
//
// How: (1) CGAL's Delaunay surface mesher samples the implicit surface; the edge length is adjusted
// until the face count fits. (2) A tree of shortest edge paths joins the tips of tail and ears
// along the back, and the surface is cut along it. The two sides of the cut have coincident but
// distinct vertices. The output depends on the arguments only: two runs write the same bytes.
//
// CGAL's Surface_mesher is GPL. This program is not part of the library and is not installed.
#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/IO/facets_in_complex_2_to_triangle_mesh.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/Surface_mesher/Standard_criteria.h>
#include <CGAL/make_surface_mesh.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "creature_shape.h"

namespace {

using creature::Vec;
using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
using Traits = Triangulation::Geom_traits;
using Point = Traits::Point_3;

struct Mesh {
  std::vector<Vec> vertices;
  std::vector<std::array<int, 3>> faces;  // counterclockwise seen from outside
};

// ---- 1. Meshing ---------------------------------------------------------------------------------

// The relative length of edges: 1 on the back, 0.4 at the face.
double relative_size(const Vec& p) { return 1.0 - 0.60 * creature::bump(p, {0, 1.47, 0.62}, 0.42); }

// A triangle is bad if its surface Delaunay ball is larger than the local size, or if its
// circumcentre is farther from the surface than a fraction of it.
class LocalSizeCriterion : public CGAL::Surface_mesher::Refine_criterion<Triangulation> {
 public:
  explicit LocalSizeCriterion(double size) : size_(size) {}

  bool is_bad(const Triangulation::Facet& facet, double& quality) const override {
    const auto [cell, opposite] = facet;
    const auto corner = [&](int i) { return cell->vertex((opposite + i) & 3)->point(); };
    const Point& centre = cell->get_facet_surface_center(opposite);
    const double size = size_ * relative_size({centre.x(), centre.y(), centre.z()});
    const double radius = std::sqrt(CGAL::squared_distance(centre, corner(1)));
    const Point flat = CGAL::circumcenter(corner(1), corner(2), corner(3));
    const double height = std::sqrt(CGAL::squared_distance(centre, flat));
    quality = 1.0 / std::max(radius / size, height / (0.13 * size));
    return quality < 1.0;
  }

 private:
  double size_;
};

// The point where the ray from an inner point leaves the animal.
Point exit_point(Vec inside, const Vec& direction) {
  Vec outside = inside;
  while (creature::field(outside) <= 0.0) outside += 0.02 * direction;
  for (int halving = 0; halving < 40; ++halving) {
    const Vec middle = 0.5 * (inside + outside);
    (creature::field(middle) <= 0.0 ? inside : outside) = middle;
  }
  return {inside.x(), inside.y(), inside.z()};
}

// The mesher numbers by memory address. Sorting makes the result the same in every run.
Mesh sorted_mesh(const CGAL::Surface_mesh<Point>& closed) {
  std::map<Point, int> number;
  for (const auto v : closed.vertices()) number[closed.point(v)];
  Mesh mesh;
  for (auto& [p, index] : number) {
    index = static_cast<int>(mesh.vertices.size());
    mesh.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  double volume = 0.0;
  for (const auto f : closed.faces()) {
    std::array<int, 3> face{};
    int i = 0;
    for (const auto v : closed.vertices_around_face(closed.halfedge(f))) {
      face[i++] = number[closed.point(v)];
    }
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    volume += mesh.vertices[face[0]].dot(mesh.vertices[face[1]].cross(mesh.vertices[face[2]]));
    mesh.faces.push_back(face);
  }
  std::sort(mesh.faces.begin(), mesh.faces.end());
  if (volume < 0.0) {
    for (auto& face : mesh.faces) std::swap(face[1], face[2]);
  }
  return mesh;
}

// A closed mesh of the animal: angles above 26 degrees, triangles of about `size`.
Mesh mesh_with_size(double size) {
  CGAL::get_default_random() = CGAL::Random(0);
  const auto value = [](const Point& p) { return creature::field({p.x(), p.y(), p.z()}); };
  using Surface = CGAL::Implicit_surface_3<Traits, decltype(value)>;
  const Surface surface(value, Traits::Sphere_3(Point(0.0, 0.6, 0.0), 9.0), 1e-6);
  using Criterion = CGAL::Surface_mesher::Refine_criterion<Triangulation>;
  CGAL::Surface_mesher::Aspect_ratio_criterion<Triangulation> shape(26.0);
  LocalSizeCriterion local_size(size);
  const CGAL::Surface_mesher::Standard_criteria<Criterion> criteria({&shape, &local_size});
  Triangulation triangulation;
  for (const Vec& landmark : creature::landmarks) {
    for (const Vec& axis : {Vec(1, 1, 1), Vec(1, -1, -1), Vec(-1, 1, -1), Vec(-1, -1, 1)}) {
      triangulation.insert(exit_point(landmark, axis.normalized()));
    }
  }
  CGAL::Complex_2_in_triangulation_3<Triangulation> complex(triangulation);
  CGAL::make_surface_mesh(complex, surface, criteria, CGAL::Manifold_tag(), 0);
  CGAL::Surface_mesh<Point> closed;
  CGAL::facets_in_complex_2_to_triangle_mesh(complex, closed);
  return sorted_mesh(closed);
}

// The face count grows about like 1 / size^2; a few corrections come within 3 % of the target.
Mesh mesh_with_faces(int target) {
  double size = 0.163 * std::sqrt(2000.0 / target);
  Mesh mesh;
  for (int attempt = 0; attempt < 20; ++attempt) {
    mesh = mesh_with_size(size);
    const double ratio = static_cast<double>(mesh.faces.size()) / target;
    if (std::abs(ratio - 1.0) < 0.03) break;
    size *= std::sqrt(ratio);
  }
  // There are 3 F / 2 edges: a closed surface of genus 0 has V = F / 2 + 2.
  if (mesh.vertices.size() != mesh.faces.size() / 2 + 2) {
    throw std::runtime_error("the mesh is not a sphere: ask for more faces");
  }
  return mesh;
}

// ---- 2. Cutting ---------------------------------------------------------------------------------

using Edge = std::pair<int, int>;

// Smaller vertex first.
Edge edge_between(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

using Graph = std::vector<std::vector<std::pair<int, double>>>;  // neighbours, edge lengths

Graph edge_graph(const Mesh& mesh) {
  Graph graph(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.faces) {
    for (const auto& [from, to] : {Edge(a, b), Edge(b, c), Edge(c, a)}) {
      graph[from].emplace_back(to, (mesh.vertices[from] - mesh.vertices[to]).norm());
    }
  }
  return graph;
}

// Shortest path from `goal` back to the nearest vertex of the tree, goal first.
std::vector<int> path_to_tree(const Graph& graph, const std::vector<int>& tree, int goal) {
  std::vector<double> distance(graph.size(), std::numeric_limits<double>::infinity());
  std::vector<int> parent(graph.size(), -1);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const int v : tree) {
    distance[v] = 0.0;
    queue.emplace(0.0, v);
  }
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > distance[v]) continue;
    for (const auto& [w, cost] : graph[v]) {
      if (d + cost >= distance[w]) continue;
      distance[w] = d + cost;
      parent[w] = v;
      queue.emplace(distance[w], w);
    }
  }
  std::vector<int> path;
  for (int v = goal; v >= 0; v = parent[v]) path.push_back(v);
  return path;
}

std::vector<Edge> cut_tree(const Mesh& mesh) {
  const auto graph = edge_graph(mesh);
  std::vector<int> tree;
  std::vector<Edge> edges;
  for (const Vec& point : creature::cut_points) {
    const auto nearest = std::min_element(
        mesh.vertices.begin(), mesh.vertices.end(),
        [&](const Vec& a, const Vec& b) { return (a - point).norm() < (b - point).norm(); });
    const int goal = static_cast<int>(nearest - mesh.vertices.begin());
    if (tree.empty()) tree.push_back(goal);
    const std::vector<int> path = path_to_tree(graph, tree, goal);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      edges.push_back(edge_between(path[i], path[i + 1]));
      tree.push_back(path[i]);
    }
  }
  return edges;
}

// A vertex of the cut mesh is a class of corners, joined across all edges that are not cut.
Mesh cut_open(const Mesh& mesh, std::vector<Edge> cut) {
  std::sort(cut.begin(), cut.end());
  std::vector<int> corner_class(3 * mesh.faces.size());
  std::iota(corner_class.begin(), corner_class.end(), 0);
  const auto root = [&](int c) {
    while (corner_class[c] != c) c = corner_class[c] = corner_class[corner_class[c]];
    return c;
  };
  std::map<Edge, std::pair<int, int>> first_side;  // corners at the smaller and the larger vertex
  for (int f = 0; f < static_cast<int>(mesh.faces.size()); ++f) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const Edge edge = edge_between(mesh.faces[f][i], mesh.faces[f][j]);
      if (std::binary_search(cut.begin(), cut.end(), edge)) continue;
      std::pair<int, int> corners(3 * f + i, 3 * f + j);
      if (mesh.faces[f][i] != edge.first) std::swap(corners.first, corners.second);
      const auto [other, is_first] = first_side.try_emplace(edge, corners);
      if (is_first) continue;
      corner_class[root(corners.first)] = root(other->second.first);
      corner_class[root(corners.second)] = root(other->second.second);
    }
  }
  Mesh disk;
  std::map<int, int> number;  // corner class -> vertex of the disk
  for (int f = 0; f < static_cast<int>(mesh.faces.size()); ++f) {
    auto& face = disk.faces.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto [entry, is_new] =
          number.try_emplace(root(3 * f + i), static_cast<int>(disk.vertices.size()));
      if (is_new) disk.vertices.push_back(mesh.vertices[mesh.faces[f][i]]);
      face[i] = entry->second;
    }
  }
  return disk;
}

void write_obj(const std::string& path, const Mesh& mesh) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) throw std::runtime_error("cannot write " + path);
  std::fprintf(file, "# majorant's creature, BSD-3-Clause, made by generate_creature.cpp\n");
  for (const Vec& v : mesh.vertices) std::fprintf(file, "v %.9g %.9g %.9g\n", v.x(), v.y(), v.z());
  for (const auto& [a, b, c] : mesh.faces) {
    std::fprintf(file, "f %d %d %d\n", a + 1, b + 1, c + 1);
  }
  if (std::fclose(file) != 0) throw std::runtime_error("cannot write " + path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: %s OUTPUT.obj [FACES=2000]\n", argv[0]);
    return 2;
  }
  try {
    const int target = argc > 2 ? std::atoi(argv[2]) : 2000;
    if (target < 600) throw std::runtime_error("FACES must be at least 600");
    const Mesh closed = mesh_with_faces(target);
    const std::vector<Edge> cut = cut_tree(closed);
    const Mesh disk = cut_open(closed, cut);
    write_obj(argv[1], disk);
    std::printf("%s: %zu vertices, %zu faces, %zu edges cut\n", argv[1], disk.vertices.size(),
                disk.faces.size(), cut.size());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
