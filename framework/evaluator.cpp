#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/element_values.h"
#include "majorant/framework/joint_term.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/problem_parts.h"
#include "majorant/framework/stopwatch.h"

namespace majorant {
namespace {

// One thread evaluates a term whose squares of local unknowns, summed over the elements, are fewer:
// 16 batches of triangles of degree 1.
constexpr double kParallelWork = 16.0 * ElementBatch::kMaxSize * 36;
// The elements of a task if a term has few batches: a multiple of the lanes of every kernel.
constexpr std::size_t kPiece = 32;
// With fewer batches of a colour for each thread, all local systems are computed before any is
// added.
constexpr std::size_t kWideColour = 4;
// The maximum bytes of local systems in memory at a time.
constexpr std::size_t kWindowBytes = std::size_t{64} << 20;
// A JointTerm computes this many batches together: its memory is bounded, its calls are few.
constexpr std::size_t kJointBatches = 128;

double weight(const TermState& state, Index element) {
  return state.element_weight.size() ? state.weight * state.element_weight[element] : state.weight;
}

// Returns the number of threads that pays for so many elements of a term.
int threads_for(const EnergyTerm& term, std::size_t elements) {
  const double size = term.element_dofs().local_size();
  return size * size * static_cast<double>(elements) < kParallelWork ? 1 : ThreadCount::current();
}

// Calls run(batch, workspace) for each batch.
template <class Run>
void visit_batches(Index count, int threads, const StopCheck& stop, const Run& run) {
  std::vector<Workspace> workspaces(to_size(threads));
  const auto visit = [&](Index c, int thread) {
    stop.poll();
    run(c, workspaces[thread]);
  };
  parallel_tasks(count, visit, threads);
}

std::size_t elements_of(const ColoredBatches& plan, Index first, Index last) {
  std::size_t count = 0;
  for (Index c = first; c < last; ++c) count += plan.batch(c).elements.size();
  return count;
}

// Consecutive elements of a batch, from position `place` on.
struct Piece {
  Index batch;
  std::size_t place;
  ElementBatch part;
};

void append_pieces(Index c, const ElementBatch& batch, std::vector<Piece>& pieces) {
  for (std::size_t place = 0; place < batch.elements.size(); place += kPiece) {
    const std::size_t size = std::min(kPiece, batch.elements.size() - place);
    pieces.push_back({c, place, {batch.rule, batch.elements.subspan(place, size)}});
  }
}

// Calls read(c, batch, values) for all batches of a plan.
template <class Read>
void visit_values(const EnergyTerm& term, const TermState& state, const ColoredBatches& plan,
                  VecIn x, const StopCheck& stop, const Read& read) {
  const auto visit = [&](const EnergyTerm& from, Index first, Index last) {
    const int threads = threads_for(term, elements_of(plan, first, last));
    if (threads == 1 || to_size(last - first) >= kWideColour * to_size(threads))
      return visit_batches(last - first, threads, stop, [&](Index c, Workspace& workspace) {
        double f[ElementBatch::kMaxSize];
        const ElementBatch batch = plan.batch(first + c);
        from.values(x, batch, state, workspace, {f, batch.elements.size()});
        read(first + c, batch, f);
      });
    constexpr std::size_t stride = ElementBatch::kMaxSize;
    std::vector<double> f(to_size(last - first) * stride);
    std::vector<Piece> pieces;
    for (Index c = first; c < last; ++c) append_pieces(c, plan.batch(c), pieces);
    visit_batches(static_cast<Index>(pieces.size()), threads, stop,
                  [&](Index k, Workspace& workspace) {
                    const Piece& piece = pieces[to_size(k)];
                    double* to = f.data() + to_size(piece.batch - first) * stride + piece.place;
                    from.values(x, piece.part, state, workspace, {to, piece.part.elements.size()});
                  });
    for (Index c = first; c < last; ++c)
      read(c, plan.batch(c), f.data() + to_size(c - first) * stride);
  };
  const auto* joint = dynamic_cast<const JointTerm*>(&term);
  if (!joint) return visit(term, 0, plan.batch_count());
  std::vector<ElementBatch> batches;
  for (Index first = 0, last = 0; first < plan.batch_count(); first = last) {
    stop.poll();
    batches.clear();
    while (last < plan.batch_count() && batches.size() < kJointBatches)
      batches.push_back(plan.batch(last++));
    visit(*joint->computed(x, batches, state, {}), first, last);
  }
}

void add_energy(const Problem& problem, TermId id, VecIn x, const StopCheck& stop, double& total) {
  const TermState& state = problem.state(id);
  const ColoredBatches& plan = ProblemParts::plan(problem, id);
  std::vector<double> sums(to_size(plan.batch_count()), 0.0);
  visit_values(problem.term(id), state, plan, x, stop,
               [&](Index c, const ElementBatch& batch, const double* f) {
                 for (std::size_t p = 0; p < batch.elements.size(); ++p)
                   if (const double w = weight(state, batch.elements[p]); w != 0)
                     sums[c] += w * f[p];
               });
  for (const double sum : sums) total += sum;
}

}  // namespace

struct Evaluator::Scratch {
  Workspace kernel, local, window;
};

Evaluator::Evaluator(const Problem& problem) : problem_(problem) {}
Evaluator::~Evaluator() = default;

void Evaluator::reset(const Problem& problem) { problem_ = problem; }

Vec element_values(const EnergyTerm& term, const TermState& state, const ColoredBatches& plan,
                   VecIn x, const StopCheck& stop) {
  Vec f(term.element_dofs().element_count());
  visit_values(term, state, plan, x, stop, [&](Index, const ElementBatch& batch, const double* at) {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) f[batch.elements[p]] = at[p];
  });
  return f;
}

