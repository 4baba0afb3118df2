// The multifrontal factorization: compared with dense linear algebra on fronts of all sizes; equal
// bits with all instruction sets that have fused multiplications, and any number of threads.
#include "majorant/framework/internal/multifrontal.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <numeric>

#include "expected_error.h"
#include "framework/random_matrix.h"
#include "majorant/framework/internal/block_graph.h"
#include "majorant/framework/internal/block_ordering.h"
#include "majorant/framework/internal/symbolic_analysis.h"
#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

using test::Matrix;
using test::Random;
using test::random_matrix;

// Returns the elimination with one front of all blocks.
BlockElimination one_front(const SparsePattern& pattern) {
  const Index blocks = pattern.block_of.back() + 1;
  BlockElimination e{std::vector<Index>(to_size(blocks)), {0, blocks}, {0, to_size(blocks)}, {}};
  std::iota(e.order.begin(), e.order.end(), 0);
  e.structure = e.order;
  return e;
}

// Returns two fronts: the last `top` blocks, and below them a front that touches some of these.
BlockElimination two_fronts(const SparsePattern& pattern, Index top) {
  BlockElimination e = one_front(pattern);
  const Index blocks = e.supernode_starts.back();
  e.supernode_starts = {0, blocks - top, blocks};
  e.structure_starts = {0, to_size(blocks), to_size(blocks + top)};
  for (Index i = blocks - top; i < blocks; ++i) e.structure.push_back(i);
  return e;
}

double residual(const Matrix& m, const BlockElimination& elimination, const FrontKernels& kernels) {
  Random random(7);
  const AssemblyTree tree(m.pattern, elimination);
  MultifrontalFactor factor(tree, kernels);
  // The second factorization reuses the memory of the first.
  if (!factor.factorize(3 * m.values, 0.5) || !factor.factorize(m.values, 0.5)) return 1;
  const Vec r = random.vector(m.dense.rows());
  Vec p;
  factor.solve(r, p);
  return (m.dense * p + 0.5 * p - r).norm() / (m.dense.norm() * p.norm());
}

TEST(Multifrontal, FrontsOfAnySize) {
  Random random(1);
  for (const FrontKernels* kernels : all_front_kernels())
    for (const auto& [nodes, block] :
         {std::pair(1, 1), {7, 1}, {8, 1}, {9, 1}, {31, 2}, {64, 1}, {65, 1}, {100, 2}, {150, 2}}) {
      const Matrix m = random_matrix(random, nodes, block, 60);
      EXPECT_LE(residual(m, one_front(m.pattern), *kernels), 1e-14) << nodes << kernels->name;
      for (Index top = 1; top < nodes; top *= 3)
        EXPECT_LE(residual(m, two_fronts(m.pattern, top), *kernels), 1e-14)
            << nodes << ' ' << top << kernels->name;
    }
}

// Counts and positions of entries for factors of more than 2^31 numbers, without allocating them.
TEST(Multifrontal, CountsFrontsOf64Bits) {
  constexpr Index kSize = 80000, kBelow = 16, kColumns = kSize - kBelow;
  SparsePattern pattern;
  for (Index c = 0; c < kSize; ++c) pattern.append_column({});
  pattern.order_in_blocks(1);
  const AssemblyTree tree(pattern, two_fronts(pattern, kBelow));
  std::size_t part = 0;
  for (std::size_t above = 0; above < to_size(kColumns); above += 64)
    part += (to_size(kSize) - above) * std::min<std::size_t>(64, to_size(kColumns) - above);
  EXPECT_GT(part, std::numeric_limits<Index>::max());
  EXPECT_EQ(tree.fronts()[0].part().size(), part);
  EXPECT_EQ(tree.fronts()[1].begin, part);
  EXPECT_EQ(tree.factor_size(), part + to_size(kBelow) * kBelow);
  const AssemblyTree::Entry last = tree.entries(0).back();
  EXPECT_EQ(last.slot, kColumns - 1);
  EXPECT_EQ(last.place, part - kBelow - 1);
  // There is an update of 16 columns, and memory to pack 64 columns per thread.
  const std::size_t bytes = MultifrontalFactor(tree).bytes() / sizeof(double);
  EXPECT_GE(bytes, tree.factor_size() + to_size(kBelow) * kBelow + 64 * to_size(kSize));
  EXPECT_LE(bytes, tree.factor_size() + to_size(kBelow) * kBelow + 64 * to_size(kSize + 8) * 64);
}

