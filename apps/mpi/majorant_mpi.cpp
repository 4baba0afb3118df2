// majorant-mpi: the command on several ranks, started by mpirun or srun.
//
//     mpirun -n 8 majorant-mpi parametrize big.ply -o big.pvtu --report run.json
//
// It is a binary of its own, so that `majorant` needs no MPI. Every rank reads the same words; rank
// 0 reads files and speaks. Exit codes are those of `majorant`; a rank that fails ends all.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "apps/arguments/command_line.h"
#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "apps/arguments/suggestion.h"
#include "apps/command.h"
#include "apps/energy_option.h"
#include "apps/linear_solvers.h"
#include "apps/map_request.h"
#include "apps/mpi/boundary_proof.h"
#include "apps/mpi/checkpoint.h"
#include "apps/mpi/internal/collect.h"
#include "apps/mpi/internal/part_data.h"
#include "apps/mpi/internal/rethrow_collectively.h"
#include "apps/mpi/parametrize_parts.h"
#include "apps/mpi/petsc_solver.h"
#include "apps/mpi/processes.h"
#include "apps/mpi/starts_of_parts.h"
#include "apps/mpi/write_parts.h"
#include "apps/outputs.h"
#include "apps/process.h"
#include "apps/progress.h"
#include "apps/refusal_message.h"
#include "apps/solve_request.h"
#include "apps/streams.h"
#include "majorant/apps/jobs/global_verdict.h"
#include "majorant/apps/jobs/map_job.h"
#include "majorant/certify/global_injectivity.h"
#include "majorant/framework/error.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/files/waiting_output.h"

namespace majorant::app {
namespace {

// The options --checkpoint, --every and --resume, and the checks whether a file fits them.

struct CheckpointRequest {
  std::string file, resume;  // or empty
  int every = 10;            // iterations

