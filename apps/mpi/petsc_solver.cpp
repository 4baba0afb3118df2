#include "apps/mpi/petsc_solver.h"

#include <fmt/format.h>
#include <petscksp.h>
#include <petscmat.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "apps/mpi/internal/petsc_call.h"
#include "majorant/framework/error.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/partition.h"

namespace majorant {
namespace {

// A matrix factorized by MUMPS, on all ranks.
//
//     MumpsFactor factor(matrix.mat());      // analysed once a pattern
//     if (factor.factorize() == FactorStatus::Ok) factor.solve(r, p);

class MumpsFactor {
 public:
  explicit MumpsFactor(_p_Mat* matrix);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  // Factorizes the current values of the matrix. Inertia decides whether it is definite, not a
  // Cholesky variant. Throws Error(Unsupported) if MUMPS fails, or runs out of memory.
  FactorStatus factorize();
  void solve(_p_Vec* r, _p_Vec* p) const;

 private:
  _p_Mat *matrix_, *factor_ = nullptr;
  bool analysed_ = false;
};

// Per cent of memory beyond MUMPS' estimate. Its default of 20 assumes that few pivots are delayed.
// Chosen, not tuned.
constexpr PetscInt kMoreMemory = 60;

// MAT_SPD stays unset: with a matrix declared definite (SYM = 1) MUMPS would not report negative
// pivots.
MumpsFactor::MumpsFactor(Mat matrix) : matrix_(matrix) {
  require_petsc(MatGetFactor(matrix_, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor_));
  require_petsc(MatMumpsSetIcntl(factor_, 13, 1));  // factorize the root on one rank, so that its
                                                    // pivots are counted
  require_petsc(MatMumpsSetIcntl(factor_, 14, kMoreMemory));
  require_petsc(MatMumpsSetIcntl(factor_, 24, 1));  // count pivots that vanish
}

MumpsFactor::~MumpsFactor() { MatDestroy(&factor_); }

FactorStatus MumpsFactor::factorize() {
  MatFactorInfo info;
  require_petsc(MatFactorInfoInitialize(&info));
  if (!analysed_) {
    IS rows = nullptr, columns = nullptr;
    require_petsc(MatGetOrdering(matrix_, MATORDERINGEXTERNAL, &rows, &columns));
    require_petsc(MatCholeskyFactorSymbolic(factor_, matrix_, rows, &info));
    ISDestroy(&rows);
    ISDestroy(&columns);
    analysed_ = true;
  }
  require_petsc(MatCholeskyFactorNumeric(factor_, matrix_, &info));
  MatFactorError error = MAT_FACTOR_NOERROR;
  require_petsc(MatFactorGetError(factor_, &error));
  if (error == MAT_FACTOR_OUTMEMORY)
    throw Error(ErrorKind::Unsupported,
                "MUMPS has not enough memory for the factor; use more ranks, or cg-hypre");
  if (error != MAT_FACTOR_NOERROR) return FactorStatus::NotPositiveDefinite;
  PetscInt negative = 0, zero = 0, positive = 0;
  require_petsc(MatGetInertia(factor_, &negative, &zero, &positive));
  return negative == 0 && zero == 0 ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite;
}

void MumpsFactor::solve(::Vec r, ::Vec p) const { require_petsc(MatSolve(factor_, r, p)); }

// The sum of the ranks' matrices as a matrix of PETSc, which is assembled repeatedly on one
// pattern.
//
//     PetscMatrix matrix(pattern, partition);
//     matrix.set(values, shift);
//     matrix.to_petsc(r, matrix.right_hand_side());

class PetscMatrix {
 public:
  // Both arguments must outlive the matrix.
  PetscMatrix(const SparsePattern& pattern, const Partition& partition);
  ~PetscMatrix();
  PetscMatrix(const PetscMatrix&) = delete;
  PetscMatrix& operator=(const PetscMatrix&) = delete;

  // Sets H + shift I; values parallel to pattern.rows.
  void set(const Vec& values, double shift);

