// The contents of a page (.html) besides the map: facts, held and pulled points, snapshots of the
// solve.
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

// Returns the file's name without its folder.
std::string page_title(const std::string& input);
// Returns a report for a page. It lacks outputs, iterations, and the folders of files in options
// and in `paths`.
std::string page_facts(const RunReport& report, const std::vector<std::string>& paths);
bool is_page(const std::string& path);
bool has_page(const std::vector<std::string>& paths);

// Returns the page of a job with a result, without its map and scaffold.
MapPage page_of(const MapJob& job, const MapRequest& request, const RunReport& report);
// Returns the page of a checked file: the verdict, its reasons, the cells that fail. inputs: the
// file itself, then the other files that were read.
MapPage checked_page(const MapFile& file, const MapCheck& check,
                     const std::vector<std::string>& inputs);
// Returns the pins and handles of a job, for pages and pictures.
std::vector<PagePoint> shown_points(const MapJob& job);
// Returns the handles with a target, by vertex of the input, in model units.
std::vector<PagePoint> pulled_points(const std::vector<Pin>& handles, const SurfaceMesh& mesh);

// Returns the pins that a file claims, of those vertices that it has.
std::vector<PagePoint> claimed_points(const Claims& claims, const MapFile& map);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