Vec element_values(const EnergyTerm& term, const TermState& state, RuleId rule,
                   std::span<const Index> elements, VecIn x, const StopCheck& stop) {
  constexpr std::size_t size = ElementBatch::kMaxSize;
  Vec f(static_cast<Index>(elements.size()));
  visit_batches(static_cast<Index>((elements.size() + size - 1) / size),
                threads_for(term, elements.size()), stop, [&](Index c, Workspace& workspace) {
                  const std::size_t first = size * to_size(c);
                  const auto part =
                      elements.subspan(first, std::min(size, elements.size() - first));
                  term.values(x, {rule, part}, state, workspace, {f.data() + first, part.size()});
                });
  return f;
}

Vec element_values(const Problem& problem, TermId id, VecIn x, const StopCheck& stop) {
  require_size("element_values: x", x.size(), problem.full_size());
  return element_values(problem.term(id), problem.state(id), ProblemParts::plan(problem, id), x,
                        stop);
}

double term_energy(const Problem& problem, TermId id, VecIn x, const StopCheck& stop) {
  require_size("term_energy: x", x.size(), problem.full_size());
  require_no_stop("term_energy: the stop check", stop, partition_of(problem));
  double total = 0;
  add_energy(problem, id, x, stop, total);
  return partition_of(problem).sum(total);
}

double Evaluator::value(VecIn y, const StopCheck& stop) {
  require_size("Evaluator::value: y", y.size(), problem_.size());
  require_no_stop("Evaluator: the stop check", stop, partition_of(problem_));
  const AddedSeconds time(counters_.value_seconds);
  ++counters_.values;
  ProblemParts::elimination(problem_).expand(y, x_);
  double total = 0;
  for (const TermId id : problem_.terms()) add_energy(problem_, id, x_, stop, total);
  return partition_of(problem_).sum(total);
}

double Evaluator::linearize(VecIn y, BlendedCurvature curvature, Vec& gradient, Vec& hessian_values,
                            const StopCheck& stop) {
  require_size("Evaluator::linearize: y", y.size(), problem_.size());
  require_curvature("Evaluator::linearize", problem_, curvature.model);
  if (!(curvature.projection_weight >= 0 && curvature.projection_weight <= 2))
    throw InvalidArgument(
        "Evaluator::linearize: the projection weight of a curvature must lie in 0..2");
  const AddedSeconds time(counters_.linearize_seconds);
  ++counters_.linearizations;
  hessian_values.setZero(problem_.pattern().nonzeros());
  return assemble(y, curvature, problem_.terms(), gradient, &hessian_values, stop);
}

