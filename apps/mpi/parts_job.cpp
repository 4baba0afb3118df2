#include "apps/mpi/parts_job.h"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "apps/arguments/suggestion.h"
#include "apps/energy_option.h"
#include "apps/linear_solvers.h"
#include "apps/mpi/boundary_proof.h"
#include "apps/mpi/internal/part_data.h"
#include "apps/mpi/internal/rethrow_collectively.h"
#include "apps/mpi/parametrize_parts.h"
#include "apps/mpi/parts_report.h"
#include "apps/mpi/petsc_solver.h"
#include "apps/mpi/starts_of_parts.h"
#include "apps/mpi/write_parts.h"
#include "apps/run.h"
#include "apps/streams.h"
#include "majorant/apps/jobs/global_verdict.h"
#include "majorant/apps/jobs/map_job.h"
#include "majorant/certify/global_injectivity.h"
#include "majorant/framework/error.h"
#include "majorant/framework/linear_solver.h"

namespace majorant::app {
namespace {

// The number of unknowns below which `auto` factorizes. On one rank a step with MUMPS takes a third
// of the time of cg-hypre at 80,000 unknowns, half at 320,000.
constexpr GlobalIndex kSmall = 200000;

// Returns whether a single rank factorizes as `majorant` does; only --linear-solver changes that.
bool is_own_solver(const std::string& solver, const Ranks& ranks) {
  return solver == "direct" || (solver == "auto" && ranks.count() == 1);
}

SolverFactory solver_of(const std::string& solver, const Ranks& ranks,
                        const std::shared_ptr<FallbackRecord>& record) {
  if (solver == "direct" && ranks.count() > 1)
    throw Error(ErrorKind::Usage,
                "--linear-solver direct is for one rank; use mumps, or one of the others");
  if (is_own_solver(solver, ranks)) return [] { return make_direct_solver(); };
  if (solver == "auto") return petsc_solver({PetscMethod::Amg, kSmall}, record);
  const auto* const name = std::find(kPetscMethodNames.begin(), kPetscMethodNames.end(), solver);
  return petsc_solver({static_cast<PetscMethod>(name - kPetscMethodNames.begin()), 0}, record);
}

// The input on rank 0, besides the job.
struct Input {
  std::vector<int> rank_of_face;
  BoundaryOrder boundary;
  Json identity;              // for checkpoints
  CheckpointFile checkpoint;  // the file of --resume
};

// SIGUSR1, which mpirun forwards, stops a run like the signals that end it.
extern "C" void stop_on_user_signal(int) { raise(SIGTERM); }

// The options of this rank's run: the first rank alone reads and writes files and speaks.
CommonOptions options_of_rank(const PartsRequest& request, const Ranks& ranks) {
  CommonOptions common = request.common;
  common.threads = std::max(common.threads, 1);
  if (ranks.rank() == 0) return common;
  common.quiet = true;
  common.verbose = false;
  common.report.clear();
  return common;
}

RunPlan plan_of(const PartsRequest& request, const CommonOptions& common, const Ranks& ranks) {
  RunPlan plan{.command = std::string(task_name(MapTask::Parametrize)),
               .common = common,
               .inputs = request.map.inputs(),
               .time_limit = request.solve.time_limit,
               .max_iterations = request.solve.max_iterations,
               .with_result = {Activity::Starting, Activity::Solving, Activity::Measuring,
                               Activity::Proving, Activity::Writing},
               .speaker = fmt::format("majorant-mpi: rank {}", ranks.rank())};
  if (ranks.rank() > 0) {
    plan.with_result.push_back(Activity::Reading);  // it waits for the first rank
    return plan;
  }
  plan.outputs = {{request.outputs, {".pvtu"}, false},
                  {{request.checkpoint.file}, {".ckpt"}, false}};
  plan.stages = {Activity::Reading,   Activity::Starting, Activity::Solving,
                 Activity::Measuring, Activity::Proving,  Activity::Writing};
  return plan;
}

// A MapJob whose surface rank 0 opens and all ranks solve. Members are collective.
class SharedJob {
 public:
  SharedJob(const PartsRequest& request, const std::shared_ptr<const Ranks>& ranks, Run& run)
      : request_(request),
        ranks_(ranks),
        is_first_(ranks->rank() == 0),
        run_(run),
        job_(MapTask::Parametrize, run.record()),
        fallback_record_(std::make_shared<FallbackRecord>()) {}

  Made make() {
    if (is_first_) read();
    divide();
    const SolverFactory solver = solver_of(request_.linear_solver, *ranks_, fallback_record_);
    const double started = run_.seconds();
    run_.record().begin(Activity::Starting);
    const Vec uv = make_start(solver);
    ParametrizationOptions options = local_options();
    options.solve.linear_solver = [solver](const SparsePattern&, const DirectSolverOptions&) {
      return solver();
    };
    std::optional<RunState> from;
    if (resumes()) from = state_of(*part_, in_.checkpoint);
    make_writer(uv);
    job_.mesh.reset();  // rank 0 no longer needs the whole surface
    job_.polygons.reset();
    if (resumes() && is_first_) resumed_ = request_.checkpoint.resumed_section(in_.checkpoint);
    in_.checkpoint = {};
    initialize_seconds_ = run_.seconds() - started;
    result_ = parametrize_parts(part_, uv, options, run_.record(), keeping(), from);
    run_.record().begin(Activity::Proving);
    return made(prove_boundary(*part_, *result_->map, in_.boundary));
  }

