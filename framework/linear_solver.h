// Direct solution of H p = r for symmetric positive definite H of a fixed pattern.
//
// Analyse once per pattern, factorize once per matrix, solve as often as needed.
#pragma once

#include <memory>
#include <string>

#include "majorant/framework/sparse_pattern.h"
#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"

namespace majorant {

enum class FactorStatus { Ok, NotPositiveDefinite };

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  // Chooses an ordering and allocates. `pattern` must outlive the solver's use of it.
  virtual void analyze(const SparsePattern& pattern) = 0;
  // Factorizes H + shift * I; `values` parallel to pattern.rows.
  virtual FactorStatus factorize(const Vec& values, double shift) = 0;
  // p = H^-1 r; only after factorize() returned Ok.
  virtual void solve(const Vec& r, Vec& p) = 0;
  // What the analysis chose, for reports: "supernodal, METIS, 1.2e6 nonzeros".
  virtual std::string description() const = 0;
};

enum class Factorization { Automatic, Supernodal, Simplicial };
enum class Ordering { Best, Amd, Metis };  // Best: the one with fewer operations

// CHOLMOD [CDHR08], on one thread. Every member throws std::bad_alloc when it runs out of memory.
// OpenBLAS below it has one number of threads for the whole process: the first factorization of the
// process sets it to 1, under a lock, and nothing here changes it again. A program that raises it
// afterwards pays with time, and with bits that may depend on it.
std::unique_ptr<LinearSolver> make_cholmod_solver(
    Factorization factorization = Factorization::Automatic, Ordering ordering = Ordering::Best);

// Eigen's simplicial L D L^T with the AMD ordering, on one thread: header-only, no BLAS, the oracle
// of the tests. Not for large matrices, where the supernodal factorization is several times faster.
std::unique_ptr<LinearSolver> make_eigen_ldlt_solver();

// Mean of |H_ii|; values parallel to pattern.rows.
double mean_diagonal(const SparsePattern& pattern, const Vec& values);

// The first shift, of the mean diagonal, where a matrix is not positive definite. Origin: 100 unit
// roundoffs, what the factorization of a singular matrix may be off; Newton's next matrix is
// another one. Where the matrix stays, callers say why theirs is larger.
inline constexpr double kSmallestShift = 1e-14;

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
