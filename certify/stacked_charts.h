// Charts of a layout that lie exactly on others: congruent corner by corner, to the last digit.
//
//   const MapFile file = read_map("bolts.obj");
//   const StackedCharts stacks = find_stacks(file, "bolts.obj");
//   const MapFile turned = turned_back(file, stacks);    // mirrored charts at u < 0, positive
//
// A chart may lie on another one, as it is or mirrored. Both then show the same part of a texture.
// Only one chart of a stack is tested for overlaps, and proofs are about the layout in which
// mirrored charts are turned back.
//
// Charts with equal polygons, all positive, cover every point equally often, since a disk covers a
// point as often as its border winds around it. So if one chart of a stack is injective and
// disjoint from others, all are, whatever polygons the file names.
//
// Not for charts that lie on each other approximately, which overlap. Not for finding copies before
// there is a layout: stack_places() (parametrization/seams/congruent_surfaces.h) does that.
#pragma once

#include <string>
#include <vector>

#include "majorant/maps/map_file.h"

namespace majorant {

// Charts are separated by edges whose sides differ, or lie on each other like those of a fold.
// Vertices that the file holds several times, at equal places with equal uv, do not separate
// charts.
struct StackedCharts {
  std::vector<Index> chart;       // of every cell, numbered by their first cells
  std::vector<Index> stack;       // of every chart, from 0; -1: none
  std::vector<char> is_first;     // of every chart: true if it is in no stack, or the first of its
                                  // stack that is not mirrored
  std::vector<char> is_mirrored;  // of every chart: it is turned over
  Index stacks = 0, stacked = 0, mirrored = 0;  // counts; stacked: charts in stacks
};

// Returns the chart of every cell. Throws Error(Unreadable) for cells that form no surface.
std::vector<Index> charts_of_cells(const MapFile& file, const std::string& name);

// Finds the stacks: charts with the same polygons. Polygons are compared by the control points of
// their sides, in either order, and by whether the chart continues beyond a side. Polygons are
// those of input_face if their cells form a disk without inner vertices, else single cells. A chart
// with negative area is mirrored if another one of its stack has positive area. Throws
// Error(Unreadable) for cells that form no surface.
StackedCharts find_stacks(const MapFile& file, const std::string& name);

// Returns the layout with u negated in mirrored charts, which is exact. Their points are shared by
// no other charts.
MapFile turned_back(const MapFile& file, const StackedCharts& stacks);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
