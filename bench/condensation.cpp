// Static condensation, measured: control points inside of faces are eliminated face by face,
// densely, and the sparse factorization gets the Schur complement of the others, instead of all.
//
// For each mesh and degree, on one thread, medians of --repeat in seconds of the processor,
// Hessians projected at the optimum of degree 1, the library's default solver for both:
//
//     condensed_share    of the unknowns: those whose neighbours are the nodes of one face
//     analysis, factorization, solve    milliseconds of all unknowns : with condensation
//     alone              milliseconds that factorizing the Schur complement takes of the latter
//     ratio              factorization and solve of all unknowns over those with condensation
//     bound              factorization of all unknowns over that of the Schur complement alone: what
//                        condensing at no cost would gain
//     difference         of the two solutions, relative
//
// Sample run:
//   build/release/bench/majorant_condensation --degrees 3,4,5 ../shared/data/public/disks/*_2500.obj
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench_problem.h"
#include "majorant/framework/evaluator.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/thread_count.h"
#include "unit_fe.h"

using namespace majorant;

namespace {

// Unknowns with the same neighbours, which are all neighbours of each other: `inner` is eliminated.
struct Clique {
  std::vector<Index> inner, outer;    // unknowns
  std::vector<Index> inner_slots;     // (r, c) of inner x inner, by columns
  std::vector<Index> coupling_slots;  // (r, c) of inner x outer, by columns
  std::vector<Index> target_slots;    // of the Schur complement: lower triangle of outer x outer
};

std::vector<std::vector<Index>> neighbours(const SparsePattern& pattern) {
  std::vector<std::vector<Index>> all(at(pattern.size));
  for (Index c = 0; c < pattern.size; ++c)
    for (Index k = pattern.column_starts[at(c)]; k < pattern.column_starts[at(c) + 1]; ++k) {
      all[at(c)].push_back(pattern.rows[at(k)]);
      if (pattern.rows[at(k)] != c) all[at(pattern.rows[at(k)])].push_back(c);
    }
  for (auto& list : all) std::sort(list.begin(), list.end());
  return all;
}

// Of `size` unknowns each.
std::vector<Clique> find_cliques(const SparsePattern& pattern, std::size_t size) {
  const auto all = neighbours(pattern);
  std::map<std::vector<Index>, std::vector<Index>> groups;
  for (Index c = 0; c < pattern.size; ++c)
    if (all[at(c)].size() == size) groups[all[at(c)]].push_back(c);
  std::vector<Clique> cliques;
  for (const auto& [nodes, inner] : groups) {
    Clique clique{inner, {}, {}, {}, {}};
    std::set_difference(nodes.begin(), nodes.end(), inner.begin(), inner.end(),
                        std::back_inserter(clique.outer));
    for (const Index c : inner)
      for (const Index r : inner) clique.inner_slots.push_back(pattern.slot(r, c));
    for (const Index c : clique.outer)
      for (const Index r : inner) clique.coupling_slots.push_back(pattern.slot(r, c));
    cliques.push_back(std::move(clique));
  }
  return cliques;
}

class CondensingSolver final : public LinearSolver {
 public:
  // nodes: of a face.
  explicit CondensingSolver(std::size_t unknowns_of_face) : face_(unknowns_of_face) {}

  void analyze(const SparsePattern& pattern) override {
    size_ = pattern.size;
    cliques_ = find_cliques(pattern, face_);
    number_.assign(at(pattern.size), 0);
    for (const Clique& clique : cliques_)
      for (const Index i : clique.inner) number_[at(i)] = -1;
    kept_.clear();
    for (Index c = 0; c < pattern.size; ++c)
      if (number_[at(c)] == 0) {
        number_[at(c)] = static_cast<Index>(kept_.size());
        kept_.push_back(c);
      }
    schur_ = SparsePattern();
    sources_.clear();
    for (const Index c : kept_) {
      std::vector<Index> below;
      for (Index k = pattern.column_starts[at(c)]; k < pattern.column_starts[at(c) + 1]; ++k)
        if (const Index row = number_[at(pattern.rows[at(k)])]; row >= 0) {
          sources_.push_back(k);
          if (pattern.rows[at(k)] != c) below.push_back(row);
        }
      schur_.append_column(below);
      schur_.block_of.push_back(pattern.block_of[at(c)]);
    }
    renumber_blocks();
    for (Clique& clique : cliques_)
      for (std::size_t c = 0; c < clique.outer.size(); ++c)
        for (std::size_t r = c; r < clique.outer.size(); ++r)
          clique.target_slots.push_back(
              schur_.slot(number_[at(clique.outer[r])], number_[at(clique.outer[c])]));
    solver_->analyze(schur_);
  }

  FactorStatus factorize(const Vec& values, double) override {
    Vec schur(schur_.nonzeros());
    for (std::size_t k = 0; k < sources_.size(); ++k)
      schur[static_cast<Index>(k)] = values[sources_[k]];
    factors_.resize(cliques_.size());
    for (std::size_t q = 0; q < cliques_.size(); ++q) {
      const Clique& clique = cliques_[q];
      const auto inner = static_cast<Index>(clique.inner.size());
      const auto outer = static_cast<Index>(clique.outer.size());
      Factor& f = factors_[q];
      f.root.resize(inner, inner);
      for (Index k = 0; k < inner * inner; ++k)
        f.root.data()[k] = values[clique.inner_slots[at(k)]];
      f.coupling.resize(inner, outer);
      for (Index k = 0; k < inner * outer; ++k)
        f.coupling.data()[k] = values[clique.coupling_slots[at(k)]];
      Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> root(f.root);
      if (root.info() != Eigen::Success) return FactorStatus::NotPositiveDefinite;
      f.root.triangularView<Eigen::Lower>().solveInPlace(f.coupling);
      update_.setZero(outer, outer);
      update_.selfadjointView<Eigen::Lower>().rankUpdate(f.coupling.transpose());
      for (Index c = 0, k = 0; c < outer; ++c)
        for (Index r = c; r < outer; ++r, ++k) schur[clique.target_slots[at(k)]] -= update_(r, c);
    }
    schur_values_ = schur;
    return factorize_complement();
  }
  FactorStatus factorize_complement() { return solver_->factorize(schur_values_, 0); }