  void add_to(CLI::App& verb);
  Json to_json() const;
};

constexpr const char* kSurface = "surface";

std::string name_of(std::span<const double> numbers) {
  return numbers.empty() ? "" : fmt::format("{:016x}", hashed(std::as_bytes(numbers)));
}

std::string name_of(const std::vector<Pin>& points) {
  std::vector<double> numbers;
  for (const Pin& p : points) {
    const Vector2 target = p.target.value_or(Vector2::Zero());
    numbers.insert(numbers.end(),
                   {static_cast<double>(p.vertex), p.target ? 1.0 : 0.0, target.x(), target.y()});
  }
  return name_of(numbers);
}

// File options are stored as hashes of their contents, which messages do not show.
bool is_file(const std::string& key) {
  return key == "pins" || key == "handles" || key == "weights";
}

std::string difference(const std::string& key, const Json& stored, const Json& current) {
  if (key == kSurface) return "it belongs to another surface than the input";
  if (is_file(key)) return fmt::format("it belongs to a run with another --{}", key);
  const auto text = [](const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
  };
  return fmt::format("it belongs to a run with --{} {}, and this run has {}", key, text(stored),
                     text(current));
}

// Requires that the file has these points with targets.
void require_points(const HeaderReader& stored, const std::vector<Pin>& current) {
  if (stored.size() != current.size())
    refuse_checkpoint(stored.file(), "its header has other points");
  for (std::size_t k = 0; k < current.size(); ++k) {
    stored[k].integer(std::size_t{0}, current[k].vertex, current[k].vertex);
    for (const std::size_t c : {1, 2}) stored[k].finite(c);
  }
}

void CheckpointRequest::add_to(CLI::App& verb) {
  begin_group(verb, OptionGroup::Files);
  verb.add_option(
          "--checkpoint", file,
          "file, .ckpt, that keeps the state of the run for --resume on any number of ranks")
      ->type_name("FILE");
  verb.add_option("--every", every, "iterations between two checkpoints (10)")
      ->type_name("N")
      ->check(whole_number(1))
      ->needs("--checkpoint");
  verb.add_option("--resume", resume, "continue from this checkpoint")->type_name("FILE");
}

Json CheckpointRequest::to_json() const {
  return {{"checkpoint", file}, {"every", every}, {"resume", resume}};
}

// Returns the data that decide at which map a run ends: the surface and the problem, files by their
// contents. Parameters of the search may change between runs: tolerance, limits, solvers, ranks.
Json identity(const MapRequest& request, const MapJob& job) {
  const MapOptions& map = job.options.map;
  return {{kSurface, fingerprint(*job.mesh)},
          {"degree", request.degree},
          {"energy", request.energy},
          {"boundary", request.boundary},
          {"quadrature", request.quadrature},
          {"pins", name_of(map.pins)},
          {"handles", name_of(map.handles)},
          {"soft", request.soft},
          {"weights",
           name_of({map.face_weight.data(), static_cast<std::size_t>(map.face_weight.size())})}};
}

// Returns points with targets in the form of checkpoint headers.
Json points_json(const std::vector<Pin>& points) {
  Json list = Json::array();
  for (const Pin& p : points) list.push_back({p.vertex, p.target->x(), p.target->y()});
  return list;
}

std::vector<Pin> points_from(const Json& json) {
  std::vector<Pin> points;
  for (const Json& p : json) points.push_back({p.at(0), Vector2(p.at(1), p.at(2))});
  return points;
}

// Reads the file of --resume. Throws Error(Unreadable) where read_checkpoint_file() does, if it
// belongs to another surface or other options, and if no run can have written it.
CheckpointFile read_fitting(const std::string& path, const MapRequest& request, const MapJob& job) {
  CheckpointFile file = read_checkpoint_file(path);
  const HeaderReader header(path, file.header), stored = header["identity"];
  const Json all = identity(request, job);
  for (const auto& [key, current] : all.items())
    if (stored.at(key.c_str()) != current)
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}: {}; use the same options, or start anew without --resume", path,
                              difference(key, stored.at(key.c_str()), current)));
  // Further requirements on a file of this surface and these options.
  constexpr auto kMany = std::numeric_limits<std::int64_t>::max();
  header.integer("vertices", job.mesh->vertex_count(), job.mesh->vertex_count());
  header.integer("faces", job.mesh->face_count(), job.mesh->face_count());
  header.integer("degree", 1, request.degree);
  header.integer("iterations", 0, kMany);
  header.integer("ranks", 1, kMany);
  header.finite("seconds");
  header.text("start");
  require_points(header["pins"], job.options.map.pins);
  require_points(header["handles"], job.options.map.handles);
  require_state(path, file, job.options.solve.quadrature_points);
  return file;
}

// Returns the report section about checkpoints written and the checkpoint resumed from.
Json checkpoint_section(const CheckpointRequest& request, const CheckpointWriter& writer) {
  return {{"file", request.file},
          {"every", request.every},
          {"written", writer.written()},
          {"failure", writer.failure()},
          {"seconds", writer.seconds()}};
}

Json resumed_section(const CheckpointRequest& request, const CheckpointFile& file) {
  Json section{{"file", request.resume}};
  for (const char* key : {"degree", "iterations", "seconds", "ranks"})
    section[key] = file.header.at(key);
  return section;
}

// The JSON report of a distributed run: the sections of apps/jobs/report.h that need no complete
// map, and the records of ranks and linear solvers ("ranks", "linear_solver").

// The data of a finished run on rank 0. Other ranks take part through collective calls.
struct PartsRun {
  const MapJob& job;
  const MeshPart& part;
  const ParametrizationResult& result;
  const GlobalInjectivity& boundary;  // valid on rank 0
  std::string start, file;
  double divide_seconds = 0, initialize_seconds = 0, write_seconds = 0;
  Json checkpoint, resumed;  // null: none
  std::string output;
  bool has_map = false;  // whether it was written
};

Json boundary_section(const GlobalInjectivity& proof) {
  return {{"pairs_tested", proof.pairs_tested},
          {"pairs_left", proof.pairs_left},
          {"subdivisions", proof.subdivisions},
          {"reason", proof.reason},
          {"contacts", proof.contacts.size()}};
}

