// Progress on stderr: one live line on a terminal, plain lines otherwise.
#pragma once

#include "apps/command.h"
#include "majorant/framework/run_record.h"

namespace majorant::app {

// Nothing when quiet; every iteration when verbose; else on a terminal one live line, elsewhere a
// line per degree and every tenth iteration.
RunRecord::Progress make_progress(const CommonOptions& options);
// Ends the live line.
void finish_progress(const CommonOptions& options);

}  // namespace majorant::app
