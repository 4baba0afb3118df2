#include "apps/progress.h"

#include <unistd.h>

#include <string>

#include "apps/streams.h"

namespace majorant::app {
namespace {

std::string line(const TraceEntry& e) {
  const std::string phase =
      e.phase == Phase::Newton ? "" : fmt::format("  ({})", phase_name(e.phase));
  const std::string level = e.level == 0 ? "" : fmt::format("  (level {})", e.level);
  return fmt::format("degree {}  iteration {:3}  energy {:.8g}  decrease {:.1e}  step {:.2g}{}{}",
                     e.degree, e.record.iteration, e.energy, e.record.relative_decrease,
                     e.record.step, phase, level);
}

}  // namespace

RunRecord::Progress make_progress(const CommonOptions& options) {
  if (options.quiet) return {};
  if (options.verbose) return [](const TraceEntry& e) { say("{}\n", line(e)); };
  if (isatty(STDERR_FILENO)) return [](const TraceEntry& e) { say("\r\x1b[K{}", line(e)); };
  return [degree = 0](const TraceEntry& e) mutable {
    if (e.degree != degree || e.record.iteration % 10 == 0) say("{}\n", line(e));
    degree = e.degree;
  };
}

void finish_progress(const CommonOptions& options) {
  if (!options.quiet && !options.verbose && isatty(STDERR_FILENO)) say("\r\x1b[K");
}

}  // namespace majorant::app