Json result_section(const PartsRun& run, GlobalIndex control_points, double least_det) {
  const ParametrizationResult& r = run.result;
  const MapMeasures& m = r.measures;
  Json section = measures_section({r.map->degree(), control_points}, m, least_det, run.job.energy);
  section.update(overlap_section(run.boundary, ImageOf::Surface, m));
  section.update({{"boundary", boundary_section(run.boundary)},
                  {"start", run.start},
                  {"variables", r.variables},
                  {"initial_value", r.initial_value},
                  {"value_quadrature", r.value_quadrature},
                  {"newton_decrement", r.newton_decrement},
                  {"handle_distance", r.handle_distance}});
  return section;
}

// Collective; returns the report on rank 0, null elsewhere.
Json parts_report(const PartsRun& run) {
  const MeshPart& part = run.part;
  const auto nodes = part.unknowns(run.result.map->space());
  double shared = 0;
  for (const auto& n : nodes->neighbours()) shared += static_cast<double>(n.owned.size() / 2);
  const Traffic sent = traffic();
  const Vec& min_det = run.result.measures.min_det;
  const double least_det = part.ranks().min(
      min_det.size() > 0 ? min_det.minCoeff() : std::numeric_limits<double>::infinity());
  const auto all = gathered(part.ranks(), {static_cast<double>(part.mesh->face_count()),
                                           static_cast<double>(nodes->owned_size() / 2), shared,
                                           static_cast<double>(peak_memory_bytes()), sent.messages,
                                           sent.bytes, sent.reductions});
  if (part.ranks().rank() > 0) return nullptr;
  Json ranks = Json::array();
  for (const auto& r : all)
    ranks.push_back({{"faces", static_cast<long>(r[0])},
                     {"nodes", static_cast<long>(r[1])},
                     {"shared_nodes", static_cast<long>(r[2])},
                     {"peak_memory_bytes", static_cast<long>(r[3])},
                     {"messages", static_cast<long>(r[4])},
                     {"message_bytes", static_cast<long>(r[5])},
                     {"reductions", static_cast<long>(r[6])}});
  const ParametrizationResult& r = run.result;
  RunReport report{.command = std::string(task_name(run.job.task)),
                   .status = std::string(status_name(r.status)),
                   .message = r.message,
                   .input = {{"file", run.file},
                             {"vertices", part.whole.vertices},
                             {"edges", part.whole.edges},
                             {"faces", part.whole.faces}},
                   .options = run.job.options_json,
                   .result = result_section(run, nodes->global_size() / 2, least_det),
                   .seconds = {{"read", run.job.read_seconds},
                               {"divide", run.divide_seconds},
                               {"initialize", run.initialize_seconds},
                               {"optimize", r.optimize_seconds},
                               {"measure", r.measure_seconds},
                               {"write", run.write_seconds},
                               {"total", run.job.record.seconds()}}};
  report.more = {{"iterations", iterations_section(run.job.record.trace())},
                 {"injectivity_tests", {{"depth", r.injectivity_tests}}},
                 {"remedies", remedies_section(r.remedies)},
                 {"linear_solver", run.job.linear_solver},
                 {"ranks", ranks},
                 {"checkpoint", run.checkpoint},
                 {"resumed", run.resumed},
                 {"vector_instructions", vector_instructions()}};
  return to_json(report, {{{"file", run.output}, {"written", run.has_map}, {"message", ""}}});
}

// Returns the claims of the files.
std::string parts_claims(const PartsRun& run) {
  return json_text(without_folders({{"version", MAJORANT_VERSION},
                                    {"degree", run.result.map->degree()},
                                    {"energy", run.job.energy},
                                    {"value", run.result.measures.value},
                                    {"boundary", run.job.options_json["boundary"]},
                                    {"init", run.start},
                                    {"seams", false},
                                    {"bijective", false},
                                    {"cuts", Json::array()},
                                    {"options", run.job.options_json}}));
}

// The number of unknowns below which `auto` factorizes. On one rank a step with MUMPS takes a third
// of the time of cg-hypre at 80,000 unknowns, half at 320,000.
constexpr GlobalIndex kSmall = 200000;

struct Request {
  CommonOptions common;
  MapRequest map;
  SolveRequest solve;
  CheckpointRequest checkpoint;
  std::vector<std::string> outputs;
  std::string linear_solver = "auto";
};

