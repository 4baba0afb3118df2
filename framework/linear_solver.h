// Linear solvers: H p = r for symmetric positive definite H of a fixed pattern.
//
//   const std::unique_ptr<DirectSolver> solver = make_direct_solver();
//   solver->analyze(problem.pattern());                             // once per pattern
//   const Vec values = Vec::Ones(problem.pattern().nonzeros());     // parallel to pattern().rows
//   Vec p;
//   if (solver->factorize(values, 0) == FactorStatus::Ok) solver->solve(y0, p);
//
// The solvers here are direct. One of your own is three functions: analyze(), factorize(), solve().
// It may be iterative: factorize() makes a preconditioner, and solve() gets the tolerance that the
// method needs and says what it reached; docs/linear_solvers.md has one. Not for indefinite or
// unsymmetric systems.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"

namespace majorant {

// The fixed sparsity pattern of a symmetric matrix: lower triangle, compressed columns, row numbers
// sorted within a column, every diagonal entry present.
//
//   SparsePattern pattern;                  // of  [ 2 -1  . ]
//   pattern.append_column({1});             //     [-1  2 -1 ]
//   pattern.append_column({2});             //     [ . -1  2 ]
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   Vec values = Vec::Zero(pattern.nonzeros());
//   values[pattern.slot(0, 1)] = -1;        // the same as slot(1, 0)

struct SparsePattern {
  Index size = 0;
  std::vector<Index> column_starts = {0};  // size + 1
  std::vector<Index> rows;                 // nonzeros
  std::vector<Index> block_of;             // size: unknowns with equal numbers are ordered together
  Index nonzeros() const { return static_cast<Index>(rows.size()); }

  // Makes the next column, which gets its diagonal entry and these: rows below the diagonal, in any
  // order, some maybe several times. Throws Error(Unsupported) where entries become more than an
  // Index counts.
  void append_column(const std::vector<Index>& rows_below);
  // Unknowns 0 .. block - 1 belong together, the next so many, and so on.
  void order_in_blocks(Index block);

  // The entries of this pattern and of `more`, which has as many columns or more, and the latter's
  // blocks. places: where this pattern's entries are in the result.
  SparsePattern joined(const SparsePattern& more, std::vector<Index>& places) const;

  // The place of an entry's value in arrays parallel to `rows`; the entry may be of either
  // triangle. Throws InvalidArgument for an entry that is not there.
  Index slot(Index row, Index column) const;
  Index diagonal_slot(Index column) const { return column_starts[column]; }
};

// Throws InvalidArgument unless a pattern is what the comment of SparsePattern says, with a block
// for every unknown, equal numbers next to each other, counted from 0.
void require_valid(const SparsePattern& pattern);

enum class FactorStatus { Ok, NotPositiveDefinite };

enum class SolveStatus {
  Solved,        // to the tolerance asked for, or as well as rounding lets a direct solver
  NotConverged,  // p is the best there is: taken as it is where it points downhill
  Indefinite,    // p . H p <= 0 was met: as if factorize() had failed, p is not looked at
};

struct Solution {
  SolveStatus status = SolveStatus::Solved;
  double residual = 0;  // |H p - r| / |r| that was reached; 0 where nobody looked: direct solvers
  int iterations = 0;   // 0: direct
};

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  // Chooses an ordering and allocates. `pattern` must outlive the solver's use of it.
  virtual void analyze(const SparsePattern& pattern) = 0;
  // The near null space of the matrices to come (the translations of a map, say), one vector a
  // column, on the unknowns of the next analysis. Algebraic multigrid converges sooner for it;
  // other solvers ignore it.
  virtual void hint_near_null_space(Eigen::MatrixXd /*vectors*/) {}
  // Factorizes H + shift * I; `values`, parallel to pattern.rows, may be gone before solve().
  virtual FactorStatus factorize(const Vec& values, double shift) = 0;
  // p with |H p - r| <= tolerance |r|, H with its shift; only after factorize() returned Ok.
  // tolerance: in [0, 1); 0 asks for all that rounding leaves. Direct solvers do not look at it.
  virtual Solution solve(const Vec& r, Vec& p, double tolerance = 0) = 0;
  // Memory that factorize() is going to allocate for the factor and its making, known after the
  // analysis, before any of it is taken; 0: not known.
  virtual std::size_t bytes() const { return 0; }
  // The choices of the analysis, for reports: "supernodal, METIS, 1.2e6 nonzeros".
  virtual std::string description() const { return "a solver of the program's own"; }
  // factorize() that polls `stop` between pieces of the work: Stopped, and factorize() comes again
  // before the next solve(). Solvers that cannot end on the way do not ask.
  virtual FactorStatus factorize_until(const StopCheck& stop, const Vec& values, double shift);
};