 private:
  void read() {
    MapRequest map = request_.map;
    map.strictness = request_.common.strictness();
    read_input(map, job_);
    in_.identity = identity(request_.map, job_);
    if (resumes()) in_.checkpoint = request_.checkpoint.read_fitting(request_.map, job_);
    job_.read_seconds = run_.seconds();
  }

  void divide() {
    const double started = run_.seconds();
    if (is_first_) {
      in_.rank_of_face = face_ranks(*job_.mesh, ranks_->count());
      in_.boundary = BoundaryOrder(*job_.mesh, in_.rank_of_face);
    }
    part_ =
        std::make_shared<const MeshPart>(distributed(job_.mesh.get(), in_.rank_of_face, ranks_));
    in_.rank_of_face = {};
    divide_seconds_ = run_.seconds() - started;
  }

  // Options are the same words on all ranks; contents of files come from rank 0.
  ParametrizationOptions local_options() const {
    MapRequest plain = request_.map;
    plain.pins = plain.handles = plain.weights = "";
    ParametrizationOptions options = read_options(plain, {}, *part_->mesh);
    request_.solve.apply(options);
    const MapOptions& whole = job_.options.map;
    options.map.pins = pins_of_part(*part_, whole.pins, Copies::All);
    options.map.handles = pins_of_part(*part_, whole.handles, Copies::Owner);
    options.map.face_weight = of_faces(*part_, whole.face_weight, 1);
    return options;
  }

  bool resumes() const { return !request_.checkpoint.resume.empty(); }

  void make_writer(const Vec& uv) {
    if (request_.checkpoint.file.empty()) return;
    Json about{{"program", version_line()},
               {"start", start_},
               {"identity", in_.identity},
               {"pins", points_json(job_.options.map.pins)},
               {"handles", points_json(job_.options.map.handles)}};
    if (resumes() && is_first_)
      for (const char* key : {"iterations", "seconds"}) about[key] = in_.checkpoint.header.at(key);
    writer_.emplace(request_.checkpoint.file, part_, uv, std::move(about));
  }

  CheckpointPolicy keeping() {
    if (!writer_) return {};
    return {request_.checkpoint.every, [this](const RunState& state) {
              const bool failed = !writer_->failure().empty();
              writer_->write(state, run_.seconds());
              if (!failed && !writer_->failure().empty())
                say("majorant-mpi: {}; the run goes on, an older checkpoint stays\n",
                    writer_->failure());
            }};
  }

  // Makes the start. The targets of pins and handles are known afterwards.
  Vec make_start(const SolverFactory& solver) {
    if (resumes()) {
      if (is_first_) {
        start_ = in_.checkpoint.header.at("start");
        job_.options.map.pins = points_from(in_.checkpoint.header.at("pins"));
        job_.options.map.handles = points_from(in_.checkpoint.header.at("handles"));
      }
      return of_vertices(*part_, in_.checkpoint.start, 2);
    }
    Vec uv = unled_start(solver);
    request_.solve.apply(job_.options);
    if (led_to_pins(*part_, job_.mesh, uv, job_.options, run_.record()) && is_first_ &&
        !run_.is_quiet())
      say("majorant-mpi: pins are away from the start, rank 0 leads it there alone\n");
    return uv;
  }

  Vec unled_start(const SolverFactory& solver) {
    if (request_.map.init == "input") {
      start_ = "input";
      return of_vertices(*part_, job_.options.map.initial.value_or(Vec()), 2);
    }
    TutteOfParts tutte = tutte_of_parts(*part_, is_first_ ? job_.mesh.get() : nullptr, solver);
    start_ = "tutte";
    if (tutte.on_one_rank && is_first_ && !run_.is_quiet())
      say("majorant-mpi: Tutte's map leaves faces no room, rank 0 makes the start alone\n");
    return std::move(tutte.uv);
  }

  OwnSolver own_solver() const {
    return is_own_solver(request_.linear_solver, *ranks_) ? OwnSolver::Used : OwnSolver::Unused;
  }

  Made made(const GlobalInjectivity& proof) {
    job_.energy = request_.map.energy;
    job_.options_json = request_.map.to_json();
    job_.options_json.update(request_.solve.to_json());
    job_.options_json.update(request_.checkpoint.to_json());
    job_.linear_solver =
        linear_solver_section(request_.linear_solver, own_solver(), *fallback_record_);
    const PartsRun run{job_,
                       *part_,
                       *result_,
                       proof,
                       start_,
                       request_.map.input,
                       divide_seconds_,
                       initialize_seconds_,
                       writer_ ? request_.checkpoint.section(*writer_) : Json(),
                       resumed_};
    Made made{.report = parts_report(run)};
    made.report.status = std::string(status_name(result_->status));  // of all ranks
    const bool has_map = result_->status != Status::Failed && result_->status != Status::Infeasible;
    if (has_map)
      made.files.push_back(
          {request_.outputs.front(), [this, claims = is_first_ ? parts_claims(run) : ""] {
             try {
               write_parts(request_.outputs.front(), *part_, *result_, claims);
             } catch (const ReportedByFirstRank&) {
             }
           }});
    if (!has_map && is_first_)
      made.faults.push_back(
          fmt::format("majorant-mpi: {}: no valid result: {} ({}); no map is written",
                      request_.map.input, made.report.status, result_->message));
    if (is_first_)
      made.summary = [this, overlaps = overlap_words(proof, ImageOf::Surface)](const auto&) {
        return std::vector{summary(overlaps)};
      };
    return made;
  }