// Places within a front have 32 bits. A front with more numbers is refused before memory is taken.
TEST(Multifrontal, RefusesFrontsBeyond32Bits) {
  constexpr Index kSize = 93000;
  SparsePattern pattern;
  for (Index c = 0; c < kSize; ++c) pattern.append_column({});
  pattern.order_in_blocks(1);
  const BlockElimination elimination = one_front(pattern);
  const std::string message =
      error_message(ErrorKind::Unsupported, [&] { AssemblyTree(pattern, elimination); });
  EXPECT_NE(message.find("93000 unknowns that are eliminated together"), std::string::npos)
      << message;
}

// Every number of a trapezoid has a place of its own, and no place is left but above diagonals.
TEST(Multifrontal, SlabsHaveAPlaceForEveryNumber) {
  for (const auto& [rows, columns] : {std::pair(8, 0), {8, 3}, {64, 64}, {136, 65}, {200, 200}}) {
    const ColumnSlabs shape{rows, columns};
    std::vector<int> used(shape.size(), 0);
    for (Index c = 0; c < columns; ++c)
      for (Index r = c / 64 * 64; r < rows; ++r)
        ++used[static_cast<std::size_t>(shape.column(c) + r)];
    EXPECT_EQ(std::count(used.begin(), used.end(), 1), std::ssize(used)) << rows << ' ' << columns;
    for (Index s = 0; s < shape.slabs(); ++s)
      EXPECT_EQ(shape.begin(s), shape.column(64 * s) + 64 * s);
  }
}

// Compares the last columns of such a panel, the only ones in the structure, with a small panel.
TEST(Multifrontal, AddressesPanelsWith64Bits) {
  constexpr FrontKernels::Stride kStride = 47000;
  constexpr Index kColumns = 16, kFirst = kStride - kColumns;
  const std::size_t bytes = kStride * kStride * sizeof(double);
  void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  double* const large = static_cast<double*>(memory);
  Random random(5);
  for (const FrontKernels* kernels : all_front_kernels()) {
    SCOPED_TRACE(kernels->name);
    std::vector<double> small(kColumns * kColumns, 0.0);
    for (Index c = 0; c < kColumns; ++c)
      for (Index r = 0; r < kColumns; ++r)
        large[(kFirst + c) * kStride + kFirst + r] = small[c * kColumns + r] =
            r == c ? 40 : random.uniform();
    ASSERT_TRUE(kernels->factorize(small.data(), kColumns, 0, kColumns));
    ASSERT_TRUE(kernels->factorize(large, kStride, kFirst, static_cast<Index>(kStride)));
    std::vector<double> packed(kColumns * kColumns), other(packed.size());
    kernels->pack(small.data(), kColumns, kColumns, 0, 0, kColumns, packed.data());
    kernels->pack(large, kStride, static_cast<Index>(kStride), kFirst, kFirst,
                  static_cast<Index>(kStride), other.data());
    for (Index c = 0; c < kColumns; ++c)
      for (Index r = c; r < kColumns; ++r)
        EXPECT_EQ(large[(kFirst + c) * kStride + kFirst + r], small[c * kColumns + r]);
    EXPECT_EQ(packed, other);
  }
  ::munmap(memory, bytes);
}

Vec solution(const Matrix& m, const BlockElimination& e, const FrontKernels& kernels) {
  const AssemblyTree tree(m.pattern, e);
  MultifrontalFactor factor(tree, kernels);
  EXPECT_TRUE(factor.factorize(m.values, 0));
  Vec p;
  factor.solve(Vec::Ones(m.dense.rows()), p);
  return p;
}

TEST(Multifrontal, TheSameBitsFromAllFusedInstructionSets) {
  Random random(2);
  const Matrix m = random_matrix(random, 90, 2, 60);
  const std::vector<const FrontKernels*> all = all_front_kernels();
  for (const BlockElimination& e : {one_front(m.pattern), two_fronts(m.pattern, 40)})
    for (std::size_t k = 2; k < all.size(); ++k)
      EXPECT_EQ(solution(m, e, *all[k]), solution(m, e, *all[1])) << all[k]->name;
}

// Returns the pattern of a square grid of blocks of 2 unknowns, large enough that threads share
// subtrees and large fronts.
SparsePattern grid(Index side) {
  SparsePattern pattern;
  for (Index y = 0; y < side; ++y)
    for (Index x = 0; x < side; ++x)
      for (Index c = 0; c < 2; ++c) {
        const Index block = side * y + x;
        std::vector<Index> below;
        if (c == 0) below.push_back(2 * block + 1);
        for (const Index other : {x + 1 < side ? block + 1 : -1, y + 1 < side ? block + side : -1})
          if (other >= 0) below.insert(below.end(), {2 * other, 2 * other + 1});
        pattern.append_column(below);
      }
  pattern.order_in_blocks(2);
  return pattern;
}

