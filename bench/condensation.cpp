// Static condensation, measured: control points inside of faces are eliminated face by face, eight
// faces at a time, and the sparse factorization gets the Schur complement of the others, instead
// of all.
//
// For each mesh and degree, on one thread, seconds of the processor, both ways in turn, the least
// of
// --repeat each; Hessians projected after --steps Newton steps from the optimum of degree 1:
//
//     unknowns, inner       all, and those whose neighbours are the nodes of one face
//     analysis              milliseconds of all unknowns : of the Schur complement (what the faces
//                           themselves need is not counted)
//     factorization         of all unknowns : with condensation, of which
//     condensing, complement    the faces (copying the other entries included), the complement
//     solve                 of all unknowns : with condensation
//     ratio                 factorization and solve of all unknowns over those with condensation
//     bound                 factorization of all unknowns over that of the complement alone: what
//                           condensing at no cost would gain
//     difference            of the two solutions, relative
//
// --ordering: automatic takes METIS from 75,000 control points on, which the complement may be
// below; amd, metis: for both.
//
// Sample run:
//   build/release/bench/majorant_condensation ../shared/data/public/disks/*_2500.obj --degrees 3,4
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench_problem.h"
#include "condensation_kernels.h"
#include "majorant/framework/evaluator.h"
#include "majorant/framework/internal/problem_parts.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/thread_count.h"
#include "unit_fe.h"

using namespace majorant;
using condensation::kLanes;

namespace {

// What the faces of a problem are eliminated with. Unknowns are those of the problem, -1: fixed.
class Faces {
 public:
  Faces(const Problem& problem, const Cells& cells) : count_(static_cast<Index>(cells.rows())) {
    std::vector<Index> uses(at(problem.full_size()), 0);
    for (Index e = 0; e < count_; ++e)
      for (const Index node : cells.row(e)) ++uses[at(node)];
    std::vector<Eigen::Index> inner, outer;  // of the nodes of a face
    for (Eigen::Index k = 0; k < cells.cols(); ++k) {
      bool is_inner = true;
      for (Index e = 0; e < count_; ++e) is_inner = is_inner && uses[at(cells(e, k))] == 1;
      (is_inner ? inner : outer).push_back(k);
    }
    inner_ = 2 * static_cast<int>(inner.size());
    outer_ = 2 * static_cast<int>(outer.size());
    const Elimination& elimination = ProblemParts::elimination(problem);
    for (Index first = 0; first < count_; first += kLanes)
      for (const auto* nodes : {&inner, &outer})
        for (const Eigen::Index k : *nodes)
          for (int c = 0; c < 2; ++c)
            for (Index l = 0; l < kLanes; ++l) {
              const Index x = 2 * cells(std::min(first + l, count_ - 1), k) + c;
              const bool is_free = elimination.begin(x) != elimination.end(x);
              unknowns_.push_back(is_free ? elimination.begin(x)->reduced : -1);
            }
  }

  Index groups() const { return (count_ + kLanes - 1) / kLanes; }
  int count(Index group) const { return std::min<Index>(kLanes, count_ - kLanes * group); }
  int inner() const { return inner_; }
  int outer() const { return outer_; }
  // By unknown of a face, inner ones first, kLanes each.
  const Index* unknowns(Index group) const { return &unknowns_[at(group * kLanes * rows())]; }
  int rows() const { return inner_ + outer_; }

 private:
  Index count_;
  int inner_ = 0, outer_ = 0;
  std::vector<Index> unknowns_;
};

class CondensingSolver {
 public:
  CondensingSolver(const SparsePattern& pattern, const Faces& faces, Ordering ordering)
      : faces_(faces), number_(at(pattern.size), 0), solver_(make_direct_solver(ordering)) {
    for (Index g = 0; g < faces.groups(); ++g)
      for (int k = 0; k < kLanes * faces.inner(); ++k) number_[at(faces.unknowns(g)[k])] = -1;
    for (Index c = 0; c < pattern.size; ++c)
      if (number_[at(c)] == 0) {
        number_[at(c)] = static_cast<Index>(kept_.size());
        kept_.push_back(c);
      }
    make_complement(pattern);
    for (Index g = 0; g < faces.groups(); ++g) place(pattern, g);
    panels_.resize(at(faces.groups() * kLanes * faces.inner() * faces.rows()));
  }

