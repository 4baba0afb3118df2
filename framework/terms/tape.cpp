#include "majorant/framework/terms/detail/tape.h"

#include <algorithm>

#include "majorant/framework/detail/packed_symmetric.h"
#include "majorant/framework/terms/internal/tape_kernels.h"

namespace majorant::detail {
namespace {

// Sets the numbers of nodes to 0 in the lanes that did not choose them. They may be infinite there,
// and 0 times infinity would make the result NaN.
void drop_what_is_not_chosen(Tape& tape, std::int32_t result) {
  using Bits = std::uint32_t;
  std::vector<Bits> chosen(tape.nodes.size(), 0);
  const auto lanes_of = [](const Lanes& x) {
    Bits lanes = 0;
    for (int i = 0; i < kLanes; ++i) lanes |= Bits{x[i] != 0} << i;
    return lanes;
  };
  chosen[to_size(result)] = ~Bits{0};
  for (std::int32_t n = result; n >= 0; --n) {
    const TapeNode& node = tape.nodes[to_size(n)];
    const Bits lanes = chosen[to_size(n)];
    Lanes* numbers = tape.numbers.data() + node.numbers;
    const auto choose = [&](std::int32_t operand, const Lanes& number) {
      chosen[to_size(operand)] |= node.kind == TapeNode::Choice ? lanes & lanes_of(number) : lanes;
    };
    const int operands = TapeNode::operand_counts[node.kind];
    if (operands > 0) choose(node.a, numbers[0]);
    if (operands > 1) choose(node.b, numbers[1]);
    for (int i = 0; operands > 0 && i < kLanes; ++i) {
      if (lanes >> i & 1) continue;
      tape.values[to_size(n)][i] = 0;
      for (int k = 0; k < TapeNode::number_counts[node.kind]; ++k) numbers[k][i] = 0;
    }
  }
}

}  // namespace

void differentiate_tape(Tape& tape, std::int32_t result, int unknowns, int lanes,
                        std::size_t position, double projection_weight, PackedProjection projection,
                        Workspace& workspace, LocalSystem& out) {
  constexpr std::size_t stride = LocalSystem::stride;
  const std::size_t entries = to_size(unknowns * (unknowns + 1) / 2);
  const auto write = [&](const Lanes* from, std::size_t rows, double* to) {
    for (std::size_t k = 0; k < rows; ++k)
      std::copy_n(from[k].data(), lanes, to + k * stride + position);
  };
  if (result < 0) {  // a constant
    for (int k = 0; k < unknowns; ++k)
      std::fill_n(out.gradient + to_size(k) * stride + position, lanes, 0.0);
    for (std::size_t k = 0; out.hessian && k < entries; ++k)
      std::fill_n(out.hessian + k * stride + position, lanes, 0.0);
    return;
  }
  if (tape.has_choices) drop_what_is_not_chosen(tape, result);

  // The numbers come first, then the lists of integers, two of which are as large as a double.
  const auto n = to_size(unknowns), nodes = to_size(result) + 1, wide = nodes * n;
  const std::size_t clamping = std::max(entries, TapeKernels::clamp_memory(n));
  const std::size_t numbers = n + entries + clamping + nodes + wide;
  auto* memory =
      reinterpret_cast<Lanes*>(workspace.reserve(kLanes * numbers + (3 * nodes + wide + 1) / 2));
  Lanes *gradient = memory, *hessian = gradient + n, *copy = hessian + entries;
  TapeScratch scratch;
  scratch.adjoint = copy + clamping;
  scratch.derivative = scratch.adjoint + nodes;
  scratch.first = reinterpret_cast<std::int32_t*>(scratch.derivative + wide);
  scratch.list = scratch.first + nodes;
  scratch.length = scratch.list + nodes;
  scratch.unknown = scratch.length + nodes;

  const TapeKernels& kernels = tape_kernels();
  kernels.differentiate({tape.nodes.data(), tape.values.data(), tape.numbers.data(), result,
                         unknowns, tape.is_damped},
                        scratch, gradient, out.hessian ? hessian : nullptr);
  write(gradient, to_size(unknowns), out.gradient);
  if (!out.hessian) return;
  if (projection_weight > 0) {
    std::copy_n(hessian, entries, copy);
    unsigned left = kernels.indefinite(unknowns, kZeroPivot, copy);
    if (left && !projection) left = kernels.clamp(unknowns, projection_weight, left, hessian, copy);
    std::vector<double> packed(left ? entries : 0);
    for (int i = 0; i < lanes; ++i) {
      if (!(left >> i & 1)) continue;
      for (std::size_t k = 0; k < entries; ++k) packed[k] = hessian[k][i];
      if (projection)
        projection(projection_weight, packed.data());
      else
        clamp_eigenvalues(unknowns, projection_weight, packed.data());
      for (std::size_t k = 0; k < entries; ++k) hessian[k][i] = packed[k];
    }
  }
  write(hessian, entries, out.hessian);
}

}  // namespace majorant::detail

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