  std::string summary(const std::string& overlaps) const {
    return fmt::format(
        "majorant-mpi: {}: {} ({}), degree {}, {} {:.10g}, {}, {} faces on {} ranks, {:.3g} s",
        request_.outputs.front(), status_name(result_->status), result_->message,
        result_->map->degree(), request_.map.energy, result_->measures.value, overlaps,
        part_->whole.faces, ranks_->count(), run_.seconds());
  }

  const PartsRequest& request_;
  std::shared_ptr<const Ranks> ranks_;
  bool is_first_;
  Run& run_;
  MapJob job_;
  std::shared_ptr<FallbackRecord> fallback_record_;
  Input in_;
  std::shared_ptr<const MeshPart> part_;
  std::string start_;
  std::optional<CheckpointWriter> writer_;  // none: no checkpoints
  Json resumed_;                            // for the report
  std::optional<ParametrizationResult> result_;
  double divide_seconds_ = 0, initialize_seconds_ = 0;
};

}  // namespace

void PartsRequest::add_to(CLI::App& verb) {
  common.add_to(verb);
  common.add_petsc_to(verb);
  map.add_to(verb, "3");
  map.add_start_to(verb);
  begin_group(verb, OptionGroup::Charts);
  verb.add_flag("--seamless", map.seamless, "refused: needs one process, majorant");
  solve.add_to(verb, map.curvature);
  checkpoint.add_to(verb);
  verb.add_option("-o,--output", outputs, "output: .pvtu, with a .vtu for every rank beside it")
      ->type_name("FILE")
      ->required();
  begin_group(verb, OptionGroup::Solver);
  std::vector<std::string> solvers{"auto", "direct"};
  solvers.insert(solvers.end(), kPetscMethodNames.begin(), kPetscMethodNames.end());
  verb.add_option("--linear-solver", linear_solver,
                  "direct: for one rank; cg-hypre, cg-gamg, cg-icc, mumps: the first solver that "
                  "is tried (auto)")
      ->check(one_of(solvers));
  verb.footer(
      energy_help() +
      "Example: mpirun -n 8 majorant-mpi parametrize big.ply -o big.pvtu --report run.json");
}

void PartsRequest::require_possible() const {
  const auto refuse = [](bool is_given, const char* flag, const char* why) {
    if (is_given)
      throw Error(ErrorKind::Usage,
                  fmt::format("{} needs one process: {}; run `majorant parametrize`", flag, why));
  };
  refuse(solve.bijective, "--bijective", "the scaffold is not distributed");
  refuse(solve.improve_mesh, "--improve-mesh", "flips need the whole surface");
  refuse(solve.no_flips, "--no-flips", "the scaffold is not distributed");
  refuse(!solve.scaffold_file.empty(), "--write-scaffold", "the scaffold is not distributed");
  refuse(solve.snapshots > 0, "--snapshots", "pages hold whole maps");
  refuse(map.boundary_angles, "--boundary-angles", "sums at the boundary are not shared");
  refuse(!common.format.empty(), "--format", "files are read and written by name");
  refuse(map.seamless, "--seamless", "seams tie points of several ranks");
  refuse(map.init == "multiresolution", "--init multiresolution",
         "its levels need the whole surface");
  if (outputs.size() != 1 || extension(outputs.front()) != ".pvtu")
    throw Error(ErrorKind::Usage,
                "name one output, .pvtu; `majorant convert OUT.pvtu -o ...` makes other formats");
}

int run_parts(const PartsRequest& request, const Processes& processes) {
  const std::shared_ptr<const Ranks>& ranks = processes.ranks();
  const CommonOptions common = options_of_rank(request, *ranks);
  const RunPlan plan = plan_of(request, common, *ranks);
  // The other ranks wait for one that fails alone, so it ends them.
  const auto end_all = [&](int code) {
    if (ranks->count() > 1) processes.abort(code);
    return code;
  };
  try {
    Run run(plan);
    signal(SIGUSR1, stop_on_user_signal);
    SharedJob job(request, ranks, run);
    bool failed = false;
    const int code = run.conclude([&](Run&) {
      try {
        return job.make();
      } catch (...) {
        failed = true;
        throw;
      }
    });
    return failed ? end_all(code) : ranks->of_first(code);
  } catch (...) {
    const Failure failure = failure_of(std::current_exception());
    say("{}: {}\n", plan.speaker, failure.line);
    return end_all(failure.code);
  }
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
