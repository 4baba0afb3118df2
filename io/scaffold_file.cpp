#include "majorant/io/scaffold_file.h"

#include <map>

#include "majorant/elements/bezier_triangle_space.h"

namespace majorant {

MapFile to_map_file(const BezierMesh& mesh) {
  std::map<Index, Index> number;  // vertices of the mesh -> 0, 1, ...
  for (const Index v : mesh.faces.reshaped()) number.emplace(v, 0);
  Index count = 0;
  for (auto& entry : number) entry.second = count++;
  Cells faces = mesh.faces;
  for (Index& v : faces.reshaped()) v = number.at(v);
  const LatticeNumbering nodes = number_lattice(faces, count, mesh.degree);
  MapFile file;
  file.degree = mesh.degree;
  file.cells = nodes.cells;
  file.points = Points3::Zero(nodes.node_count, 3);
  file.uv.resize(nodes.node_count, 2);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index l = 0; l < file.cells.cols(); ++l)
      file.uv.row(file.cells(f, l)) = mesh.point(f, static_cast<int>(l));
  file.points.leftCols<2>() = file.uv;
  return file;
}

}  // namespace majorant
