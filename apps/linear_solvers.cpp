#include "apps/linear_solvers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "apps/arguments/help_text.h"
#include "apps/arguments/suggestion.h"
#include "apps/plugins/plugin.h"
#include "apps/streams.h"
#include "majorant/framework/error.h"

namespace majorant::app {
namespace {

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
  begin_group(verb, OptionGroup::Solver);
  verb.add_option("--linear-solver", name,
                  "direct: the built-in factorization; cholmod: CHOLMOD; mumps, cg-hypre: with "
                  "PETSc; auto: direct, or cg-hypre where a factor does not fit into memory and "
                  "cg-hypre needs less (auto)")
      ->check(one_of({"auto", "direct", "cholmod", "mumps", "cg-hypre"}));
}

LinearSolvers::LinearSolvers(std::string name, const CommonOptions& common, Runs runs)
    : name_(std::move(name)),
      petsc_words_(petsc_words(common.petsc_options)),
      quiet_(common.quiet),
      runs_(runs) {
  const auto* const method = std::find(kPetscMethodNames.begin(), kPetscMethodNames.end(), name_);
  try {
    if (name_ == "cholmod")
      plugin_ = load_plugin<CholmodPlugin>(kCholmodPlugin).make_solver;
    else if (method != kPetscMethodNames.end())
      plugin_ = load_petsc(static_cast<PetscMethod>(method - kPetscMethodNames.begin()));
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::Usage) throw;  // malformed --petsc-options
    throw Error(e.kind(), fmt::format("--linear-solver {}: {}; or leave the option out: the "
                                      "program has a solver of its own",
                                      name_, e.what()));
  }
}

SolverFactory LinearSolvers::load_petsc(PetscMethod first) {
  const auto& petsc = load_plugin<PetscPlugin>(kPetscPlugin);
  SolverFactory factory = petsc.fallback_chain({first, 0}, record_, petsc_words_);
  petsc_ = &petsc;
  return factory;
}

void LinearSolvers::apply(SolveOptions& options) {
  options.linear_solver = [this](const SparsePattern& pattern, const DirectSolverOptions& direct) {
    return make(pattern, direct);
  };
}

// Analyses the pattern only if the factor may not fit into memory.
void LinearSolvers::foresee(const SurfaceMesh& mesh, const ParametrizationOptions& options) {
  const int degree = options.map.degree;
  if (name_ != "auto" || degree == 1 || options.solve.elevation != Elevation::Incremental) return;
  const std::optional<std::size_t> available = available_memory();
  if (foreseen_memory(factor_size_at_most(mesh, degree), available).fits_direct()) return;
  const FactorSize needed = factor_size(mesh, degree);
  const std::lock_guard lock(mutex_);
  foreseen_ = needed.bytes;
  gives_way(foreseen_memory(needed, available), degree);
}

// Returns the direct solver after the analysis of the pattern, before memory is allocated, or
// another solver.
std::shared_ptr<LinearSolver> LinearSolvers::make(const SparsePattern& pattern,
                                                  const DirectSolverOptions& options) {
  if (name_ != "auto" && name_ != "direct") {
    used_cholmod_ |= name_ == "cholmod" && pattern.size > 0;
    return plugin_();
  }
  std::unique_ptr<LinearSolver> direct = make_direct_solver(options);
  if (pattern.size == 0) return direct;
  direct->analyze(pattern);
  const SolverMemory memory =
      solver_memory({direct->bytes(), pattern.rows.size()}, available_memory());
  const std::lock_guard lock(mutex_);
  if (memory.direct > largest_.direct) largest_ = memory, process_ = process_bytes();
  if (gives_way(memory, 0)) return plugin_();
  own_ = OwnSolver::Used;
  return direct;
}

// Returns whether cg-hypre replaces the direct solver, now or at a later degree (0: now). Prints
// this once, since a factor that does not fit at one degree does not fit at the next.
bool LinearSolvers::gives_way(const SolverMemory& memory, int foreseen_degree) {
  if (name_ != "auto" || memory.fits_direct()) return false;
  const bool is_foreseen = foreseen_degree > 0;
  const std::string multigrid = gigabytes(memory.multigrid);
  std::string outcome = fmt::format("solving by cg-hypre, without a factor, in {}", multigrid);
  if (runs_ == Runs::Several) {
    outcome = "the run goes on with direct, since charts support no other solver";
  } else if (!memory.prefers_multigrid()) {
    outcome = fmt::format("the run goes on with direct, since cg-hypre would take {}", multigrid);
  } else if (!plugin_) {
    try {
      plugin_ = load_petsc(PetscMethod::Amg);
    } catch (const Error& e) {
      outcome = fmt::format(
          "the run goes on with direct, since cg-hypre, which takes {}, is not available: {}",
          multigrid, e.what());
    }
  }
  if (!quiet_ && !std::exchange(has_warned_, true))
    say("majorant: {} {} of memory, {} are left{}: {}\n",
        is_foreseen ? fmt::format("at degree {} factorizing will take", foreseen_degree)
                    : "factorizing takes",
        gigabytes(memory.direct), gigabytes(*memory.available), is_foreseen ? " for it now" : "",
        outcome);
  return runs_ == Runs::One && memory.prefers_multigrid() && plugin_;
}

void LinearSolvers::say_unused_options() const {
  if (quiet_ || petsc_words_.empty()) return;
  if (!petsc_)
    return say_warnings(
        {"--petsc-options has no effect, since PETSc was not used; choose it with --linear-solver "
         "cg-hypre or mumps"});
  if (const std::vector<std::string> unused = petsc_->unused_options(); !unused.empty())
    say_warnings({fmt::format("--petsc-options: PETSc did not use {}", fmt::join(unused, ", "))});
}

Json LinearSolvers::section() const {
  Json section = linear_solver_section(name_, own_, *record_);
  if (used_cholmod_) section["used"] = "cholmod";
  return section;
}

Json LinearSolvers::memory() const {
  if (largest_.direct == 0) return nullptr;
  return {{"factor_bytes", largest_.direct},
          {"multigrid_bytes", largest_.multigrid},
          {"process_bytes", process_},
          {"available_bytes", largest_.available ? Json(*largest_.available) : Json()},
          {"foreseen_bytes", foreseen_ ? Json(*foreseen_) : Json()}};
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
