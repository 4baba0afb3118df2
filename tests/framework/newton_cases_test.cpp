// Newton's method on the cases of all minimizers, with each linear solver.
#include "framework/minimizer_cases.h"
#include "majorant/framework/newton.h"

namespace majorant {

template <Curvature curvature>
struct NewtonTraits {
  static constexpr bool kCertifiesPaths = true;
  static std::unique_ptr<Minimizer> make(int max_iterations) {
    NewtonOptions o;
    o.curvature = curvature;
    if (curvature == Curvature::Exact) o.linear_solver = make_eigen_ldlt_solver;
    o.stopping.max_iterations = max_iterations;
    return std::make_unique<NewtonMinimizer>(o);
  }
};

namespace test {
using NewtonKinds =
    testing::Types<NewtonTraits<Curvature::Projected>, NewtonTraits<Curvature::Exact>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Newton, MinimizerCases, NewtonKinds);
}  // namespace test

}  // namespace majorant