// Refuses flags that need one process, by name.
void require_possible(const Request& request) {
  const auto refuse = [](bool is_given, const char* flag, const char* why) {
    if (is_given)
      throw Error(ErrorKind::Usage,
                  fmt::format("{} needs one process: {}; run `majorant parametrize`", flag, why));
  };
  refuse(request.solve.bijective, "--bijective", "the scaffold is not distributed");
  refuse(request.solve.improve_mesh, "--improve-mesh", "flips need the whole surface");
  refuse(request.solve.no_flips, "--no-flips", "the scaffold is not distributed");
  refuse(!request.solve.scaffold_file.empty(), "--write-scaffold",
         "the scaffold is not distributed");
  refuse(request.solve.snapshots > 0, "--snapshots", "pages hold whole maps");
  refuse(request.map.boundary_angles, "--boundary-angles", "sums at the boundary are not shared");
  refuse(!request.common.format.empty(), "--format", "files are read and written by name");
  refuse(request.map.seamless, "--seamless", "seams tie points of several ranks");
  refuse(request.map.init == "multiresolution", "--init multiresolution",
         "its levels need the whole surface");
  if (request.outputs.size() != 1 || extension(request.outputs.front()) != ".pvtu")
    throw Error(ErrorKind::Usage,
                "name one output, .pvtu; `majorant convert OUT.pvtu -o ...` makes other formats");
}

// Returns whether a single rank factorizes as `majorant` does; only --linear-solver changes that.
bool is_own_solver(const std::string& solver, const Ranks& ranks) {
  return solver == "direct" || (solver == "auto" && ranks.count() == 1);
}

