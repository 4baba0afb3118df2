#include "majorant/framework/partition.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

class OneProcess final : public Ranks {
 public:
  int rank() const override { return 0; }
  int count() const override { return 1; }
  void sum(std::span<double>) const override {}
  void min(std::span<double>) const override {}
  void broadcast(std::span<std::byte>) const override {}
  void exchange(std::span<const Message> sent, std::span<const Message> received) const override {
    if (!sent.empty() || !received.empty())
      throw InvalidArgument("Ranks::exchange: there is one process, nobody to exchange with");
  }
};

using Neighbour = Partition::Neighbour;

}  // namespace

double Ranks::sum(double value) const {
  sum(std::span(&value, 1));
  return value;
}

double Ranks::min(double value) const {
  min(std::span(&value, 1));
  return value;
}

double Ranks::max(double value) const { return -min(-value); }

bool Ranks::all(bool value) const { return min(value ? 1.0 : 0.0) == 1; }

std::shared_ptr<const Ranks> one_process() {
  static const std::shared_ptr<const Ranks> ranks = std::make_shared<const OneProcess>();
  return ranks;
}

Partition::Partition(Index size)
    : ranks_(one_process()), size_(size), owned_(size), global_size_(size) {
  require_at_least("Partition: the number of unknowns", size, 0);
}

Partition::Partition(std::shared_ptr<const Ranks> ranks, Index size,
                     std::vector<Neighbour> neighbours)
    : ranks_(given("Partition: the ranks", std::move(ranks))),
      size_(size),
      neighbours_(std::move(neighbours)) {
  require_at_least("Partition: the number of unknowns", size, 0);
  std::sort(neighbours_.begin(), neighbours_.end(),
            [](const Neighbour& a, const Neighbour& b) { return a.rank < b.rank; });
  is_copy_.assign(to_size(size), 0);
  int last = -1;
  for (const Neighbour& n : neighbours_) {
    require_index("Partition: the rank of a neighbour", n.rank, ranks_->count());
    if (n.rank == std::exchange(last, n.rank))
      throw InvalidArgument("Partition: a rank is a neighbour twice");
    if (n.rank == ranks_->rank() && n.owned.size() != n.copies.size())
      throw InvalidArgument("Partition: of its own unknowns a rank has as many copies as it says");
    for (const Index i : n.owned) require_index("Partition: a shared unknown", i, size);
    for (const Index i : n.copies) {
      require_index("Partition: a copy", i, size);
      if (std::exchange(is_copy_[i], 1))
        throw InvalidArgument("Partition: an unknown is a copy of two others");
    }
  }
  for (const Neighbour& n : neighbours_)
    for (const Index i : n.owned)
      if (is_copy_[i]) throw InvalidArgument("Partition: a copy is no owner");
  owned_ = size - static_cast<Index>(std::count(is_copy_.begin(), is_copy_.end(), 1));
  is_whole_ = ranks_->count() == 1 && owned_ == size;
  if (is_whole_) {
    neighbours_.clear();
    is_copy_.clear();
  }
  number();
}

// 64-bit numbers are sent as doubles, which represent all integers up to 2^53.
void Partition::number() {
  if (is_whole_) {
    global_size_ = size_;
    return;
  }
  std::vector<double> counts(static_cast<std::size_t>(ranks_->count()), 0.0);
  counts[static_cast<std::size_t>(ranks_->rank())] = owned_;
  ranks_->sum(counts);
  double sum = 0;
  GlobalIndex next = 0;  // the next number of this rank
  for (std::size_t r = 0; r < counts.size(); ++r) {
    if (r == static_cast<std::size_t>(ranks_->rank())) next = static_cast<GlobalIndex>(sum);
    sum += counts[r];
  }
  global_size_ = static_cast<GlobalIndex>(sum);
  Vec numbers(size_);
  for (Index i = 0; i < size_; ++i) numbers[i] = owns(i) ? static_cast<double>(next++) : -1.0;
  copy_from_owners(numbers);
  global_.resize(to_size(size_));
  for (Index i = 0; i < size_; ++i) global_[i] = static_cast<GlobalIndex>(numbers[i]);
}

// Returns the unknowns whose values this rank sends to that neighbour.
const std::vector<Index>& Partition::sent(const Neighbour& n, Receivers to) {
  return to == Receivers::Copies ? n.owned : n.copies;
}

