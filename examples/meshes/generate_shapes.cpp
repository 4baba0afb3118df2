// Small test surfaces: topological disks of a few hundred triangles, and a closed one of genus 1.
// Standard library only.
//
//   g++ -std=c++20 -O2 -Wall -Wextra generate_shapes.cpp -o generate_shapes
//   ./generate_shapes .       # writes wavy_disk, cap, ribbon, tube, buckle, helix and bar.obj, bar.json
//
// What: wavy_disk  a bumpy height field over a noisy triangular grid: mild distortion, the easy
// case
//       cap        a sphere with a small round opening: strong shrinking away from the boundary
//       ribbon     two turns of a helicoid: long, thin, negatively curved, two long boundary sides
//       tube       a crinkled L-shaped sheet; a tube with a closed end grows out of its long leg:
//                  the map has to flatten the whole tube around the interior of the sheet
//       buckle     a closed rounded square ring with waves: corners and a handle, for seamless maps
//       helix      a ramp of 2.2 turns: almost flat, and laid flat it lies on itself
//       bar        a flat bar; bar.json holds its left end and turns the right one over
// How: every disk is a planar triangulation whose vertices are then moved into space; the buckle is
// the surface of small cubes, smoothed. Noise comes from a linear congruential generator of fixed
// seed: the output is the same on every machine up to the last digits of sin and cos.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr double pi = std::numbers::pi;

struct Point {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

struct Mesh {
  std::vector<Point> vertices;
  std::vector<std::array<int, 3>> faces;
};

// Knuth's MMIX generator; uniform numbers in [-1, 1).
class Noise {
 public:
  double next() {
    state_ = 6364136223846793005u * state_ + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) / static_cast<double>(1ull << 52) - 1.0;
  }

 private:
  std::uint64_t state_ = 2026;
};

// Concentric rings around one centre vertex: ring k of `rings` has 6 k vertices, in the unit disk.
Mesh hexagonal_disk(int rings) {
  Mesh mesh;
  mesh.vertices.push_back({});
  std::vector<int> first = {0};  // first vertex of each ring
  for (int k = 1; k <= rings; ++k) {
    first.push_back(static_cast<int>(mesh.vertices.size()));
    for (int i = 0; i < 6 * k; ++i) {
      const double angle = 2.0 * pi * i / (6 * k);
      const double radius = static_cast<double>(k) / rings;
      mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
    }
  }
  const auto vertex = [&](int ring, int i) { return ring == 0 ? 0 : first[ring] + i % (6 * ring); };
  for (int k = 1; k <= rings; ++k) {
    for (int sector = 0; sector < 6; ++sector) {
      for (int i = 0; i < k; ++i) {
        const int outer = sector * k + i;
        const int inner = sector * (k - 1) + i;
        mesh.faces.push_back({vertex(k, outer), vertex(k, outer + 1), vertex(k - 1, inner)});
        if (i + 1 < k) {
          mesh.faces.push_back(
              {vertex(k, outer + 1), vertex(k - 1, inner + 1), vertex(k - 1, inner)});
        }
      }
    }
  }
  return mesh;
}

// The cells of a grid of nx by ny squares for which keep(i, j) holds, cut in two along alternating
// diagonals. Vertices have integer coordinates.
Mesh square_grid(int nx, int ny, const std::function<bool(int, int)>& keep) {
  Mesh mesh;
  std::map<std::pair<int, int>, int> number;
  const auto vertex = [&](int i, int j) {
    const auto [entry, is_new] = number.try_emplace({i, j}, static_cast<int>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back({static_cast<double>(i), static_cast<double>(j), 0.0});
    return entry->second;
  };
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      if (!keep(i, j)) continue;
      const int a = vertex(i, j);
      const int b = vertex(i + 1, j);
      const int c = vertex(i + 1, j + 1);
      const int d = vertex(i, j + 1);
      if ((i + j) % 2 == 0) {
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({a, c, d});
      } else {
        mesh.faces.push_back({a, b, d});
        mesh.faces.push_back({b, c, d});
      }
    }
  }
  return mesh;
}

Mesh wavy_disk() {
  constexpr int rings = 9;
  Mesh mesh = hexagonal_disk(rings);
  Noise noise;
  for (Point& p : mesh.vertices) {
    if (std::hypot(p.x, p.y) < 0.99) {
      p.x += 0.20 / rings * noise.next();
      p.y += 0.20 / rings * noise.next();
    }
    p.z = 0.22 * std::sin(5.0 * p.x + 0.4) * std::cos(4.0 * p.y) + 0.15 * p.x * p.y;
  }
  return mesh;
}

