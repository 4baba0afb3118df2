// The contents of a page (.html) besides the map: facts, points that were held or pulled, the maps
// on the way.
#pragma once

#include <string>
#include <vector>

#include "apps/map_request.h"
#include "majorant/apps/jobs/check_map.h"
#include "majorant/apps/jobs/map_job.h"
#include "majorant/apps/jobs/report.h"
#include "majorant/io/claims.h"
#include "majorant/pictures/pictures.h"

namespace majorant::app {

// The file's name, without its folder.
std::string page_title(const std::string& input);
// A report without what pages do not show: outputs, iterations step by step, and the folders of
// files: of options, and of these `paths`.
std::string page_facts(const RunReport& report, const std::vector<std::string>& paths);
bool is_page(const std::string& path);
bool has_page(const std::vector<std::string>& paths);

// The page of a job that has a result, but for its map and its scaffold.
MapPage page_of(const MapJob& job, const MapRequest& request, const RunReport& report);
// The page of a file as `check` finds it: the verdict, its reasons, the cells that fail. inputs:
// the file itself, then what else was read.
MapPage checked_page(const MapFile& file, const MapCheck& check,
                     const std::vector<std::string>& inputs);
// Pins and handles of a job, for pages and pictures.
std::vector<PagePoint> shown_points(const MapJob& job);
// Handles with a target, by vertex of the input, model units.
std::vector<PagePoint> pulled_points(const std::vector<Pin>& handles, const SurfaceMesh& mesh);

// The pins that a file claims, of vertices that it has.
std::vector<PagePoint> claimed_points(const Claims& claims, const MapFile& map);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