  _p_Mat* mat() const { return mat_; }
  _p_Vec* right_hand_side() const { return r_; }
  _p_Vec* solution() const { return p_; }
  // Copies the owned entries to PETSc; and back, with copies filled in.
  void to_petsc(const Vec& from, _p_Vec* to) const;
  void from_petsc(_p_Vec* from, Vec& to) const;

 private:
  const SparsePattern& pattern_;
  const Partition& partition_;
  _p_Mat* mat_ = nullptr;
  _p_Vec *r_ = nullptr, *p_ = nullptr;
  std::vector<double> entries_;  // scratch
};

PetscInt petsc_index(GlobalIndex i) { return static_cast<PetscInt>(i); }

// Returns the unknowns of a node if all nodes of all ranks have the same number (u and v of a map;
// a node that is held on a line has fewer), else 1. Collective.
PetscInt block_size(const SparsePattern& pattern, const Partition& partition) {
  Index most = 1;
  for (Index i = 0, first = 0; i < pattern.size; ++i) {
    if (pattern.block_of[i] != pattern.block_of[first]) first = i;
    most = std::max(most, i - first + 1);
  }
  most = static_cast<Index>(partition.ranks().max(most));
  bool regular = pattern.size % most == 0;
  for (Index i = 0; i < pattern.size && regular; ++i)
    regular = pattern.block_of[i] == i / most && partition.owns(i) == partition.owns(i - i % most);
  return partition.ranks().all(regular) ? most : 1;
}

PetscMatrix::PetscMatrix(const SparsePattern& pattern, const Partition& partition)
    : pattern_(pattern), partition_(partition) {
  if (partition.global_size() > std::numeric_limits<PetscInt>::max())
    throw Error(ErrorKind::Unsupported,
                "the problem has more unknowns than the integers of this PETSc count; use a PETSc "
                "with 64-bit integers (petsc64-dev)");
  if (2 * pattern.rows.size() > static_cast<std::size_t>(std::numeric_limits<PetscInt>::max()))
    throw Error(ErrorKind::Unsupported,
                "the matrix of a rank has more entries than the integers of this PETSc count; use "
                "more ranks, or a PETSc with 64-bit integers (petsc64-dev)");
  // Both triangles are listed by entry of the pattern. PETSc adds entries at the same place, also
  // from other ranks.
  std::vector<PetscInt> rows, columns;
  rows.reserve(2 * pattern.rows.size());
  columns.reserve(2 * pattern.rows.size());
  const auto add = [&](Index row, Index column) {
    rows.push_back(petsc_index(partition.global(row)));
    columns.push_back(petsc_index(partition.global(column)));
  };
  for (Index c = 0; c < pattern.size; ++c)
    for (Index k = pattern.column_starts[c]; k < pattern.column_starts[c + 1]; ++k) {
      const Index r = pattern.rows[k];
      add(r, c);
      if (r != c) add(c, r);
    }
  const PetscInt owned = partition.owned_size(), all = petsc_index(partition.global_size());
  require_petsc(MatCreate(PETSC_COMM_WORLD, &mat_));
  require_petsc(MatSetSizes(mat_, owned, owned, all, all));
  // Multigrid then keeps u and v apart. Coarsening both together takes 53 instead of 6 conjugate
  // gradient iterations to 1e-2 (bench/linear_solvers.py).
  require_petsc(MatSetBlockSize(mat_, block_size(pattern, partition)));
  require_petsc(MatSetType(mat_, MATAIJ));
  require_petsc(MatSetPreallocationCOO(mat_, static_cast<PetscCount>(rows.size()), rows.data(),
                                       columns.data()));
  require_petsc(MatSetOption(mat_, MAT_SYMMETRIC, PETSC_TRUE));
  require_petsc(MatSetOption(mat_, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  require_petsc(MatCreateVecs(mat_, &p_, &r_));
}

PetscMatrix::~PetscMatrix() {
  VecDestroy(&p_);
  VecDestroy(&r_);
  MatDestroy(&mat_);
}

void PetscMatrix::set(const Vec& values, double shift) {
  entries_.clear();
  for (Index c = 0; c < pattern_.size; ++c)
    for (Index k = pattern_.column_starts[c]; k < pattern_.column_starts[c + 1]; ++k) {
      entries_.push_back(values[k]);
      if (pattern_.rows[k] != c) entries_.push_back(values[k]);
    }
  require_petsc(MatSetValuesCOO(mat_, entries_.data(), INSERT_VALUES));
  if (shift != 0) require_petsc(MatShift(mat_, shift));
}

void PetscMatrix::to_petsc(const Vec& from, ::Vec to) const {
  PetscScalar* entries = nullptr;
  require_petsc(VecGetArrayWrite(to, &entries));
  for (Index i = 0; i < partition_.size(); ++i)
    if (partition_.owns(i)) *entries++ = from[i];
  require_petsc(VecRestoreArrayWrite(to, nullptr));
}

void PetscMatrix::from_petsc(::Vec from, Vec& to) const {
  const PetscScalar* entries = nullptr;
  require_petsc(VecGetArrayRead(from, &entries));
  to.setZero(partition_.size());
  const PetscScalar* entry = entries;
  for (Index i = 0; i < partition_.size(); ++i)
    if (partition_.owns(i)) to[i] = *entry++;
  require_petsc(VecRestoreArrayRead(from, &entries));
  partition_.copy_from_owners(to);
}

// The tolerance of conjugate gradients if the caller wants the full accuracy; they reach it on
// Tutte's systems.
constexpr double kAllThereIs = 1e-12;
// Limits of iterations with multigrid and with ICC, about ten times what convergent solves take.
// Chosen, not tuned.
constexpr PetscInt kMaxIterationsWithMultigrid = 300, kMaxIterationsWithIcc = 2000;
// After a failure, this many matrices begin with the method that solved. A start with collapsed
// triangles improves within 5 to 15 steps.
constexpr int kPatience = 5;

std::size_t place(PetscMethod method) { return static_cast<std::size_t>(method); }

class ConjugateGradients {
 public:
  ConjugateGradients(PetscMethod method, Mat matrix, MatNullSpace near_null_space) {
    require_petsc(KSPCreate(PETSC_COMM_WORLD, &ksp_));
    require_petsc(KSPSetType(ksp_, KSPCG));
    require_petsc(KSPSetNormType(ksp_, KSP_NORM_UNPRECONDITIONED));
    require_petsc(KSPSetOperators(ksp_, matrix, matrix));
    if (near_null_space) require_petsc(MatSetNearNullSpace(matrix, near_null_space));
    PC pc = nullptr;
    require_petsc(KSPGetPC(ksp_, &pc));
    if (method == PetscMethod::Amg) {
      require_petsc(PCSetType(pc, PCHYPRE));
      require_petsc(PCHYPRESetType(pc, "boomeramg"));
      require_petsc(KSPSetOptionsPrefix(ksp_, "majorant_hypre_"));
    } else if (method == PetscMethod::Gamg) {
      require_petsc(PCSetType(pc, PCGAMG));
      require_petsc(KSPSetOptionsPrefix(ksp_, "majorant_gamg_"));
    } else {
      require_petsc(PCSetType(pc, PCBJACOBI));
      require_petsc(KSPSetOptionsPrefix(ksp_, "majorant_icc_"));
    }
    most_ = method == PetscMethod::Icc ? kMaxIterationsWithIcc : kMaxIterationsWithMultigrid;
    require_petsc(KSPSetFromOptions(ksp_));
    const char* prefix = nullptr;
    require_petsc(KSPGetOptionsPrefix(ksp_, &prefix));
    require_petsc(PetscOptionsGetReal(nullptr, prefix, "-ksp_rtol", &largest_tolerance_, nullptr));
  }
  ~ConjugateGradients() { KSPDestroy(&ksp_); }
  ConjugateGradients(const ConjugateGradients&) = delete;
  ConjugateGradients& operator=(const ConjugateGradients&) = delete;

  // Returns false if the preconditioner cannot be made.
  bool set_up() {
    if (KSPSetUp(ksp_) != 0) return false;
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    require_petsc(KSPGetConvergedReason(ksp_, &reason));
    return reason != KSP_DIVERGED_PC_FAILED;
  }

  // Returns the status of the solve; none for a failure of the method rather than of the matrix.
  std::optional<SolveStatus> solve(::Vec r, ::Vec p, double tolerance, Solution& solution) {
    require_petsc(
        KSPSetTolerances(ksp_, std::min(tolerance, largest_tolerance_), 0, PETSC_DEFAULT, most_));
    if (KSPSolve(ksp_, r, p) != 0) return {};
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    PetscReal residual = 0, size = 0;
    require_petsc(KSPGetConvergedReason(ksp_, &reason));
    require_petsc(KSPGetIterationNumber(ksp_, &iterations));
    require_petsc(KSPGetResidualNorm(ksp_, &residual));
    require_petsc(VecNorm(r, NORM_2, &size));
    solution.iterations += static_cast<int>(iterations);
    solution.residual = size > 0 ? residual / size : 0;
    if (reason > 0) return SolveStatus::Solved;
    if (reason == KSP_DIVERGED_INDEFINITE_MAT) return SolveStatus::Indefinite;
    return {};
  }

 private:
  KSP ksp_ = nullptr;
  PetscInt most_;
  PetscReal largest_tolerance_ = 1;  // upper bound from the options
};

class FallbackChain final : public SharedSolver {
 public:
  FallbackChain(const FallbackOptions& options, std::shared_ptr<FallbackRecord> record)
      : options_(options), record_(std::move(record)) {}
  ~FallbackChain() override {
    leave();
    MatNullSpaceDestroy(&near_null_space_);
  }

  void analyze(const SparsePattern& pattern) override {
    whole_ = Partition(pattern.size);
    analyze_shared(pattern, whole_);
  }

  void analyze_shared(const SparsePattern& pattern, const Partition& partition) override {
    leave();
    mumps_.reset();
    matrix_.reset();
    partition_ = &partition;
    matrix_ = std::make_unique<PetscMatrix>(pattern, partition);
    first_ = partition.global_size() < options_.direct_below ? PetscMethod::Mumps : options_.first;
    method_ = first_;
    patience_ = 0;
    take_hint();
  }

  void hint_near_null_space(Eigen::MatrixXd vectors) override { hint_ = std::move(vectors); }

  FactorStatus factorize(const Vec& values, double shift) override {
    leave();
    matrix_->set(values, shift);
    if (patience_ > 0) --patience_;
    method_ = patience_ > 0 ? held_ : first_;
    negative_ = false;
    const FactorStatus status = prepare();
    if (status != FactorStatus::Ok) ++record_->indefinite;
    return status;
  }

  Solution solve(const Vec& r, Vec& p, double tolerance) override {
    Solution solution;
    matrix_->to_petsc(r, matrix_->right_hand_side());
    for (;;) {
      const std::optional<SolveStatus> status = solve_here(tolerance, solution);
      if (status) {
        solution.status = *status;
        break;
      }
      if (prepare() != FactorStatus::Ok) {
        solution.status = SolveStatus::Indefinite;
        break;
      }
    }
    matrix_->from_petsc(matrix_->solution(), p);
    // Rounding may hide negative pivots, and conjugate gradients may miss directions of negative
    // curvature.
    if (solution.status == SolveStatus::Solved && !(partition_->dot(r, p) >= 0))
      solution.status = SolveStatus::Indefinite;
    if (solution.status == SolveStatus::Indefinite) ++record_->indefinite;
    return solution;
  }

  std::string description() const override {
    return fmt::format("PETSc, {}", kPetscMethodNames[place(method_)]);
  }

 private:
  FallbackRecord::Use& use() { return record_->methods[place(method_)]; }

  void leave() {
    gradients_.reset();
    is_ready_ = false;
  }

  void fall() {
    ++use().falls;
    leave();
    method_ = method_ == PetscMethod::Icc ? PetscMethod::Mumps : PetscMethod::Icc;
    held_ = method_;
    patience_ = kPatience;
  }

  // Prepares this method, or the next one that can be prepared.
  FactorStatus prepare() {
    for (;; fall()) {
      ++use().set_ups;
      if (method_ == PetscMethod::Mumps) {
        if (!mumps_) mumps_ = std::make_unique<MumpsFactor>(matrix_->mat());
        is_ready_ = mumps_->factorize() == FactorStatus::Ok;
        return is_ready_ ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite;
      }
      gradients_ = std::make_unique<ConjugateGradients>(
          method_, matrix_->mat(), method_ == PetscMethod::Gamg ? near_null_space_ : nullptr);
      is_ready_ = gradients_->set_up();
      if (is_ready_) return FactorStatus::Ok;
    }
  }

  // Returns none if this method failed; the next one must then be prepared.
  std::optional<SolveStatus> solve_here(double tolerance, Solution& solution) {
    ++use().solves;
    if (method_ == PetscMethod::Mumps) {
      mumps_->solve(matrix_->right_hand_side(), matrix_->solution());
      return SolveStatus::Solved;
    }
    const int before = solution.iterations;
    const std::optional<SolveStatus> status =
        gradients_->solve(matrix_->right_hand_side(), matrix_->solution(),
                          std::max(tolerance, kAllThereIs), solution);
    use().iterations += solution.iterations - before;
    use().most_iterations = std::max(use().most_iterations, solution.iterations - before);
    if (status == SolveStatus::Solved) return status;
    if (status == SolveStatus::Indefinite && std::exchange(negative_, true)) return status;
    fall();
    return {};
  }

  void take_hint() {
    MatNullSpaceDestroy(&near_null_space_);
    if (hint_.cols() == 0 || hint_.rows() != partition_->size()) return;
    std::vector<::Vec> vectors(static_cast<std::size_t>(hint_.cols()));
    for (std::size_t k = 0; k < vectors.size(); ++k) {
      require_petsc(VecDuplicate(matrix_->solution(), &vectors[k]));
      matrix_->to_petsc(hint_.col(static_cast<Eigen::Index>(k)), vectors[k]);
      for (std::size_t j = 0; j < k; ++j) {
        PetscScalar part = 0;
        require_petsc(VecDot(vectors[k], vectors[j], &part));
        require_petsc(VecAXPY(vectors[k], -part, vectors[j]));
      }
      require_petsc(VecNormalize(vectors[k], nullptr));
    }
    require_petsc(MatNullSpaceCreate(PETSC_COMM_WORLD, PETSC_FALSE,
                                     static_cast<PetscInt>(vectors.size()), vectors.data(),
                                     &near_null_space_));
    for (::Vec& v : vectors) VecDestroy(&v);
  }

  FallbackOptions options_;
  std::shared_ptr<FallbackRecord> record_;
  Partition whole_;
  const Partition* partition_ = nullptr;
  std::unique_ptr<PetscMatrix> matrix_;
  std::unique_ptr<MumpsFactor> mumps_;
  std::unique_ptr<ConjugateGradients> gradients_;
  Eigen::MatrixXd hint_;
  MatNullSpace near_null_space_ = nullptr;
  PetscMethod first_ = PetscMethod::Amg, method_ = PetscMethod::Amg, held_ = PetscMethod::Amg;
  int patience_ = 0;
  bool is_ready_ = false, negative_ = false;
};

}  // namespace

SolverFactory petsc_solver(const FallbackOptions& options, std::shared_ptr<FallbackRecord> record) {
  return [=] { return std::make_unique<FallbackChain>(options, record); };
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
