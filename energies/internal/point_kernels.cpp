#include "majorant/energies/internal/instruction_sets.h"
#include "majorant/energies/internal/point_densities.h"
#include "majorant/framework/error.h"
#include "majorant/framework/packed_symmetric.h"

namespace majorant {

DensityKernels point_kernels_baseline(int index);
#ifdef MAJORANT_X86_KERNELS
DensityKernels point_kernels_avx2(int index);
DensityKernels point_kernels_avx512(int index);
#endif

namespace {

DensityKernels point_kernels(int index) {
#ifdef MAJORANT_X86_KERNELS
  const InstructionSet set = widest_instruction_set();
  if (set == InstructionSet::Avx512) return point_kernels_avx512(index);
  if (set == InstructionSet::Avx2) return point_kernels_avx2(index);
#endif
  return point_kernels_baseline(index);
}

template <int N>
void clamp_blocks(int count, double clamp, double* k) {
  constexpr int kPacked = N * (N + 1) / 2, kLanes = PointBatch::kMost;
  for (int p = 0; p < count; ++p) {
    double one[kPacked];
    for (int r = 0; r < kPacked; ++r) one[r] = k[r * kLanes + p];
    make_semidefinite<N>(clamp, one);
    for (int r = 0; r < kPacked; ++r) k[r * kLanes + p] = one[r];
  }
}

}  // namespace

void clamp_packed_blocks(int n, int count, double clamp, double* k) {
  switch (n) {
    case 1:
      return clamp_blocks<1>(count, clamp, k);
    case 2:
      return clamp_blocks<2>(count, clamp, k);
    case 3:
      return clamp_blocks<3>(count, clamp, k);
    case 4:
      return clamp_blocks<4>(count, clamp, k);
    case 6:
      return clamp_blocks<6>(count, clamp, k);
    default:
      return clamp_blocks<9>(count, clamp, k);
  }
}

DensityKernels jacobian_kernels(int rows, int dims) {
  if (rows < 1 || rows > 3 || dims < 1 || dims > 3)
    throw InvalidArgument("jacobian_kernels: a Jacobian has 1 to 3 rows and columns");
  return point_kernels(3 * (rows - 1) + dims - 1);
}

DensityKernels invariant_kernels() { return point_kernels(9); }

}  // namespace majorant
