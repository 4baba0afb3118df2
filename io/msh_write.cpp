#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "majorant/io/atomic_file.h"
#include "majorant/io/formats.h"
#include "majorant/io/internal/msh_content.h"
#include "majorant/io/internal/text_pieces.h"
#include "majorant/io/io.h"
#include "majorant/io/lagrange_cell.h"
#include "majorant/io/map_check.h"
#include "majorant/io/written_mark.h"

namespace majorant {
namespace {

class MshText {
 public:
  MshText(const MapFile& map, const Points3& nodes) : map_(map), nodes_(nodes) {
    const auto chart_of = [&](Index cell) { return map.chart.size() == 0 ? 0 : map.chart[cell]; };
    std::vector<char> is_placed(to_size(static_cast<Index>(nodes.rows())), 0);
    for (Index c = 0; c < map.cells.rows(); ++c) {
      Chart& chart = charts_[chart_of(c)];
      chart.cells.push_back(c);
      for (const Index p : map.cells.row(c))
        if (!std::exchange(is_placed[p], 1)) chart.nodes.push_back(p);
    }
    for (std::size_t p = 0; p < is_placed.size(); ++p)  // those of no cell
      if (!is_placed[p]) charts_.begin()->second.nodes.push_back(static_cast<Index>(p));
  }

  void add_mesh() {
    text_.add("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + mark_text(MarkStyle::GmshSection));
    add_groups();
    add_entities();
    add("$Nodes\n{} {} 1 {}\n", charts_.size(), nodes_.rows(), nodes_.rows());
    for (const auto& [number, chart] : charts_) {
      add("2 {} 0 {}\n", long{number} + 1, chart.nodes.size());
      const auto count = static_cast<Index>(chart.nodes.size());
      text_.add_lines(count, [&nodes = chart.nodes](Index k, fmt::appender out) {
        fmt::format_to(out, FMT_COMPILE("{}\n"), nodes[k] + 1);
      });
      text_.add_lines(count, [&, &nodes = chart.nodes](Index k, fmt::appender out) {
        const auto node = nodes_.row(nodes[k]);
        fmt::format_to(out, FMT_COMPILE("{} {} {}\n"), node[0], node[1], node[2]);
      });
    }
    const Index count = static_cast<Index>(map_.cells.rows());
    add("$EndNodes\n$Elements\n{} {} 1 {}\n", charts_.size(), count, count);
    for (const auto& [number, chart] : charts_) {
      add("2 {} {} {}\n", long{number} + 1, kMshTriangles[map_.degree - 1].first,
          chart.cells.size());
      text_.add_lines(static_cast<Index>(chart.cells.size()),
                      [&, &cells = chart.cells](Index k, fmt::appender out) {
                        fmt::format_to(out, FMT_COMPILE("{}"), cells[k] + 1);
                        for (const Index p : map_.cells.row(cells[k]))
                          fmt::format_to(out, FMT_COMPILE(" {}"), p + 1);
                        *out++ = '\n';
                      });
    }
    text_.add("$EndElements\n");
  }

  // One number per node, shown by gmsh as colours and lines of equal value.
  template <class Values>
  void add_view(char name, const Values& values) {
    add("$NodeData\n1\n\"{}\"\n1\n0\n3\n0\n1\n{}\n", name, values.size());
    text_.add_lines(static_cast<Index>(values.size()), [&](Index p, fmt::appender out) {
      fmt::format_to(out, FMT_COMPILE("{} {}\n"), p + 1, values[p]);
    });
    text_.add("$EndNodeData\n");
  }

  // Adds the input numbers of nodes or elements.
  void add_input_numbers(std::string_view name, const Eigen::VectorXi& numbers) {
    if (numbers.size() == 0) return;
    add("${}\n{}\n", name, numbers.size());
    text_.add_lines(static_cast<Index>(numbers.size()), [&](Index k, fmt::appender out) {
      fmt::format_to(out, FMT_COMPILE("{} {}\n"), k + 1, numbers[k]);
    });
    add("$End{}\n", name);
  }

  std::string take() { return text_.take(); }

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    text_.add(fmt::format(format, std::forward<Args>(args)...));
  }

  // A name for every chart of an atlas.
  void add_groups() {
    if (map_.chart.size() == 0) return;
    add("$PhysicalNames\n{}\n", charts_.size());
    for (const auto& entry : charts_)
      add("2 {0} \"chart {1}\"\n", long{entry.first} + 1, entry.first);
    text_.add("$EndPhysicalNames\n");
  }

  // Surfaces with their boxes, in the groups of their charts, no boundary.
  void add_entities() {
    add("$Entities\n0 0 {} 0\n", charts_.size());
    for (const auto& [number, chart] : charts_) {
      const Cells cells = map_.cells(chart.cells, Eigen::all);
      const Points3 here = nodes_(cells.reshaped(), Eigen::all);
      const Eigen::RowVector3d low = here.colwise().minCoeff(), high = here.colwise().maxCoeff();
      const std::string group =
          map_.chart.size() == 0 ? "0" : fmt::format("1 {}", long{number} + 1);
      add("{} {} {} {} 0\n", long{number} + 1, fmt::join(low, " "), fmt::join(high, " "), group);
    }
    text_.add("$EndEntities\n");
  }

  struct Chart {
    std::vector<Index> cells, nodes;
  };

  const MapFile& map_;
  const Points3& nodes_;
  std::map<Index, Chart> charts_;
  TextPieces text_;
};

}  // namespace

void write_msh(const std::string& path, const MapFile& map, MshContent content,
               const FileVerification& verify) {
  require_sound(path, map);
  if (content == MshContent::Surface) require_complete(path, map);
  require_lagrange_degree(path, map);
  const Points2 uv = lagrange_nodes(map);
  Points3 nodes = map.points;  // of flat triangles control points are values, too
  if (content == MshContent::Image) nodes << uv, Vec::Zero(uv.rows());
  MshText text(map, nodes);
  text.add_mesh();
  if (content == MshContent::Surface) {
    text.add_view('u', uv.col(0));
    text.add_view('v', uv.col(1));
    text.add_input_numbers(kMshInputVertex, map.input_vertex);
    text.add_input_numbers(kMshInputFace, map.input_face);
  }
  write_file_atomically(path, text.take(), verify);
}

}  // namespace majorant

// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the majorant developers