double Evaluator::gradient(VecIn y, Vec& gradient, const StopCheck& stop) {
  require_size("Evaluator::gradient: y", y.size(), problem_.size());
  const AddedSeconds time(counters_.gradient_seconds);
  ++counters_.gradients;
  return assemble(y, Curvature::Projected, problem_.terms(), gradient, nullptr, stop);
}

double Evaluator::gradient(TermId id, VecIn y, Vec& gradient, const StopCheck& stop) {
  require_size("Evaluator::gradient: y", y.size(), problem_.size());
  problem_.term(id);  // throws for an id that does not exist
  const AddedSeconds time(counters_.gradient_seconds);
  ++counters_.gradients;
  return assemble(y, Curvature::Projected, {&id, 1}, gradient, nullptr, stop);
}

Eigen::SparseMatrix<double> Evaluator::hessian(VecIn y, BlendedCurvature curvature,
                                               const StopCheck& stop) {
  Vec gradient, values;
  linearize(y, curvature, gradient, values, stop);
  const SparsePattern& pattern = problem_.pattern();
  const Eigen::Map<const Eigen::SparseMatrix<double>> lower(
      pattern.size, pattern.size, pattern.nonzeros(), pattern.column_starts.data(),
      pattern.rows.data(), values.data());
  return lower.selfadjointView<Eigen::Lower>();
}

std::optional<Evaluator::Violation> Evaluator::violation(VecIn x) {
  require_size("Evaluator::violation: x", x.size(), problem_.full_size());
  for (const auto& checker : problem_.checkers()) {
    Verdict verdict = checker->check(x);
    add_counts(counters_.proven, verdict.proven);
    verdict.feasible = partition_of(problem_).all(verdict.feasible);
    if (!verdict.feasible) return Violation{checker.get(), std::move(verdict)};
  }
  return std::nullopt;
}

double Evaluator::assemble(VecIn y, BlendedCurvature curvature, std::span<const TermId> terms,
                           Vec& gradient, Vec* hessian_values, const StopCheck& stop) {
  require_no_stop("Evaluator: the stop check", stop, partition_of(problem_));
  ProblemParts::elimination(problem_).expand(y, x_);
  gradient.setZero(problem_.size());
  while (scratch_.size() < to_size(ThreadCount::current()))
    scratch_.push_back(std::make_unique<Scratch>());
  double total = 0;
  std::vector<double> energies;
  for (const TermId k : terms) {
    assemble_term(k, curvature, gradient, hessian_values, stop, energies);
    for (const double e : energies) total += e;
  }
  partition_of(problem_).add_to_owners(gradient);
  return partition_of(problem_).sum(total);
}

