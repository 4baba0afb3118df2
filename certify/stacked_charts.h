// Charts of a layout that lie exactly on others: congruent corner by corner, by the digits.
//
//   const MapFile file = read_map("bolts.obj");
//   const StackedCharts stacks = find_stacks(file, "bolts.obj");
//   const MapFile turned = turned_back(file, stacks);    // mirrored charts at u < 0, positive
//
// A chart may lie on another one as it is, or mirrored, with its other side up: what is shown there
// is shown by both. Of charts that lie on each other one is looked at for overlaps, and all that
// holds of a layout is proven of the one in which mirrored charts are turned back.
//
// Charts of equal polygons, all positive, cover every point equally often: a disc does as often as
// its border winds around the point. That one chart covers none twice, nor one of another chart's,
// is true of all of its stack then, whatever polygons a file names.
//
// Not for charts that lie on each other nearly: these overlap. Not for finding copies before there
// is a layout: stack_places() (parametrization/seams/congruent_surfaces.h).
#pragma once

#include <string>
#include <vector>

#include "majorant/maps/map_file.h"

namespace majorant {

// Charts are pieces that edges divide whose sides differ, or lie on each other like those of a
// fold. Vertices that the file holds several times, at equal places and with equal uv, divide none.
struct StackedCharts {
  std::vector<Index> chart;       // of every cell, in the order of their first cells
  std::vector<Index> stack;       // of every chart, from 0; -1: on no other
  std::vector<char> is_first;     // of every chart: alone, or of its stack the first that is
                                  // not mirrored
  std::vector<char> is_mirrored;  // of every chart: has its other side up
  Index stacks = 0, stacked = 0, mirrored = 0;  // how many; stacked: charts in stacks
};

// The chart of every cell, as above. Throws Error(Unreadable) for cells that make no surface.
std::vector<Index> charts_of_cells(const MapFile& file, const std::string& name);

// Two charts are in one stack where they have the same polygons: control points of their sides, in
// their order or against it, and whether the chart goes on beyond a side. Polygons are those of
// input_face where their cells are a disc without a vertex inside, else single cells. Mirrored are
// charts whose area is negative, where another one's of the stack is positive. Throws
// Error(Unreadable) for cells that make no surface.
StackedCharts find_stacks(const MapFile& file, const std::string& name);

// u is negative in mirrored charts, which changes no digit. Their points are shared by no others.
MapFile turned_back(const MapFile& file, const StackedCharts& stacks);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