// Returns what the other ranks send to this one, neighbour by neighbour: values of owners for
// copies, or the other way round.
std::vector<double> Partition::send(const Vec& values, Receivers to) const {
  const Receivers here = to == Receivers::Copies ? Receivers::Owners : Receivers::Copies;
  require_size("Partition: the vector", values.size(), size_);
  std::vector<double> out, in;
  std::size_t out_size = 0, in_size = 0;
  for (const Neighbour& n : neighbours_) {
    if (n.rank == ranks_->rank()) continue;
    out_size += sent(n, to).size();
    in_size += sent(n, here).size();
  }
  out.reserve(out_size);
  in.resize(in_size);
  std::vector<Ranks::Message> outgoing, incoming;
  auto place = in.begin();
  for (const Neighbour& n : neighbours_) {
    if (n.rank == ranks_->rank()) continue;
    const auto& mine = sent(n, to);
    const auto begin = out.size();
    for (const Index i : mine) out.push_back(values[i]);
    if (!mine.empty()) outgoing.push_back({n.rank, {out.data() + begin, mine.size()}});
    const std::size_t count = sent(n, here).size();
    if (count > 0)
      incoming.push_back({n.rank, {place, place + static_cast<std::ptrdiff_t>(count)}});
    place += static_cast<std::ptrdiff_t>(count);
  }
  ranks_->exchange(outgoing, incoming);
  return in;
}

void Partition::copy_from_owners(Vec& y) const {
  if (is_whole_) return;
  const std::vector<double> in = send(y, Receivers::Copies);
  auto value = in.begin();
  for (const Neighbour& n : neighbours_) {
    if (n.rank == ranks_->rank())
      for (std::size_t k = 0; k < n.copies.size(); ++k) y[n.copies[k]] = y[n.owned[k]];
    else
      for (const Index i : n.copies) y[i] = *value++;
  }
}

void Partition::add_to_owners(Vec& g) const {
  if (is_whole_) return;
  const std::vector<double> in = send(g, Receivers::Owners);
  auto value = in.begin();
  for (const Neighbour& n : neighbours_) {
    if (n.rank == ranks_->rank())
      for (std::size_t k = 0; k < n.copies.size(); ++k) g[n.owned[k]] += g[n.copies[k]];
    else
      for (const Index i : n.owned) g[i] += *value++;
  }
  for (const Neighbour& n : neighbours_)
    for (const Index i : n.copies) g[i] = 0;
}

double Partition::dot(VecIn a, VecIn b) const {
  if (is_whole_) return a.dot(b);
  double sum = 0;
  for (Index i = 0; i < size_; ++i)
    if (owns(i)) sum += a[i] * b[i];
  return ranks_->sum(sum);
}

double Partition::squared_norm(VecIn a) const { return is_whole_ ? a.squaredNorm() : dot(a, a); }

double Partition::norm(VecIn a) const { return is_whole_ ? a.norm() : std::sqrt(dot(a, a)); }

bool Partition::all_finite(VecIn a) const { return ranks_->all(a.allFinite()); }

Partition Partition::part(const std::vector<Index>& kept) const {
  const auto count = static_cast<Index>(kept.size());
  if (is_whole_) return Partition(count);
  Vec number = Vec::Constant(size_, -1);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    require_index("Partition::part: an unknown", kept[k], size_);
    number[kept[k]] = static_cast<double>(k);
  }
  Vec at_owner = number;
  copy_from_owners(at_owner);
  bool agreed = true;
  for (Index i = 0; i < size_; ++i) agreed = agreed && (at_owner[i] < 0) == (number[i] < 0);
  if (!ranks_->all(agreed))
    throw InvalidArgument("Partition::part: an unknown is kept by one rank, and not by another");
  const auto renumbered = [&](const std::vector<Index>& old) {
    std::vector<Index> list;
    for (const Index i : old)
      if (number[i] >= 0) list.push_back(static_cast<Index>(number[i]));
    return list;
  };
  std::vector<Neighbour> neighbours;
  for (const Neighbour& n : neighbours_)
    neighbours.push_back({n.rank, renumbered(n.owned), renumbered(n.copies)});
  return {ranks_, count, std::move(neighbours)};
}

const Partition& partition_of(const Problem& problem) { return ProblemParts::partition(problem); }

ProblemBuilder shared_problem_builder(std::shared_ptr<const Partition> partition) {
  return ProblemParts::builder(std::move(partition));
}

void analyze_shared(LinearSolver& solver, const SparsePattern& pattern,
                    const Partition& partition) {
  if (auto* shared = dynamic_cast<SharedSolver*>(&solver))
    return shared->analyze_shared(pattern, partition);
  if (!partition.is_whole())
    throw InvalidArgument(
        "the linear solver knows one process only, the matrix is that of several");
  solver.analyze(pattern);
}

double mean_diagonal(const SparsePattern& pattern, const Vec& values, const Partition& partition) {
  if (partition.is_whole()) return mean_diagonal(pattern, values);
  Vec diagonal(pattern.size);
  for (Index c = 0; c < pattern.size; ++c) diagonal[c] = values[pattern.diagonal_slot(c)];
  partition.add_to_owners(diagonal);
  return partition.sum(diagonal.lpNorm<1>()) / static_cast<double>(partition.global_size());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
