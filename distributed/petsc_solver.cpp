#include "distributed/petsc_solver.h"

#include <fmt/format.h>
#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "distributed/internal/mumps_factor.h"
#include "distributed/internal/petsc_call.h"
#include "distributed/internal/petsc_matrix.h"

namespace majorant {
namespace {

// Asked of conjugate gradients where a caller wants all that rounding leaves: what they
// reach on Tutte's systems.
constexpr double kAllThereIs = 1e-12;
// Iterations of a solve with multigrid, and without: ten times what solves that converge
// take (176 in 25 steps, docs/distributed.md); CG + ICC took 68 where multigrid broke down.
constexpr PetscInt kMostWithMultigrid = 300, kMostWithIcc = 2000;
// Matrices that begin on the rung that held, after a fall: a start of collapsed triangles
// takes 5 to 15 steps until they are not.
constexpr int kPatience = 5;

std::size_t place(Rung rung) { return static_cast<std::size_t>(rung); }

class ConjugateGradients {
 public:
  ConjugateGradients(Rung rung, Mat matrix, MatNullSpace near_null_space) {
    require_petsc(KSPCreate(PETSC_COMM_WORLD, &ksp_));
    require_petsc(KSPSetType(ksp_, KSPCG));
    require_petsc(KSPSetNormType(ksp_, KSP_NORM_UNPRECONDITIONED));
    require_petsc(KSPSetOperators(ksp_, matrix, matrix));
    if (near_null_space) require_petsc(MatSetNearNullSpace(matrix, near_null_space));
    PC pc = nullptr;
    require_petsc(KSPGetPC(ksp_, &pc));
    if (rung == Rung::Amg) {
      require_petsc(PCSetType(pc, PCHYPRE));
      require_petsc(PCHYPRESetType(pc, "boomeramg"));
      require_petsc(KSPSetOptionsPrefix(ksp_, "majorant_hypre_"));
    } else if (rung == Rung::Gamg) {
      require_petsc(PCSetType(pc, PCGAMG));
      require_petsc(KSPSetOptionsPrefix(ksp_, "majorant_gamg_"));
    } else {
      require_petsc(PCSetType(pc, PCBJACOBI));
      require_petsc(KSPSetOptionsPrefix(ksp_, "majorant_icc_"));
    }
    most_ = rung == Rung::Icc ? kMostWithIcc : kMostWithMultigrid;
    require_petsc(KSPSetFromOptions(ksp_));
    const char* prefix = nullptr;
    require_petsc(KSPGetOptionsPrefix(ksp_, &prefix));
    require_petsc(PetscOptionsGetReal(nullptr, prefix, "-ksp_rtol", &largest_tolerance_, nullptr));
  }
  ~ConjugateGradients() { KSPDestroy(&ksp_); }
  ConjugateGradients(const ConjugateGradients&) = delete;
  ConjugateGradients& operator=(const ConjugateGradients&) = delete;

  // False: the preconditioner cannot be made.
  bool set_up() {
    if (KSPSetUp(ksp_) != 0) return false;
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    require_petsc(KSPGetConvergedReason(ksp_, &reason));
    return reason != KSP_DIVERGED_PC_FAILED;
  }

  // What became of it; none: a failure of the method, not of the matrix.
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
  PetscReal largest_tolerance_ = 1;  // of the options: never less accurate than that
};

class Ladder final : public LinearSolver {
 public:
  Ladder(const LadderOptions& options, std::shared_ptr<LadderRecord> record)
      : options_(options), record_(std::move(record)) {}
  ~Ladder() override {
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
    first_ = partition.global_size() < options_.direct_below ? Rung::Mumps : options_.first;
    rung_ = first_;
    patience_ = 0;
    take_hint();
  }

  void hint_near_null_space(Eigen::MatrixXd vectors) override { hint_ = std::move(vectors); }

  FactorStatus factorize(const Vec& values, double shift) override {
    leave();
    matrix_->set(values, shift);
    if (patience_ > 0) --patience_;
    rung_ = patience_ > 0 ? held_ : first_;
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
    // Negative pivots may hide behind rounding, and negative curvature behind where nobody looked.
    if (solution.status == SolveStatus::Solved && !(partition_->dot(r, p) >= 0))
      solution.status = SolveStatus::Indefinite;
    if (solution.status == SolveStatus::Indefinite) ++record_->indefinite;
    return solution;
  }

  std::string description() const override {
    return fmt::format("PETSc, {}", kRungNames[place(rung_)]);
  }

 private:
  LadderRecord::Use& use() { return record_->rungs[place(rung_)]; }

  void leave() {
    gradients_.reset();
    is_ready_ = false;
  }

  void fall() {
    ++use().falls;
    leave();
    rung_ = rung_ == Rung::Icc ? Rung::Mumps : Rung::Icc;
    held_ = rung_;
    patience_ = kPatience;
  }

  // What this rung needs before it solves, or the first one below that can be made.
  FactorStatus prepare() {
    for (;; fall()) {
      ++use().set_ups;
      if (rung_ == Rung::Mumps) {
        if (!mumps_) mumps_ = std::make_unique<MumpsFactor>(matrix_->mat());
        is_ready_ = mumps_->factorize() == FactorStatus::Ok;
        return is_ready_ ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite;
      }
      gradients_ = std::make_unique<ConjugateGradients>(
          rung_, matrix_->mat(), rung_ == Rung::Gamg ? near_null_space_ : nullptr);
      is_ready_ = gradients_->set_up();
      if (is_ready_) return FactorStatus::Ok;
    }
  }

  // None: this rung failed, and the next one down is to be prepared.
  std::optional<SolveStatus> solve_here(double tolerance, Solution& solution) {
    ++use().solves;
    if (rung_ == Rung::Mumps) {
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

  LadderOptions options_;
  std::shared_ptr<LadderRecord> record_;
  Partition whole_;
  const Partition* partition_ = nullptr;
  std::unique_ptr<PetscMatrix> matrix_;
  std::unique_ptr<MumpsFactor> mumps_;
  std::unique_ptr<ConjugateGradients> gradients_;
  Eigen::MatrixXd hint_;
  MatNullSpace near_null_space_ = nullptr;
  Rung first_ = Rung::Amg, rung_ = Rung::Amg, held_ = Rung::Amg;
  int patience_ = 0;
  bool is_ready_ = false, negative_ = false;
};

}  // namespace

SolverFactory petsc_solver(const LadderOptions& options, std::shared_ptr<LadderRecord> record) {
  return [=] { return std::make_unique<Ladder>(options, record); };
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
