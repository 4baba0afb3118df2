// Linear solvers: H p = r for symmetric positive definite H of a fixed pattern.
//
//   const std::unique_ptr<DirectSolver> solver = make_direct_solver();
//   solver->analyze(problem.pattern());                             // once per pattern
//   const Vec values = Vec::Ones(problem.pattern().nonzeros());     // parallel to pattern().rows
//   Vec p;
//   if (solver->factorize(values, 0) == FactorStatus::Ok) solver->solve(y0, p);
//
// The solvers here are direct. A solver of your own implements three functions: analyze(),
// factorize(), solve(). It may be iterative: factorize() then makes a preconditioner, and solve()
// gets the tolerance that the method needs and reports the residual; docs/linear_solvers.md has an
// example. Not for indefinite or unsymmetric systems.
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

  // Appends a column with its diagonal entry and these rows below the diagonal, in any order and
  // with repetitions. Throws Error(Unsupported) if the number of entries exceeds the range of
  // Index.
  void append_column(const std::vector<Index>& rows_below);
  // Makes blocks of `block` successive unknowns.
  void order_in_blocks(Index block);

  // Returns a pattern with the entries of this pattern and of `more`, which has at least as many
  // columns and whose blocks it keeps. places: the places of this pattern's entries in the result.
  SparsePattern joined(const SparsePattern& more, std::vector<Index>& places) const;

  // Returns the place of an entry's value in arrays parallel to `rows`; the entry may be in either
  // triangle. Throws InvalidArgument for an entry that does not exist.
  Index slot(Index row, Index column) const;
  Index diagonal_slot(Index column) const { return column_starts[column]; }
};

// Throws InvalidArgument unless a pattern is as the comment of SparsePattern says and has a block
// for every unknown, with equal numbers next to each other, counted from 0.
void require_valid(const SparsePattern& pattern);

enum class FactorStatus { Ok, NotPositiveDefinite };

enum class SolveStatus {
  Solved,        // to the given tolerance; a direct solver: to rounding
  NotConverged,  // p is the best found; used as it is if it points downhill
  Indefinite,    // p . H p <= 0 was met: treated as a failed factorize(); p is ignored
};

struct Solution {
  SolveStatus status = SolveStatus::Solved;
  double residual = 0;  // the final |H p - r| / |r|; 0 if not measured (direct solvers)
  int iterations = 0;   // 0: direct
};

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  // Chooses an ordering and allocates. `pattern` must outlive the solver's use of it.
  virtual void analyze(const SparsePattern& pattern) = 0;
  // The near null space of the matrices that follow, such as the translations of a map: one vector
  // a column, on the unknowns of the next analysis. Algebraic multigrid converges faster with it;
  // other solvers ignore it.
  virtual void hint_near_null_space(Eigen::MatrixXd /*vectors*/) {}
  // Factorizes H + shift * I; `values`, parallel to pattern.rows, may be gone before solve().
  virtual FactorStatus factorize(const Vec& values, double shift) = 0;
  // Computes p with |H p - r| <= tolerance |r|, H with its shift; only after factorize() returned
  // Ok. tolerance: in [0, 1); 0 requests the accuracy of rounding. Direct solvers ignore it.
  virtual Solution solve(const Vec& r, Vec& p, double tolerance = 0) = 0;
  // Returns the bytes that factorize() will allocate for the factor and its computation, known
  // after the analysis and before any allocation; 0: unknown.
  virtual std::size_t bytes() const { return 0; }
  // Returns the choices of the analysis, for reports: "supernodal, METIS, 1.2e6 nonzeros".
  virtual std::string description() const { return "a solver of the program's own"; }
  // Does factorize() and polls `stop` between pieces of the work. After Stopped, factorize() must
  // come before the next solve(). The default implementation does not poll while it factorizes.
  virtual FactorStatus factorize_until(const StopCheck& stop, const Vec& values, double shift);
};

// Makes a solver, or returns one that successive minimizers share, because it knows the last
// ordering. A minimizer calls it once. May be empty for minimizers with a solver of their own.
using SolverFactory = std::function<std::shared_ptr<LinearSolver>()>;

// Automatic: the ordering that costs least over the ten or more factorizations of a Newton run.
// Amd: found faster, for one or two factorizations. Dissection: for surfaces, about as good as
// Metis in a fifth of its time.
enum class Ordering { Automatic, Amd, Metis, Dissection };

