// Where choose_cuts() cuts a mesh, and what that costs; the mesh cut open as OBJ, for `majorant
// parametrize`. Shapes of the table: one row a file.
//
// Sample runs:
//   build/release/bench/majorant_cuts_bench ../shared/data/public/closed/*.obj
//   build/release/bench/majorant_cuts_bench --max-stretch 1.06 --obj /tmp/cut spot.obj
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "majorant/framework/error.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/cuts/choose_cuts.h"

using namespace majorant;

int main(int argc, char** argv) {
  CutOptions options;
  std::string folder;
  fmt::print("{:<28}{:>8}{:>7}{:>7}{:>9}{:>9}{:>9}{:>8}\n", "file", "faces", "genus", "pieces",
             "length", "/sqrt(A)", "stretch", "s");
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--max-stretch") {
      options.max_stretch = std::stod(argv[++i]);
      continue;
    }
    if (word == "--obj") {
      folder = argv[++i];
      continue;
    }
    if (word == "--sharp") {
      options.method = CutMethod::Sharp;
      options.sharp_angle = std::stod(argv[++i]);
      continue;
    }
    if (word == "--uv") {
      options.method = CutMethod::Texture;
      continue;
    }
    if (word == "--given") {
      options.method = CutMethod::Given;
      const auto json = nlohmann::json::parse(std::ifstream(argv[++i]));
      options.edges = json.at("edges").get<std::vector<std::array<Index, 2>>>();
      continue;
    }
    try {
      const SurfaceMesh mesh = SurfaceMesh::from_polygons(read_mesh(word), {}, Components::Any);
      const auto start = std::chrono::steady_clock::now();
      const SurfaceCuts cuts = choose_cuts(mesh, options);
      const double seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      Index pieces = 0, genus = 0;
      double stretch = 0;
      for (const ComponentCuts& c : cuts.components)
        pieces += c.pieces, genus += c.genus, stretch = std::max(stretch, c.estimated_stretch);
      const std::string name = word.substr(word.rfind('/') + 1);
      fmt::print("{:<28}{:>8}{:>7}{:>7}{:>9.4g}{:>9.3f}{:>9.4f}{:>8.2f}\n", name, mesh.face_count(),
                 genus, pieces, cuts.length, cuts.length / std::sqrt(mesh.area()), stretch,
                 seconds);
      if (folder.empty()) continue;
      const SurfaceMesh cut = mesh.cut_along(cuts.is_cut, nullptr);
      std::ofstream file(folder + "/" + name.substr(0, name.rfind('.')) + ".obj");
      for (Index v = 0; v < cut.vertex_count(); ++v)
        file << fmt::format("v {} {} {}\n", cut.positions()(v, 0), cut.positions()(v, 1),
                            cut.positions()(v, 2));
      for (Index f = 0; f < cut.face_count(); ++f)
        file << fmt::format("f {} {} {}\n", cut.faces()(f, 0) + 1, cut.faces()(f, 1) + 1,
                            cut.faces()(f, 2) + 1);
    } catch (const Error& e) {
      fmt::print("{}: {}\n", word, e.what());
    }
  }
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
