// Which unknowns are this process's, and where the copies of those are that several need.
//
// Every rank (ranks.h) has some unknowns of a problem, numbered from 0: all that its elements
// touch. One that several ranks have is owned by one of them; the others have copies. So have ranks
// with one unknown under several numbers.
//
//   const Partition partition(3);          // one process: owns all, copies nothing
//   Vec g = Vec::Ones(3);
//   partition.add_to_owners(g);            // what all ranks assembled, at owners; copies hold 0
//   const double length = partition.norm(g);
//   Vec y = g;
//   partition.copy_from_owners(y);         // every copy is its owner's
//
// Of vectors over a problem's unknowns: points and directions hold the owners' values in copies,
// gradients hold 0 there. All members that take vectors, and those below "Agreed on", are
// collective where there are several ranks.
//
// All that solvers know of several processes is here. Where a problem has a partition
// (Problem::partition) every rank runs the same loop on its part: energies, verdicts and norms are
// those of the whole, gradients are summed at owners, Hessian values are this rank's part of the
// sum, an observer's directive is that of rank 0. A stop check would end one rank and leave the
// others waiting: what takes one throws InvalidArgument, as solvers do that know one process only.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "majorant/framework/ranks.h"
#include "majorant/framework/types.h"

namespace majorant {

// A number among the unknowns of all ranks; local numbers stay Index.
using GlobalIndex = std::int64_t;

class Partition {
 public:
  // One process has all of them.
  Partition() : Partition(0) {}
  explicit Partition(Index size);

  // What two ranks share. `owned`: unknowns of this rank that the other has copies of; `copies`:
  // those of which the other is the owner. The k-th copy there is the k-th owned here. Where `rank`
  // is this one, copies[k] is another number of owned[k].
  struct Neighbour {
    int rank;
    std::vector<Index> owned, copies;
  };
  // Collective. Throws InvalidArgument for numbers out of range, an unknown that is a copy twice,
  // a rank twice.
  Partition(std::shared_ptr<const Ranks> ranks, Index size, std::vector<Neighbour> neighbours);

  const Ranks& ranks() const { return *ranks_; }
  const std::shared_ptr<const Ranks>& shared_ranks() const { return ranks_; }
  const std::vector<Neighbour>& neighbours() const { return neighbours_; }
  // One process, and no copies: what is collective elsewhere does nothing.
  bool is_whole() const { return is_whole_; }
  Index size() const { return size_; }         // copies included
  Index owned_size() const { return owned_; }  // copies not
  bool owns(Index local) const { return is_copy_.empty() || !is_copy_[local]; }
  // Owned unknowns are numbered rank by rank, in their order; a copy has its owner's number.
  GlobalIndex global(Index local) const { return global_.empty() ? local : global_[local]; }
  GlobalIndex first_global() const { return first_; }  // of this rank's own
  GlobalIndex global_size() const { return global_size_; }

  void copy_from_owners(Vec& y) const;
  void add_to_owners(Vec& g) const;  // copies hold 0 afterwards
  // Sums over the owned entries of all ranks, in their order; the same bits everywhere.
  double dot(VecIn a, VecIn b) const;
  double squared_norm(VecIn a) const;
  double norm(VecIn a) const;
  bool all_finite(VecIn a) const;

  // ---- Agreed on: one answer from what each rank has (Ranks) ----
  double sum(double value) const { return ranks_->sum(value); }
  double min(double value) const { return ranks_->min(value); }
  double max(double value) const { return ranks_->max(value); }
  bool all(bool value) const { return ranks_->all(value); }
  bool any(bool value) const { return ranks_->any(value); }
  template <class T>
  T of_first(T value) const {
    return ranks_->of_first(value);
  }

  // That of some of the unknowns, `kept` in increasing order: their numbers there are their places
  // in the list. Collective. Throws InvalidArgument where an owner is kept and a copy is not, or
  // the other way round.
  Partition part(const std::vector<Index>& kept) const;

 private:
  void number();
  std::vector<double> send(const Vec& values, bool from_owners) const;

  std::shared_ptr<const Ranks> ranks_;
  Index size_, owned_;
  bool is_whole_ = true;
  std::vector<Neighbour> neighbours_;  // by rank
  std::vector<char> is_copy_;          // size(), or empty: none
  std::vector<GlobalIndex> global_;    // size(), or empty: as they are
  GlobalIndex first_ = 0, global_size_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
