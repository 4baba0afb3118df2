// The numerical half of a multifrontal Cholesky factorization [DR83]: P H P^T = L L^T, front by
// front. A front adds up what its children leave to it and its own entries of H, eliminates its
// columns, and leaves an update to its parent.
//
//   MultifrontalFactor factor(tree);
//   if (factor.factorize(values, 0.0)) factor.solve(r, p);
//
// With several threads (thread_count.h, those of the constructor's caller) subtrees are worked on
// at the same time, and large fronts in parts. Every number comes from the same operations in the
// same order whatever the number of threads.
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/internal/front_kernels.h"
#include "majorant/framework/internal/front_tree.h"

namespace majorant {

class MultifrontalFactor {
 public:
  // tree outlives this.
  explicit MultifrontalFactor(const FrontTree& tree, const FrontKernels& kernels = front_kernels());

  // H + shift * I; values parallel to the pattern's rows. False: not positive definite.
  bool factorize(const Vec& values, double shift);
  void solve(const Vec& r, Vec& p);

 private:
  using Storage = std::unique_ptr<double[]>;
  bool factorize_front(Index f, const Vec& values, double shift, double* packed);
  void take_in_entries(Index f, const Vec& values, double shift);
  void take_in_child(Index child);
  double* panel(Index f) { return panels_.get() + tree_.fronts()[at(f)].panel; }
  double* update(Index f) { return updates_.get() + update_places_[at(f)]; }
  std::size_t place_updates();

  const FrontTree& tree_;
  const FrontKernels& kernels_;
  Index largest_stride_ = 0;
  std::vector<std::size_t> update_places_;
  Storage panels_, updates_, packed_;
  Vec permuted_, front_values_;
};

}  // namespace majorant