// Makes a solver, or hands out one that is kept for minimizers that follow each other: it knows the
// last one's ordering. Minimizers call it once. May be empty where they have one of their own.
using SolverFactory = std::function<std::shared_ptr<LinearSolver>()>;

// Automatic: what costs least over the factorizations of a Newton run, ten and more. Amd: cheaper
// to find, for one or two. Dissection: of surfaces, about as good as Metis in a fifth of its time.
enum class Ordering { Automatic, Amd, Metis, Dissection };

// The ordering of a pattern and the structure of its factor.
class PatternAnalysis;

// The bytes of a factor from which on memory that only waits goes back to the system: of a map of
// 300,000 faces. To have it mapped again takes a hundredth of the factorization.
inline constexpr std::size_t kLargeFactor = std::size_t(256) << 20;

// All that a direct solver is given when it is made.
struct DirectSolverOptions {
  Ordering ordering = Ordering::Automatic;
  // An analysis of the first pattern, by this ordering, that is there already. The solver takes it
  // if it fits, and makes its own otherwise. May be null.
  std::shared_ptr<PatternAnalysis> analysis = {};
  int threads = 0;  // 0: as many as the caller of analyze() has (parallel.h)
  std::size_t large_factor = kLargeFactor;  // bytes
};

// A solver that has a factor L L^T of the matrix. For right-hand sides of few entries it does less
// than whole solves.
class DirectSolver : public LinearSolver {
 public:
  // A column with few entries: unknowns, ascending, and values.
  using SparseColumn = std::vector<std::pair<Index, double>>;
  // R^T (H + shift I)^-1 R for the `size` unknowns' rows and these columns of R; only after
  // factorize() returned Ok. Half a solve for each column, and less where it has few entries.
  // Throws Stopped.
  virtual Eigen::MatrixXd inverse_products(Index size, const std::vector<SparseColumn>& columns,
                                           const StopCheck& stop = {}) = 0;
  // The entries of solve(r, p) at these unknowns, to the last bit, for an r of `size` entries that
  // is 0 but at a few unknowns: for what two paths through the factor cost.
  virtual Vec solution_entries(Index size, const SparseColumn& r,
                               const std::vector<Index>& unknowns) = 0;
};

// Multifrontal Cholesky [DR83] of this library, on the orderings of AMD and METIS, in the widest
// vector instructions of the machine. The same bits for any number of threads, and on machines with
// AVX2 and AVX-512. Needs no BLAS. Every member throws std::bad_alloc when it runs out of memory.
std::unique_ptr<DirectSolver> make_direct_solver(const DirectSolverOptions& options = {});

// Makes the solver of a run, as SolveOptions::linear_solver. It is given the pattern to be
// factorized, so that it can choose by size (bytes() of a solver that has analysed the pattern),
// and what make_direct_solver() would be given.
using PatternSolverFactory = std::function<std::shared_ptr<LinearSolver>(
    const SparsePattern& pattern, const DirectSolverOptions& options)>;

// The instruction set that the direct solver and the kernels of built-in energies use on this
// machine: "AVX-512", "AVX2" or "baseline".
std::string_view vector_instructions();

// Eigen's simplicial L D L^T with the AMD ordering, on one thread: header-only, no BLAS, the oracle
// of the tests. Not for large matrices, where the supernodal factorization is several times faster.
std::unique_ptr<LinearSolver> make_eigen_ldlt_solver();

// Mean of |H_ii|; values parallel to pattern.rows.
double mean_diagonal(const SparsePattern& pattern, const Vec& values);

// The first shift, of the mean diagonal, where a matrix is not positive definite: 100 unit
// roundoffs, what the factorization of a singular matrix may be off; Newton's next matrix is
// another one. Where the matrix stays, callers say why theirs is larger.
inline constexpr double kSmallestShift = 1e-14;

// Residual asked for where one matrix serves many solves as a metric, which has to be the same
// operator every time: the square root of the unit roundoff.
inline constexpr double kPreconditionerTolerance = 1e-8;

struct ShiftedFactorization {
  FactorStatus status = FactorStatus::NotPositiveDefinite;
  double shift = 0;        // the last one tried
  int factorizations = 0;  // tried
  int failed() const { return factorizations - (status == FactorStatus::Ok ? 1 : 0); }
};
// Factorizes H + shift * I with the first of the shifts 0, a m, 10 a m, 100 a m, ..., 1e22 a m that
// makes it positive definite, a = smallest_shift, m the mean of |H_ii|. `solver` has analysed
// `pattern`; values parallel to pattern.rows. Diagonals that are not finite are
// NotPositiveDefinite. Polls before every factorization: Stopped.
ShiftedFactorization factorize_shifted(LinearSolver& solver, const SparsePattern& pattern,
                                       const Vec& values, double smallest_shift = kSmallestShift,
                                       const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