void Evaluator::assemble_term(TermId k, BlendedCurvature curvature, Vec& gradient,
                              Vec* hessian_values, const StopCheck& stop,
                              std::vector<double>& batch_energies) {
  const EnergyTerm& term = problem_.term(k);
  const TermState& state = problem_.state(k);
  const ColoredBatches& plan = ProblemParts::plan(problem_, k);
  const ScatterMap& slots = ProblemParts::slots(problem_, k);
  const auto n = to_size(term.element_dofs().local_size());
  constexpr std::size_t stride = LocalSystem::stride;
  batch_energies.assign(to_size(plan.batch_count()), 0.0);
  const std::size_t packed = hessian_values ? n * (n + 1) / 2 : 0;
  const std::size_t local_size = (1 + n + packed) * stride;
  const auto local_in = [&](double* memory) {
    LocalSystem local;
    local.value = memory;
    local.gradient = local.value + stride;
    if (hessian_values) local.hessian = local.gradient + n * stride;
    return local;
  };
  // The first share of slots also adds the gradient and the energies.
  const auto add_batch = [&](const LocalSystem& local, Index c, const ScatterMap::Slots& own,
                             bool is_first) {
    const ElementBatch batch = plan.batch(c);
    double sum = 0;
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      const double w = weight(state, e);
      if (w == 0) continue;
      sum += w * local.value[p];
      if (is_first) slots.add_gradient(e, local, static_cast<int>(p), w, gradient.data());
      if (hessian_values)
        slots.add_hessian(e, local, static_cast<int>(p), w, hessian_values->data(), own);
    }
    if (is_first) batch_energies[c] = sum;
  };
  const auto assemble_batch = [&](const EnergyTerm& from, Index c, int thread) {
    stop.poll();
    Scratch& s = *scratch_[thread];
    LocalSystem local = local_in(s.local.reserve(local_size));
    from.local(x_, plan.batch(c), curvature, state, s.kernel, local);
    add_batch(local, c, {}, true);
  };
  const int threads = threads_for(term, to_size(term.element_dofs().element_count()));
  // Computes the local systems of as many batches as fit into kWindowBytes, in pieces. Then every
  // thread reads all of them in the order of the plan and adds to its own columns.
  const auto assemble_apart = [&](const EnergyTerm& from, std::span<const Index> batches) {
    const std::size_t window = std::max<std::size_t>(1, kWindowBytes / sizeof(double) / local_size);
    for (std::size_t first = 0; first < batches.size(); first += window) {
      const auto part = batches.subspan(first, std::min(window, batches.size() - first));
      double* memory = scratch_.front()->window.reserve(part.size() * local_size);
      std::vector<Piece> pieces;
      std::vector<std::size_t> starts;  // in memory, of each piece
      for (std::size_t place = 0; place < part.size(); ++place) {
        append_pieces(part[place], plan.batch(part[place]), pieces);
        starts.resize(pieces.size(), place * local_size);
      }
      parallel_tasks(
          static_cast<Index>(pieces.size()),
          [&](Index number, int thread) {
            stop.poll();
            const Piece& piece = pieces[to_size(number)];
            LocalSystem local = local_in(memory + starts[to_size(number)] + piece.place);
            from.local(x_, piece.part, curvature, state, scratch_[thread]->kernel, local);
          },
          threads);
      const Index shares = hessian_values ? threads : 1;
      parallel_tasks(
          shares,
          [&](Index share, int) {
            const ScatterMap::Slots own = ScatterMap::share(problem_.pattern(), share, shares);
            for (std::size_t place = 0; place < part.size(); ++place)
              add_batch(local_in(memory + place * local_size), part[place], own, share == 0);
          },
          threads);
    }
  };
  const auto assemble = [&](const EnergyTerm& from, std::size_t first, std::size_t last) {
    std::vector<Index> batches;
    for (std::size_t at = first; at < last; ++at)
      batches.insert(batches.end(), plan.colours()[at].begin(), plan.colours()[at].end());
    if (threads > 1 && batches.size() < kWideColour * to_size(threads) * (last - first))
      return assemble_apart(from, batches);
    for (std::size_t at = first; at < last; ++at) {
      const std::vector<Index>& colour = plan.colours()[at];
      parallel_tasks(
          static_cast<Index>(colour.size()),
          [&](Index q, int thread) { assemble_batch(from, colour[q], thread); }, threads);
    }
  };
  const auto* joint = dynamic_cast<const JointTerm*>(&term);
  const std::size_t colours = plan.colours().size();
  if (!joint) return assemble(term, 0, colours);
  std::vector<ElementBatch> batches;
  for (std::size_t first = 0, last = 0; first < colours; first = last) {
    stop.poll();
    batches.clear();
    for (; last < colours && batches.size() < kJointBatches; ++last)
      for (const Index c : plan.colours()[last]) batches.push_back(plan.batch(c));
    assemble(*joint->computed(x_, batches, state, curvature), first, last);
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