SolverFactory solver_of(const std::string& solver, const Ranks& ranks,
                        const std::shared_ptr<LadderRecord>& record) {
  if (solver == "direct" && ranks.count() > 1)
    throw Error(ErrorKind::Usage,
                "--linear-solver direct is for one rank; use mumps, or one of the others");
  if (is_own_solver(solver, ranks)) return [] { return make_direct_solver(); };
  if (solver == "auto") return petsc_solver({Rung::Amg, kSmall}, record);
  const auto* const name = std::find(kRungNames.begin(), kRungNames.end(), solver);
  return petsc_solver({static_cast<Rung>(name - kRungNames.begin()), 0}, record);
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

// A MapJob whose surface rank 0 opens and all ranks solve.
class SharedJob {
 public:
  SharedJob(const Request& request, const Processes& processes)
      : request_(request),
        ranks_(processes.ranks()),
        is_first_(ranks_->rank() == 0),
        progress_(quiet_elsewhere(request.common, is_first_),
                  {Activity::Reading, Activity::Starting, Activity::Solving, Activity::Measuring,
                   Activity::Proving, Activity::Writing}),
        record_(request.solve.time_limit, request.solve.max_iterations, interruption_flag(),
                &progress_),
        job_(MapTask::Parametrize, record_),
        ladder_(std::make_shared<LadderRecord>()) {
    set_output_stop(record_.stop());
    signal(SIGUSR1, stop_on_user_signal);
  }

  int run() {
    if (is_first_) read();
    divide();
    const SolverFactory solver = solver_of(request_.linear_solver, *ranks_, ladder_);
    const double started = record_.seconds();
    record_.begin(Activity::Starting);
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
    if (resumes() && is_first_) resumed_ = resumed_section(request_.checkpoint, in_.checkpoint);
    in_.checkpoint = {};
    initialize_seconds_ = record_.seconds() - started;
    const ParametrizationResult result =
        parametrize_parts(part_, uv, options, record_, keeping(), from);
    from.reset();
    record_.begin(Activity::Proving);
    const GlobalInjectivity proof = prove_boundary(*part_, *result.map, in_.boundary);
    return conclude(result, proof);
  }

 private:
  static CommonOptions quiet_elsewhere(CommonOptions common, bool is_first) {
    if (!is_first) common.quiet = true, common.verbose = false;
    return common;
  }

  void read() {
    require_writable(request_.common,
                     {{request_.outputs, {".pvtu"}}, {{request_.checkpoint.file}, {".ckpt"}}},
                     request_.map.inputs());
    record_.begin(Activity::Reading);
    MapRequest map = request_.map;
    map.strictness = request_.common.strictness();
    read_input(map, job_);
    in_.identity = identity(request_.map, job_);
    if (resumes()) in_.checkpoint = read_fitting(request_.checkpoint.resume, request_.map, job_);
    job_.read_seconds = record_.seconds();
  }

  void divide() {
    const double started = record_.seconds();
    if (is_first_) {
      in_.rank_of_face = face_ranks(*job_.mesh, ranks_->count());
      in_.boundary = BoundaryOrder(*job_.mesh, in_.rank_of_face);
    }
    part_ =
        std::make_shared<const MeshPart>(distributed(job_.mesh.get(), in_.rank_of_face, ranks_));
    in_.rank_of_face = {};
    divide_seconds_ = record_.seconds() - started;
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
              writer_->write(state, record_.seconds());
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
    if (led_to_pins(*part_, job_.mesh, uv, job_.options, record_) && is_first_ &&
        !request_.common.quiet)
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
    if (tutte.on_one_rank && is_first_ && !request_.common.quiet)
      say("majorant-mpi: Tutte's map leaves faces no room, rank 0 makes the start alone\n");
    return std::move(tutte.uv);
  }

  OwnSolver own_solver() const {
    return is_own_solver(request_.linear_solver, *ranks_) ? OwnSolver::Used : OwnSolver::Unused;
  }

  int conclude(const ParametrizationResult& result, const GlobalInjectivity& proof) {
    job_.energy = request_.map.energy;
    job_.options_json = request_.map.to_json();
    job_.options_json.update(request_.solve.to_json());
    job_.options_json.update(request_.checkpoint.to_json());
    job_.linear_solver = linear_solver_section(request_.linear_solver, own_solver(), *ladder_);
    PartsRun run{job_,
                 *part_,
                 result,
                 proof,
                 start_,
                 request_.map.input,
                 divide_seconds_,
                 initialize_seconds_,
                 0,
                 writer_ ? checkpoint_section(request_.checkpoint, *writer_) : Json(),
                 resumed_,
                 request_.outputs.front()};
    const bool has_map = result.status != Status::Failed && result.status != Status::Infeasible;
    run.has_map = has_map;
    const double started = record_.seconds();
    if (has_map) {
      record_.begin(Activity::Writing);
      write_parts(request_.outputs.front(), *part_, result, is_first_ ? parts_claims(run) : "");
    }
    run.write_seconds = record_.seconds() - started;
    const Json report = parts_report(run);
    progress_.finish();
    if (!is_first_) return exit_code(status_name(result.status));
    if (!request_.common.report.empty()) write_json(request_.common.report, report);
    if (!request_.common.quiet)
      say("majorant-mpi: {}: {} ({}), degree {}, {} {:.10g}, {}, {} faces on {} ranks, {:.3g} s\n",
          request_.outputs.front(), status_name(result.status), result.message,
          result.map->degree(), request_.map.energy, result.measures.value,
          overlap_words(proof, ImageOf::Surface), part_->whole.faces, ranks_->count(),
          record_.seconds());
    return exit_code(status_name(result.status));
  }

  const Request& request_;
  std::shared_ptr<const Ranks> ranks_;
  bool is_first_;
  Progress progress_;
  RunRecord record_;
  MapJob job_;
  std::shared_ptr<LadderRecord> ladder_;
  Input in_;
  std::shared_ptr<const MeshPart> part_;
  std::string start_;
  std::optional<CheckpointWriter> writer_;  // none: no checkpoints
  Json resumed_;                            // for the report
  double divide_seconds_ = 0, initialize_seconds_ = 0;
};

void add_to(CLI::App& app, Request& request) {
  CLI::App& verb = *app.add_subcommand(
      "parametrize", "map a disk onto the plane, injectively and with low distortion");
  request.common.add_to(verb);
  request.common.add_petsc_to(verb);
  request.map.add_to(verb, "3");
  request.map.add_start_to(verb);
  begin_group(verb, OptionGroup::Charts);
  verb.add_flag("--seamless", request.map.seamless, "refused: needs one process, majorant");
  request.solve.add_to(verb, request.map.curvature);
  request.checkpoint.add_to(verb);
  verb.add_option("-o,--output", request.outputs,
                  "output: .pvtu, with a .vtu for every rank beside it")
      ->type_name("FILE")
      ->required();
  begin_group(verb, OptionGroup::Solver);
  std::vector<std::string> solvers{"auto", "direct"};
  solvers.insert(solvers.end(), kRungNames.begin(), kRungNames.end());
  verb.add_option("--linear-solver", request.linear_solver,
                  "direct: for one rank; cg-hypre, cg-gamg, cg-icc, mumps: the first solver that "
                  "is tried (auto)")
      ->check(one_of(solvers));
  verb.footer(
      energy_help() +
      "Example: mpirun -n 8 majorant-mpi parametrize big.ply -o big.pvtu --report run.json");
}

using Ending = std::pair<int, std::string>;  // exit code and text

// Parses the words with CLI11. Returns an ending if nothing is left to do.
std::optional<Ending> parse(std::vector<std::string> words, Request& request) {
  CLI::App app{"majorant-mpi: maps of surfaces onto the plane, on several processes",
               "majorant-mpi"};
  app.formatter(std::make_shared<HelpFormatter>(HelpLength::Full));
  begin_group(app, OptionGroup::General);
  app.set_help_flag("-h,--help", "print this help");
  app.get_help_ptr()->group(app.option_defaults()->get_group());
  app.set_version_flag("-V,--version", version_line(), "print the version");
  app.require_subcommand(1);
  add_to(app, request);
  std::reverse(words.begin(), words.end());
  try {
    app.parse(words);
  } catch (const CLI::ParseError& e) {
    std::ostringstream text;
    if (e.get_exit_code() != 0) return Ending{kUsage, usage_message(app, e)};
    app.exit(e, text, text);
    return Ending{kSuccess, text.str()};
  }
  return {};
}

int run(int argc, char** argv) {
  Request request;
  std::optional<Ending> ending;
  std::optional<Processes> processes;
  try {
    ending = parse({argv + 1, argv + argc}, request);
    processes.emplace(ending ? std::vector<std::string>()
                             : petsc_words(request.common.petsc_options));
    request.map.choose_degree({});
    if (!ending) require_possible(request);
  } catch (const Error& e) {  // the same on all ranks
    if (is_first_process()) say("majorant-mpi: {}\n", e.what());
    return exit_code(e.kind());
  }
  const int rank = processes->ranks()->rank();
  if (ending) {
    if (rank == 0 && ending->first == kSuccess) print_text(ending->second);
    if (rank == 0 && ending->first != kSuccess) say("majorant-mpi: {}\n", ending->second);
    return ending->first;
  }
  // Ends all ranks, because the others wait for the rank that failed.
  const auto fail = [&](int code) -> int {
    if (processes->ranks()->count() > 1) processes->abort(code);
    return code;
  };
  try {
    const ThreadCount threads(usable_threads(std::max(request.common.threads, 1)));
    const int code = SharedJob(request, *processes).run();
    if (const auto unused = processes->unused_options();
        rank == 0 && !request.common.quiet && !unused.empty())
      say("majorant-mpi: warning: --petsc-options: PETSc did not use {}\n",
          fmt::join(unused, ", "));
    return code;
  } catch (const FailedElsewhere&) {  // the failing rank prints the message and ends all
    return kInternal;
  } catch (const Error& e) {
    say("majorant-mpi: rank {}: {}\n", rank, command_message(e));
    return fail(exit_code(e.kind()));
  } catch (const std::bad_alloc&) {
    say("majorant-mpi: rank {}: out of memory; use more ranks or nodes\n", rank);
    return fail(kUnsupported);
  } catch (const std::exception& e) {
    say("majorant-mpi: rank {}: internal error: {}; please report it with the input\n", rank,
        e.what());
    return fail(kInternal);
  }
}

}  // namespace
}  // namespace majorant::app

int main(int argc, char** argv) {
  majorant::app::prepare_process();
  return majorant::app::run(argc, argv);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