TEST(Multifrontal, TheSameBitsFromAnyNumberOfThreads) {
  const SparsePattern pattern = grid(150);
  Random random(3);
  Vec values = random.vector(pattern.nonzeros());
  for (Index c = 0; c < pattern.size; ++c) values[pattern.diagonal_slot(c)] += 12;
  const Vec r = random.vector(pattern.size);
  const auto solve = [&](int threads) {
    const ThreadCount count(threads);
    const auto solver = make_direct_solver({.ordering = Ordering::Amd});
    solver->analyze(pattern);
    EXPECT_EQ(solver->factorize(values, 0), FactorStatus::Ok);
    Vec p;
    solver->solve(r, p);
    return p;
  };
  const Vec alone = solve(1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(solve(threads), alone) << threads;
  values[pattern.diagonal_slot(pattern.size / 2)] = -1e9;
  for (const int threads : {1, 3}) {
    const ThreadCount count(threads);
    const auto solver = make_direct_solver({.ordering = Ordering::Amd});
    solver->analyze(pattern);
    EXPECT_EQ(solver->factorize(values, 0), FactorStatus::NotPositiveDefinite);
  }
}

// Fronts without entries are skipped; no numbers of the previous right-hand side remain.
TEST(Multifrontal, RightHandSidesWithFewEntries) {
  const ThreadCount two(2);
  const SparsePattern pattern = grid(150);
  Random random(4);
  Vec values = random.vector(pattern.nonzeros());
  for (Index c = 0; c < pattern.size; ++c) values[pattern.diagonal_slot(c)] += 12;
  const auto solver = make_direct_solver({.ordering = Ordering::Amd});
  solver->analyze(pattern);
  ASSERT_EQ(solver->factorize(values, 0), FactorStatus::Ok);
  const Vec r = random.vector(pattern.size);
  for (const Index k : {0, pattern.size / 3, pattern.size - 1}) {
    const Vec few = Vec::Unit(pattern.size, k);
    Vec p, with, without;
    solver->solve(r + few, with);
    solver->solve(r, without);
    solver->solve(few, p);
    EXPECT_LT((p - (with - without)).norm(), 1e-12) << k;
  }
}

// The memory of waiting updates: each thread has a stack for its largest task, and finished tasks
// leave only the updates of their roots.
TEST(Multifrontal, ThreadsTakeLittleMemory) {
  const SparsePattern pattern = grid(150);
  const auto bytes = [&](int threads) {
    const ThreadCount count(threads);
    const auto solver = make_direct_solver({.ordering = Ordering::Metis});
    solver->analyze(pattern);
    return static_cast<double>(solver->bytes());
  };
  const double alone = bytes(1);
  EXPECT_LT(bytes(2), 1.25 * alone);
  EXPECT_LT(bytes(4), 1.25 * alone);
}

std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

// Memory that is returned to the system loses its content, and is mapped again.
TEST(Multifrontal, LargeFactorsReturnIdleMemory) {
  const SparsePattern pattern = grid(250);
  const BlockGraph graph(pattern);
  const AssemblyTree tree(pattern, analyze_elimination(graph, nested_dissection_order(graph)));
  Random random(5);
  Vec values = random.vector(pattern.nonzeros());
  for (Index c = 0; c < pattern.size; ++c) values[pattern.diagonal_slot(c)] += 12;
  const Vec r = random.vector(pattern.size);
  std::size_t resident = 0;
  const auto solve = [&](int threads, std::size_t large) {
    const ThreadCount count(threads);
    const std::size_t before = resident_bytes();
    MultifrontalFactor factor(tree, front_kernels(), {}, large);
    EXPECT_TRUE(factor.factorize(2 * values, 0) && factor.factorize(values, 0));
    resident = resident_bytes() - before;
    Vec p;
    factor.solve(r, p);
    return p;
  };
  // The load of the machine decides which fronts wait at the same time, and so how many bytes are
  // given back.
  const Vec p = solve(2, kLargeFactor);
  const std::size_t kept = resident;
  for (const int threads : {1, 2, 8}) EXPECT_EQ(solve(threads, 0), p) << threads;
  solve(2, 0);
  EXPECT_LT(resident + 5'000'000, kept) << kept;
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