  Solution solve(const Vec& r, Vec& p, double) override {
    Vec right = r, reduced(static_cast<Index>(kept_.size())), part;
    std::vector<Vec> forward(cliques_.size());
    for (std::size_t q = 0; q < cliques_.size(); ++q) {
      const Clique& clique = cliques_[q];
      Vec& z = forward[q] = r(clique.inner);
      factors_[q].root.triangularView<Eigen::Lower>().solveInPlace(z);
      right(clique.outer) -= factors_[q].coupling.transpose() * z;
    }
    for (std::size_t k = 0; k < kept_.size(); ++k) reduced[static_cast<Index>(k)] = right[kept_[k]];
    const Solution solution = solver_->solve(reduced, part);
    p.resize(size_);
    for (std::size_t k = 0; k < kept_.size(); ++k) p[kept_[k]] = part[static_cast<Index>(k)];
    for (std::size_t q = 0; q < cliques_.size(); ++q) {
      Vec z = forward[q] - factors_[q].coupling * p(cliques_[q].outer);
      factors_[q].root.transpose().triangularView<Eigen::Upper>().solveInPlace(z);
      p(cliques_[q].inner) = z;
    }
    return solution;
  }
  std::string description() const override { return "condensed, " + solver_->description(); }
  double share() const { return 1 - static_cast<double>(kept_.size()) / size_; }

 private:
  struct Factor {
    Eigen::MatrixXd root, coupling;
  };

  // Blocks are numbered from 0 without gaps.
  void renumber_blocks() {
    Index block = -1, last = -1;
    for (Index& b : schur_.block_of) {
      if (b != last) ++block;
      last = std::exchange(b, block);
    }
  }

  std::size_t face_;
  Index size_ = 0;
  std::vector<Clique> cliques_;
  std::vector<Index> number_, kept_, sources_;
  SparsePattern schur_;
  std::vector<Factor> factors_;
  Eigen::MatrixXd update_;
  Vec schur_values_;
  std::unique_ptr<LinearSolver> solver_ = make_direct_solver();
};

struct Milliseconds {
  double analysis, factorization, solve;
};

template <class F>
double median(int repeat, const F& f) {
  std::vector<double> seconds;
  for (int k = 0; k < repeat; ++k) {
    const double started = cpu_seconds();
    f();
    seconds.push_back(cpu_seconds() - started);
  }
  std::sort(seconds.begin(), seconds.end());
  return 1e3 * seconds[seconds.size() / 2];
}

Milliseconds measure(LinearSolver& solver, const SparsePattern& pattern, const Vec& h, const Vec& g,
                     int repeat, Vec& p) {
  Milliseconds ms{};
  ms.analysis = median(repeat, [&] { solver.analyze(pattern); });
  if (solver.factorize(h, 0) != FactorStatus::Ok) throw std::runtime_error("not positive definite");
  ms.factorization = median(repeat, [&] { solver.factorize(h, 0); });
  ms.solve = median(repeat, [&] { solver.solve(g, p, 0); });
  return ms;
}

void compare(const std::string& mesh, int degree, int repeat) {
  const BenchProblem b(mesh, degree);
  Evaluator evaluator(b.problem);
  Vec g, h, p, q;
  evaluator.linearize(b.problem.reduce(b.x), Curvature::Projected, g, h);
  const auto direct = make_direct_solver();
  CondensingSolver condensing(2 * static_cast<std::size_t>(b.space->cells().cols()));
  const Milliseconds all = measure(*direct, b.problem.pattern(), h, g, repeat, p);
  const Milliseconds less = measure(condensing, b.problem.pattern(), h, g, repeat, q);
  const double alone = median(repeat, [&] { condensing.factorize_complement(); });
  fmt::print(
      "| {} | {} | {} | {:.2f} | {:.0f} : {:.0f} | {:.1f} : {:.1f} | {:.1f} | {:.1f} : {:.1f} | "
      "{:.2f} | {:.2f} | {:.0e} |\n",
      mesh.substr(mesh.rfind('/') + 1), degree, b.problem.size(), condensing.share(), all.analysis,
      less.analysis, all.factorization, less.factorization, alone, all.solve, less.solve,
      (all.factorization + all.solve) / (less.factorization + less.solve),
      all.factorization / alone, (p - q).norm() / p.norm());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Static condensation of control points inside of faces");
  std::vector<std::string> meshes;
  std::vector<int> degrees{3, 4};
  int repeat = 7;
  app.add_option("meshes", meshes)->required();
  app.add_option("--degrees", degrees)->delimiter(',');
  app.add_option("--repeat", repeat);
  CLI11_PARSE(app, argc, argv);
  const ThreadCount one(1);
  fmt::print(
      "| mesh | degree | unknowns | condensed_share | analysis | factorization | alone | "
      "solve | ratio | bound | difference |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& mesh : meshes)
    for (const int degree : degrees) compare(mesh, degree, repeat);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