// The rings of the disk become parallels; the opening is 35 degrees around the south pole.
Mesh cap() {
  Mesh mesh = hexagonal_disk(9);
  for (Point& p : mesh.vertices) {
    const double radius = std::hypot(p.x, p.y);
    if (radius == 0.0) {
      p.z = 1.0;
      continue;
    }
    // Rings get narrower towards the opening, where the parallels shorten and triangles shrink.
    const double colatitude = 145.0 / 180.0 * pi * radius * (1.18 - 0.18 * radius);
    const double scale = std::sin(colatitude) / radius;
    p = {scale * p.x, scale * p.y, std::cos(colatitude)};
  }
  return mesh;
}

Mesh ribbon() {
  constexpr int length = 48;
  constexpr int width = 4;
  Mesh mesh = square_grid(length, width, [](int, int) { return true; });
  for (Point& p : mesh.vertices) {
    const double angle = 4.0 * pi * p.x / length;
    const double radius = 1.0 - 0.65 * p.y / width;
    p = {radius * std::cos(angle), radius * std::sin(angle), 0.25 * angle};
  }
  return mesh;
}

// A 12 by 12 sheet without its upper right quarter, crinkled. Four cells of the grid are removed,
// and a tube of `floors` floors with 8 sides stands on the hole; one vertex closes it on top.
Mesh tube() {
  constexpr int sides = 8;
  constexpr int floors = 9;
  constexpr double middle = 3.0;
  Mesh mesh = square_grid(12, 12, [](int i, int j) {
    const bool is_hole = (i == 2 || i == 3) && (j == 2 || j == 3);
    return (i < 6 || j < 6) && !is_hole;
  });
  const std::array<std::array<int, 2>, sides> rim = {
      {{4, 3}, {4, 4}, {3, 4}, {2, 4}, {2, 3}, {2, 2}, {3, 2}, {4, 2}}};
  std::vector<int> below(sides);
  Noise noise;
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    Point& p = mesh.vertices[v];
    bool is_rim = false;
    for (int s = 0; s < sides; ++s) {
      if (p.x != rim[s][0] || p.y != rim[s][1]) continue;
      below[s] = v;
      is_rim = true;
    }
    if (!is_rim) p.z = 0.35 * std::sin(1.1 * p.x + 0.7 * p.y) + 0.12 * noise.next();
  }
  for (int floor = 1; floor <= floors; ++floor) {
    std::vector<int> above(sides);
    for (int s = 0; s < sides; ++s) {
      const double angle = 2.0 * pi * s / sides;
      const double lean = 0.012 * floor * floor;  // the tube bends towards +x
      above[s] = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(
          {middle + 1.05 * std::cos(angle) + lean, middle + 1.05 * std::sin(angle), 0.8 * floor});
    }
    for (int s = 0; s < sides; ++s) {
      const int t = (s + 1) % sides;
      mesh.faces.push_back({below[s], below[t], above[t]});
      mesh.faces.push_back({below[s], above[t], above[s]});
    }
    below = above;
  }
  const int top = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back({middle + 0.012 * floors * floors, middle, 0.8 * floors + 0.5});
  for (int s = 0; s < sides; ++s) mesh.faces.push_back({below[s], below[(s + 1) % sides], top});
  return mesh;
}