// The ordering of a pattern and the structure of its factor.
class PatternAnalysis;

// From this size of a factor on (a map of 300,000 faces), unused memory goes back to the system.
// Mapping it again takes a hundredth of the factorization.
inline constexpr std::size_t kLargeFactor = std::size_t(256) << 20;

// The options of a direct solver.
struct DirectSolverOptions {
  Ordering ordering = Ordering::Automatic;
  // An existing analysis of the first pattern with this ordering. The solver uses it if it fits,
  // and makes its own otherwise. May be null.
  std::shared_ptr<PatternAnalysis> analysis = {};
  int threads = 0;  // 0: as many as the caller of analyze() has (parallel.h)
  std::size_t large_factor = kLargeFactor;  // bytes
};

// A solver with a factor L L^T of the matrix. Right-hand sides with few entries cost less than
// whole solves.
class DirectSolver : public LinearSolver {
 public:
  // A column with few entries: unknowns, ascending, and values.
  using SparseColumn = std::vector<std::pair<Index, double>>;
  // Returns R^T (H + shift I)^-1 R for a matrix R with `size` rows and these columns; only after
  // factorize() returned Ok. It costs half a solve for each column, less if the column has few
  // entries. Throws Stopped.
  virtual Eigen::MatrixXd inverse_products(Index size, const std::vector<SparseColumn>& columns,
                                           const StopCheck& stop = {}) = 0;
  // Returns the entries of solve(r, p) at these unknowns, equal to the last bit, for an r of `size`
  // entries with few nonzeros. It costs two paths through the factor.
  virtual Vec solution_entries(Index size, const SparseColumn& r,
                               const std::vector<Index>& unknowns) = 0;
};

// Makes the multifrontal Cholesky solver [DR83] of this library, with the orderings of AMD and
// METIS and the widest vector instructions of the machine. Results are the same, bit for bit, for
// any number of threads, and on machines with AVX2 and AVX-512. Needs no BLAS. Every member throws
// std::bad_alloc when it runs out of memory.
std::unique_ptr<DirectSolver> make_direct_solver(const DirectSolverOptions& options = {});

// Makes the solver of a run (SolveOptions::linear_solver). Its arguments are the pattern to be
// factorized, so that it can choose by size (bytes() of a solver that has analysed the pattern),
// and the options for make_direct_solver().
using PatternSolverFactory = std::function<std::shared_ptr<LinearSolver>(
    const SparsePattern& pattern, const DirectSolverOptions& options)>;

// Returns the instruction set that the direct solver and the kernels of built-in energies use on
// this machine: "AVX-512", "AVX2" or "baseline".
std::string_view vector_instructions();

// Makes Eigen's simplicial L D L^T with the AMD ordering, on one thread: header-only, without BLAS.
// It is the reference of the tests. Not for large matrices, where make_direct_solver() is several
// times faster.
std::unique_ptr<LinearSolver> make_eigen_ldlt_solver();

// Returns the mean of |H_ii|; values are parallel to pattern.rows.
double mean_diagonal(const SparsePattern& pattern, const Vec& values);

// The first shift of a matrix that is not positive definite, relative to the mean diagonal: 100
// unit roundoffs, the error of the factorization of a singular matrix. It suits Newton's method,
// whose next matrix is another one; callers that keep their matrix use a larger shift.
inline constexpr double kSmallestShift = 1e-14;

// The tolerance of solves with a matrix that is used many times as a metric: the square root of the
// unit roundoff. A metric has to be the same operator every time.
inline constexpr double kPreconditionerTolerance = 1e-8;

struct ShiftedFactorization {
  FactorStatus status = FactorStatus::NotPositiveDefinite;
  double shift = 0;        // the last one
  int factorizations = 0;  // attempts
  int failed() const { return factorizations - (status == FactorStatus::Ok ? 1 : 0); }
};
// Factorizes H + shift * I with the first of the shifts 0, a m, 10 a m, 100 a m, ..., 1e22 a m that
// makes it positive definite; a = smallest_shift, m is the mean of |H_ii|. `solver` has analysed
// `pattern`; values are parallel to pattern.rows. The status is NotPositiveDefinite if a diagonal
// entry is not finite. Polls before every factorization and throws Stopped.
ShiftedFactorization factorize_shifted(LinearSolver& solver, const SparsePattern& pattern,
                                       const Vec& values, double smallest_shift = kSmallestShift,
                                       const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
