#include "apps/linear_solvers.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>

#include "apps/arguments/suggestion.h"
#include "apps/streams.h"
#include "majorant/framework/error.h"
#include "majorant/results/internal/machine_memory.h"

namespace majorant::app {
namespace {

// Beside the program in a build tree, and where `make install` puts it.
std::vector<std::string> plugin_folders() {
  std::error_code unknown;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
  return {folder.string(), (folder / MAJORANT_PLUGINS_FROM_PROGRAM).lexically_normal().string()};
}

std::size_t process_bytes() {
  std::size_t pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

std::string gigabytes(std::size_t bytes) {
  return fmt::format("{:.3g} GB", static_cast<double>(bytes) / 1e9);
}

}  // namespace

void add_linear_solver_to(CLI::App& verb, std::string& name) {
  verb.add_option("--linear-solver", name,
                  "auto: direct, where its factor fits into memory; direct; with PETSc mumps, or "
                  "cg-hypre, which takes least memory")
      ->check(one_of({"auto", "direct", "mumps", "cg-hypre", "cholmod"}));
}

LinearSolvers::LinearSolvers(std::string name, bool quiet) : name_(std::move(name)), quiet_(quiet) {
  const auto* const rung = std::find(kRungNames.begin(), kRungNames.end(), name_);
  if (rung == kRungNames.end()) return;
  try {
    petsc_ = load(static_cast<Rung>(rung - kRungNames.begin()));
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("--linear-solver {}: {}; or leave the option out: the "
                                      "program has a solver of its own",
                                      name_, e.what()));
  }
}

SolverFactory LinearSolvers::load(Rung first) {
  return load_solver_plugin(plugin_folders()).ladder({first, 0}, record_);
}

void LinearSolvers::apply(SolveOptions& options) {
  options.linear_solver = petsc_;
  if (!petsc_)
    options.instead_of_factor = [this](std::size_t bytes) { return instead_of_factor(bytes); };
}

// Says so once: what does not fit at one degree does not at the next one either.
std::unique_ptr<LinearSolver> LinearSolvers::instead_of_factor(std::size_t bytes) {
  const std::optional<std::size_t> available = available_memory();
  if (bytes > largest_.bytes) largest_ = {bytes, process_bytes(), available};
  if (name_ != "auto" || !available || bytes <= *available) return nullptr;
  std::string missing;
  if (!petsc_) try {
      petsc_ = load(Rung::Amg);
    } catch (const Error& e) {
      missing = e.what();
    }
  if (!quiet_ && !std::exchange(has_said_, true))
    say("majorant: factorizing takes {} of memory, {} are left: {}\n", gigabytes(bytes),
        gigabytes(*available),
        petsc_ ? std::string("solving by cg-hypre, without a factor")
               : fmt::format("going on all the same, since cg-hypre, which needs no factor, cannot "
                             "be had: {}",
                             missing));
  return petsc_ ? petsc_() : nullptr;
}

Json LinearSolvers::ladder() const { return petsc_ ? ladder_section(*record_) : Json(); }

Json LinearSolvers::memory() const {
  if (largest_.bytes == 0) return nullptr;
  return {{"factor_bytes", largest_.bytes},
          {"process_bytes", largest_.process},
          {"available_bytes", largest_.available ? Json(*largest_.available) : Json()}};
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