  double inner_share() const { return 1 - static_cast<double>(kept_.size()) / number_.size(); }
  void analyze() { solver_->analyze(complement_); }

  bool condense(const Vec& values) {
    complement_values_.resize(complement_.nonzeros());
    for (std::size_t k = 0; k < sources_.size(); ++k)
      complement_values_[static_cast<Index>(k)] = values[sources_[k]];
    const int entries = kLanes * faces_.inner() * faces_.rows();
    const int targets = kLanes * condensation::packed(faces_.outer());
    for (Index g = 0; g < faces_.groups(); ++g) {
      double* panel = &panels_[at(g) * at(entries)];
      const Index* slots = &slots_[at(g) * at(entries)];
      for (int k = 0; k < entries; ++k) panel[k] = slots[k] < 0 ? 0 : values[slots[k]];
      if (!condensation::eliminate(faces_.inner(), faces_.outer(), faces_.count(g), panel,
                                   &targets_[at(g) * at(targets)], complement_values_.data()))
        return false;
    }
    return true;
  }
  FactorStatus factorize_complement() { return solver_->factorize(complement_values_, 0); }

  void solve(const Vec& r, Vec& p) {
    const int inner = kLanes * faces_.inner(), rows = kLanes * faces_.rows();
    Vec right = r, reduced(static_cast<Index>(kept_.size())), part;
    forward_.resize(at(faces_.groups() * inner));
    outer_.resize(at(rows - inner));
    for (Index g = 0; g < faces_.groups(); ++g) {
      const Index* unknowns = faces_.unknowns(g);
      double* x = &forward_[at(g * inner)];
      for (int k = 0; k < inner; ++k) x[k] = r[unknowns[k]];
      condensation::forward(faces_.inner(), faces_.outer(), panel(g), x, outer_.data());
      for (int k = inner; k < rows; ++k)
        if (unknowns[k] >= 0 && k % kLanes < faces_.count(g))
          right[unknowns[k]] -= outer_[at(k - inner)];
    }
    for (std::size_t k = 0; k < kept_.size(); ++k) reduced[static_cast<Index>(k)] = right[kept_[k]];
    solver_->solve(reduced, part);
    p.resize(r.size());
    for (std::size_t k = 0; k < kept_.size(); ++k) p[kept_[k]] = part[static_cast<Index>(k)];
    for (Index g = 0; g < faces_.groups(); ++g) {
      const Index* unknowns = faces_.unknowns(g);
      double* x = &forward_[at(g * inner)];
      for (int k = inner; k < rows; ++k)
        outer_[at(k - inner)] = unknowns[k] < 0 ? 0 : p[unknowns[k]];
      condensation::backward(faces_.inner(), faces_.outer(), panel(g), x, outer_.data());
      for (int k = 0; k < inner; ++k) p[unknowns[k]] = x[k];
    }
  }

 private:
  const double* panel(Index g) const {
    return &panels_[at(g * kLanes * faces_.inner() * faces_.rows())];
  }

  void make_complement(const SparsePattern& pattern) {
    Index last = -1, block = -1;
    std::vector<Index> below;
    for (const Index c : kept_) {
      below.clear();
      for (Index k = pattern.column_starts[at(c)]; k < pattern.column_starts[at(c) + 1]; ++k)
        if (const Index row = number_[at(pattern.rows[at(k)])]; row >= 0) {
          sources_.push_back(k);
          if (pattern.rows[at(k)] != c) below.push_back(row);
        }
      complement_.append_column(below);
      if (std::exchange(last, pattern.block_of[at(c)]) != pattern.block_of[at(c)]) ++block;
      complement_.block_of.push_back(block);
    }
  }

  // Where entries of the panels are, and what they change.
  void place(const SparsePattern& pattern, Index g) {
    const Index* unknowns = faces_.unknowns(g);
    const auto unknown = [&](int k, int lane) { return unknowns[kLanes * k + lane]; };
    for (int c = 0; c < faces_.rows(); ++c)
      for (int r = c < faces_.inner() ? 0 : c; r < faces_.rows(); ++r)
        for (int l = 0; l < kLanes; ++l) {
          const Index row = unknown(r, l), column = unknown(c, l);
          const bool is_fixed = row < 0 || column < 0;
          if (c < faces_.inner())
            slots_.push_back(is_fixed ? -1 : pattern.slot(row, column));
          else
            targets_.push_back(is_fixed ? 0  // anywhere: what goes off it is 0
                                        : complement_.slot(number_[at(row)], number_[at(column)]));
        }
  }

