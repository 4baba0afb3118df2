// Several processes that solve one problem together, each with a part of it: the processes (Ranks),
// the owners of unknowns (Partition), and what both mean for loops, problems and linear solvers.
//
// Every rank numbers from 0 the unknowns that its elements touch. One rank owns an unknown that
// several ranks have; the others have copies. A rank with one unknown under several numbers has
// copies as well.
//
//   const Partition partition(3);          // one process: owns all, copies nothing
//   Vec g = Vec::Ones(3);
//   partition.add_to_owners(g);            // what all ranks assembled, at owners; copies hold 0
//   const double length = partition.norm(g);
//   Vec y = g;
//   partition.copy_from_owners(y);         // every copy is its owner's
//
// In vectors over a problem's unknowns, copies hold the owners' values for points and directions,
// and 0 for gradients. With several ranks, most members are collective: every rank must call them,
// in the same order, or all wait forever. Collective are all members of Ranks but rank() and
// count(), and those members of Partition that take vectors or agree on a value. So a rank decides
// by values that all ranks have agreed on, never by values of its own.
//
// This header is all that solvers know of several processes. If a problem has a partition, every
// rank runs the same loop on its part. Energies, verdicts and norms are those of the whole problem.
// Gradients are summed at owners, Hessian values are this rank's part of the sum, and an observer's
// directive is that of rank 0. A stop check would end one rank and leave the others waiting.
// Therefore functions with a stop check throw InvalidArgument, as do solvers for one process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/types.h"

namespace majorant {

// A library of processes implements the virtual members (apps/mpi/ does, on MPI); terms, checkers
// and elements never use this class.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const = 0;  // 0 .. count() - 1
  virtual int count() const = 0;

  // Adds in place, entry by entry, over all ranks, which have the same number of entries. Sums
  // follow the order of the ranks, so the bits are the same on every rank and in every run with as
  // many ranks.
  virtual void sum(std::span<double> values) const = 0;
  virtual void min(std::span<double> values) const = 0;
  // Gives every rank the bytes of rank 0; all ranks pass the same number of bytes.
  virtual void broadcast(std::span<std::byte> bytes) const = 0;

  // Numbers sent to a rank or received from it. Sizes are not transmitted: both sides know them.
  struct Message {
    int rank;
    std::span<double> values;
  };
  // Each list has at most one message a rank, none to the rank itself; each sent message is
  // received.
  virtual void exchange(std::span<const Message> sent, std::span<const Message> received) const = 0;

  double sum(double value) const;
  double min(double value) const;
  double max(double value) const;
  bool all(bool value) const;
  bool any(bool value) const { return !all(!value); }
  // Returns the number or enumerator of rank 0.
  template <class T>
  T of_first(T value) const {
    broadcast(std::as_writable_bytes(std::span(&value, 1)));
    return value;
  }
};

// Returns the ranks of a single process: nothing is summed, agreed on or copied.
std::shared_ptr<const Ranks> one_process();

// The number of an unknown among those of all ranks; local numbers are of type Index.
using GlobalIndex = std::int64_t;

class Partition {
 public:
  // A single process owns all unknowns.
  Partition() : Partition(0) {}
  explicit Partition(Index size);

  // The unknowns that two ranks share. `owned`: unknowns of this rank that the other rank copies;
  // `copies`: unknowns that the other rank owns. The k-th copy there is the k-th owned unknown
  // here. If `rank` is this rank, copies[k] is another number of owned[k].
  struct Neighbour {
    int rank;
    std::vector<Index> owned, copies;
  };
  // Collective. Throws InvalidArgument for numbers out of range, an unknown that is a copy twice,
  // or a rank that occurs twice.
  Partition(std::shared_ptr<const Ranks> ranks, Index size, std::vector<Neighbour> neighbours);

  const Ranks& ranks() const { return *ranks_; }
  const std::shared_ptr<const Ranks>& shared_ranks() const { return ranks_; }
  const std::vector<Neighbour>& neighbours() const { return neighbours_; }
  // True for one process without copies; collective members then do nothing.
  bool is_whole() const { return is_whole_; }
  Index size() const { return size_; }         // with copies
  Index owned_size() const { return owned_; }  // without copies
  bool owns(Index local) const { return is_copy_.empty() || !is_copy_[local]; }
  // Owned unknowns are numbered rank by rank, in their order; a copy has its owner's number.
  GlobalIndex global(Index local) const { return global_.empty() ? local : global_[local]; }
  GlobalIndex global_size() const { return global_size_; }

  void copy_from_owners(Vec& y) const;
  void add_to_owners(Vec& g) const;  // copies hold 0 afterwards
  // Sums over the owned entries of all ranks, in their order; the bits are the same on all ranks.
  double dot(VecIn a, VecIn b) const;
  double squared_norm(VecIn a) const;
  double norm(VecIn a) const;
  bool all_finite(VecIn a) const;

  // ---- Values that all ranks agree on, computed from one value a rank (Ranks) ----
  double sum(double value) const { return ranks_->sum(value); }
  double min(double value) const { return ranks_->min(value); }
  double max(double value) const { return ranks_->max(value); }
  bool all(bool value) const { return ranks_->all(value); }
  bool any(bool value) const { return ranks_->any(value); }
  template <class T>
  T of_first(T value) const {
    return ranks_->of_first(value);
  }

  // Returns the partition of the unknowns `kept`, in increasing order, which are numbered by their
  // place in the list. Collective. Throws InvalidArgument if an owner is kept without one of its
  // copies, or vice versa.
  Partition part(const std::vector<Index>& kept) const;

 private:
  void number();
  enum class Receivers { Copies, Owners };
  std::vector<double> send(const Vec& values, Receivers to) const;
  static const std::vector<Index>& sent(const Neighbour& n, Receivers to);

  std::shared_ptr<const Ranks> ranks_;
  Index size_, owned_;
  bool is_whole_ = true;
  std::vector<Neighbour> neighbours_;  // by rank
  std::vector<char> is_copy_;          // size(), or empty: none
  std::vector<GlobalIndex> global_;    // size(), or empty: equal to local numbers
  GlobalIndex global_size_;
};

// Returns how the reduced unknowns of a problem are shared; one process has all of them.
const Partition& partition_of(const Problem& problem);

// Returns a builder of a problem that all ranks share: each rank builds one from its own terms, on
// the unknowns that these touch. Energy, gradient and Hessian are the sums over all ranks. Points
// are vectors of this rank's unknowns. Checkers must be of the same kinds on every rank; a point is
// feasible if each rank accepts its part. build() is collective. It throws InvalidArgument for
// constraints that couple unknowns, or that hold an unknown on one rank and not on another.
ProblemBuilder shared_problem_builder(std::shared_ptr<const Partition> partition);

// A solver of matrices that are sums over several processes, each on its own unknowns. `pattern`
// and values are those of this rank, r holds 0 in copies, and p must get the owners' values there.
// All members are collective, and the outcomes are the same on every rank. Both arguments must
// outlive the solver's use of them.
class SharedSolver : public LinearSolver {
 public:
  virtual void analyze_shared(const SparsePattern& pattern, const Partition& partition) = 0;
};

// Analyses for one process or several. Throws InvalidArgument for several processes if the solver
// supports only one.
void analyze_shared(LinearSolver& solver, const SparsePattern& pattern, const Partition& partition);

// Returns the mean of the diagonal of the sum of all ranks' matrices. Collective.
double mean_diagonal(const SparsePattern& pattern, const Vec& values, const Partition& partition);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