// The surface of 3 by 3 blocks without the middle one, each of 6^3 cubes, squares cut in two.
Mesh square_ring() {
  constexpr int block = 6;
  const auto is_full = [](std::array<int, 3> c) {
    for (const int x : c)
      if (x < 0) return false;
    c = {c[0] / block, c[1] / block, c[2] / block};
    return c[0] < 3 && c[1] < 3 && c[2] < 1 && !(c[0] == 1 && c[1] == 1);
  };
  Mesh mesh;
  std::map<std::array<int, 3>, int> number;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [entry, is_new] = number.try_emplace(p, static_cast<int>(mesh.vertices.size()));
    if (is_new)
      mesh.vertices.push_back(
          {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    return entry->second;
  };
  const auto add_square = [&](const std::array<int, 3>& cube, int axis, int side) {
    std::array<int, 4> corner = {};
    for (int k = 0; k < 4; ++k) {  // counterclockwise, seen from outside
      std::array<int, 3> p = cube;
      const int s = k == 1 || k == 2, t = k >= 2;
      p[axis] += side;
      p[(axis + 1) % 3] += side ? s : t;
      p[(axis + 2) % 3] += side ? t : s;
      corner[k] = vertex(p);
    }
    const int first = (cube[0] + cube[1] + cube[2]) % 2;  // alternating diagonals
    for (const int k : {1, 2})
      mesh.faces.push_back({corner[first], corner[(first + k) % 4], corner[(first + k + 1) % 4]});
  };
  for (int x = 0; x < 3 * block; ++x)
    for (int y = 0; y < 3 * block; ++y)
      for (int z = 0; z < block; ++z)
        for (int axis = 0; axis < 3; ++axis)
          for (const int side : {0, 1}) {
            std::array<int, 3> beyond = {x, y, z};
            beyond[axis] += 2 * side - 1;
            if (is_full({x, y, z}) && !is_full(beyond)) add_square({x, y, z}, axis, side);
          }
  return mesh;
}

Mesh buckle() {
  Mesh mesh = square_ring();
  for (int round = 0; round < 2; ++round) {  // every vertex to the mean of its neighbours
    std::vector<Point> sum(mesh.vertices.size());
    std::vector<int> count(mesh.vertices.size());
    for (const auto& face : mesh.faces)
      for (int k = 0; k < 3; ++k) {
        const Point& p = mesh.vertices[face[(k + 1) % 3]];
        Point& s = sum[face[k]];
        s = {s.x + p.x, s.y + p.y, s.z + p.z};
        ++count[face[k]];
      }
    for (std::size_t v = 0; v < sum.size(); ++v)
      mesh.vertices[v] = {sum[v].x / count[v], sum[v].y / count[v], sum[v].z / count[v]};
  }
  for (Point& p : mesh.vertices) p.z += 0.7 * std::sin(0.5 * p.x) * std::cos(0.4 * p.y);
  return mesh;
}

Mesh helix() {
  constexpr int length = 60;
  constexpr int width = 4;
  constexpr double turns = 2.2;
  constexpr double rise = 0.5;  // of a turn
  Mesh mesh = square_grid(length, width, [](int, int) { return true; });
  for (Point& p : mesh.vertices) {
    const double turn = turns * p.x / length;
    const double radius = 2.0 - p.y / width;
    p = {radius * std::cos(2.0 * pi * turn), radius * std::sin(2.0 * pi * turn), rise * turn};
  }
  return mesh;
}

constexpr double bar_length = 4.0;
constexpr double bar_width = 0.5;

Mesh bar() {
  constexpr double cell = 0.125;
  constexpr int nx = static_cast<int>(bar_length / cell);
  constexpr int ny = static_cast<int>(bar_width / cell);
  Mesh mesh = square_grid(nx, ny, [](int, int) { return true; });
  for (Point& p : mesh.vertices) p = {cell * p.x, cell * p.y, 0.0};
  return mesh;
}

// The left end stays; the right one is turned by 180 degrees, its middle goes to (1, 1.9).
void write_bar_handles(const std::string& path) {
  const Mesh mesh = bar();
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) throw std::runtime_error("cannot write " + path);
  std::fprintf(file, "{\"handles\": [\n");
  const char* separator = "";
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Point& p = mesh.vertices[v];
    if (p.x == 0.0) {
      std::fprintf(file, "%s {\"vertex\": %zu, \"target\": \"initial\"}", separator, v);
    } else if (p.x == bar_length) {
      const double up = p.y - bar_width / 2;
      std::fprintf(file, "%s {\"vertex\": %zu, \"target\": [%.6f, %.6f]}", separator, v, 1.0,
                   1.9 - up);
    } else {
      continue;
    }
    separator = ",\n";
  }
  std::fprintf(file, "\n]}\n");
  if (std::fclose(file) != 0) throw std::runtime_error("cannot write " + path);
}

void write_obj(const std::string& path, const Mesh& mesh) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) throw std::runtime_error("cannot write " + path);
  std::fprintf(file,
               "# majorant test mesh, BSD-3-Clause, made by examples/meshes/generate_shapes.cpp\n");
  for (const Point& p : mesh.vertices) std::fprintf(file, "v %.9g %.9g %.9g\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.faces) {
    std::fprintf(file, "f %d %d %d\n", a + 1, b + 1, c + 1);
  }
  if (std::fclose(file) != 0) throw std::runtime_error("cannot write " + path);
  std::printf("%s: %zu vertices, %zu faces\n", path.c_str(), mesh.vertices.size(),
              mesh.faces.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  try {
    const std::string folder = std::string(argv[1]) + "/";
    write_obj(folder + "wavy_disk.obj", wavy_disk());
    write_obj(folder + "cap.obj", cap());
    write_obj(folder + "ribbon.obj", ribbon());
    write_obj(folder + "tube.obj", tube());
    write_obj(folder + "buckle.obj", buckle());
    write_obj(folder + "helix.obj", helix());
    write_obj(folder + "bar.obj", bar());
    write_bar_handles(folder + "bar.json");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