  const Faces& faces_;
  std::vector<Index> number_, kept_, sources_, slots_, targets_;
  SparsePattern complement_;
  std::vector<double> panels_, forward_, outer_;
  Vec complement_values_;
  std::unique_ptr<LinearSolver> solver_;
};

// Milliseconds, the least so far.
class Least {
 public:
  template <class F>
  void time(const F& f) {
    const double started = cpu_seconds();
    f();
    ms_ = std::min(ms_, 1e3 * (cpu_seconds() - started));
  }
  operator double() const { return ms_; }

 private:
  double ms_ = std::numeric_limits<double>::infinity();
};

void require(bool ok) {
  if (!ok) throw std::runtime_error("not positive definite");
}

struct Arguments {
  std::vector<std::string> meshes;
  std::vector<int> degrees{3, 4};
  int steps = 3, repeat = 7;
  Ordering ordering = Ordering::Automatic;
};

void compare(const std::string& mesh, int degree, const Arguments& asked) {
  const BenchProblem b(mesh, degree);
  StoppingRules stopping;
  stopping.max_iterations = asked.steps;
  NewtonOptions options;
  options.stopping = stopping;
  const Vec y = NewtonMinimizer(options).minimize(b.problem, b.problem.reduce(b.x), {}).y;
  Evaluator evaluator(b.problem);
  const SparsePattern& pattern = b.problem.pattern();
  Vec g, h, p, q;
  evaluator.linearize(y, Curvature::Projected, g, h);
  const auto direct = make_direct_solver(asked.ordering);
  const Faces faces(b.problem, b.space->cells());
  CondensingSolver condensing(pattern, faces, asked.ordering);
  Least analysis[2], factorization, solve[2], condense, complement;
  for (int k = 0; k < asked.repeat; ++k) {
    analysis[0].time([&] { direct->analyze(pattern); });
    analysis[1].time([&] { condensing.analyze(); });
    for (int again = 0; again < 2; ++again) {  // the first one allocates
      factorization.time([&] { require(direct->factorize(h, 0) == FactorStatus::Ok); });
      condense.time([&] { require(condensing.condense(h)); });
      complement.time([&] { require(condensing.factorize_complement() == FactorStatus::Ok); });
      solve[0].time([&] { direct->solve(g, p); });
      solve[1].time([&] { condensing.solve(g, q); });
    }
  }
  fmt::print(
      "| {} | {} | {} | {:.2f} | {:.1f} : {:.1f} | {:.1f} : {:.1f} | {:.1f} | {:.1f} | "
      "{:.1f} : {:.1f} | {:.2f} | {:.2f} | {:.0e} |\n",
      mesh.substr(mesh.rfind('/') + 1), degree, b.problem.size(), condensing.inner_share(),
      +analysis[0], +analysis[1], +factorization, condense + complement, +condense, +complement,
      +solve[0], +solve[1], (factorization + solve[0]) / (condense + complement + solve[1]),
      factorization / complement, (p - q).norm() / p.norm());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Static condensation of control points inside of faces");
  Arguments asked;
  const std::map<std::string, Ordering> orderings{
      {"automatic", Ordering::Automatic}, {"amd", Ordering::Amd}, {"metis", Ordering::Metis}};
  app.add_option("meshes", asked.meshes)->required();
  app.add_option("--degrees", asked.degrees, "from 3 on")->delimiter(',');
  app.add_option("--steps", asked.steps)->check(CLI::NonNegativeNumber);
  app.add_option("--repeat", asked.repeat)->check(CLI::PositiveNumber);
  app.add_option("--ordering", asked.ordering)->transform(CLI::CheckedTransformer(orderings));
  CLI11_PARSE(app, argc, argv);
  const ThreadCount one(1);
  fmt::print(
      "| mesh | degree | unknowns | inner | analysis | factorization | condensing | complement | "
      "solve | ratio | bound | difference |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& mesh : asked.meshes)
    for (const int degree : asked.degrees) compare(mesh, degree, asked);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
