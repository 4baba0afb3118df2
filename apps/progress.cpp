#include "apps/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace majorant::app {
namespace {

std::atomic<bool> interrupted{false};

extern "C" void note_interruption(int) { interrupted.store(true); }

std::string line(const TraceEntry& e) {
  return fmt::format("degree {}  iteration {:3}  energy {:.8g}  decrease {:.1e}  step {:.2g}",
                     e.degree, e.record.iteration, e.record.energy, e.record.relative_decrease,
                     e.record.step);
}

}  // namespace

RunRecord::Progress make_progress(const CommonOptions& options) {
  if (options.quiet) return {};
  if (options.verbose) return [](const TraceEntry& e) { fmt::print(stderr, "{}\n", line(e)); };
  if (isatty(STDERR_FILENO))
    return [](const TraceEntry& e) { fmt::print(stderr, "\r\x1b[K{}", line(e)); };
  return [degree = 0](const TraceEntry& e) mutable {
    if (e.degree != degree || e.record.iteration % 10 == 0) fmt::print(stderr, "{}\n", line(e));
    degree = e.degree;
  };
}

void finish_progress(const CommonOptions& options) {
  if (!options.quiet && !options.verbose && isatty(STDERR_FILENO)) fmt::print(stderr, "\r\x1b[K");
}

const std::atomic<bool>* interruption_flag() {
  std::signal(SIGINT, note_interruption);
  std::signal(SIGTERM, note_interruption);
  return &interrupted;
}

}  // namespace majorant::app
