// Several processes that solve one problem together, each with a part of it: who they are (Ranks),
// which unknowns are whose (Partition), and what loops, problems and linear solvers say of that.
//
// Every rank has some unknowns of a problem, numbered from 0: all that its elements touch. One that
// several ranks have is owned by one of them; the others have copies. So have ranks with one
// unknown under several numbers.
//
//   const Partition partition(3);          // one process: owns all, copies nothing
//   Vec g = Vec::Ones(3);
//   partition.add_to_owners(g);            // what all ranks assembled, at owners; copies hold 0
//   const double length = partition.norm(g);
//   Vec y = g;
//   partition.copy_from_owners(y);         // every copy is its owner's
//
// In vectors over a problem's unknowns, points and directions hold the owners' values in copies,
// gradients hold 0 there. Where there are several ranks, all members of Ranks but rank() and
// count(), and those of Partition that take vectors or agree on something, are collective: every
// rank calls them, in the same order, or all wait forever. So decide from what has been agreed on,
// never from what one rank alone knows.
//
// This header is all that solvers know of several processes. If a problem has a partition, every
// rank runs the same loop on its part. Energies, verdicts and norms are those of the whole problem.
// Gradients are summed at owners, Hessian values are this rank's part of the sum, and an observer's
// directive is that of rank 0. A stop check would end one rank and leave the others waiting, so
// functions that take one throw InvalidArgument, as do solvers for one process.
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

// Who brings processes implements the virtual members (apps/mpi/ does, on MPI); terms, checkers
// and elements never see this.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const = 0;  // 0 .. count() - 1
  virtual int count() const = 0;

  // Adds in place, entry by entry, over all ranks, which have as many entries. The bits are the
  // same on every rank and in every run with as many ranks: sums are made in the order of the
  // ranks.
  virtual void sum(std::span<double> values) const = 0;
  virtual void min(std::span<double> values) const = 0;
  // Every rank gets the bytes of rank 0; all give as many.
  virtual void broadcast(std::span<std::byte> bytes) const = 0;

  // Numbers for one rank, or from it. Nobody is told sizes: both sides know them.
  struct Message {
    int rank;
    std::span<double> values;
  };
  // At most one message a rank in either list, none to oneself; each that is sent is received.
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

// This process is all there is: nothing is added up, nobody is asked, nothing is copied.
std::shared_ptr<const Ranks> one_process();

// A number among the unknowns of all ranks; local numbers stay Index.
using GlobalIndex = std::int64_t;

class Partition {
 public:
  // Gives one process all of them.
  Partition() : Partition(0) {}
  explicit Partition(Index size);

  // The unknowns that two ranks share. `owned`: unknowns of this rank that the other has copies of;
  // `copies`: those of which the other is the owner. The k-th copy there is the k-th owned here.
  // Where `rank` is this one, copies[k] is another number of owned[k].
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
  // True for one process without copies: what is collective elsewhere does nothing.
  bool is_whole() const { return is_whole_; }
  Index size() const { return size_; }         // copies included
  Index owned_size() const { return owned_; }  // copies not
  bool owns(Index local) const { return is_copy_.empty() || !is_copy_[local]; }
  // Owned unknowns are numbered rank by rank, in their order; a copy has its owner's number.
  GlobalIndex global(Index local) const { return global_.empty() ? local : global_[local]; }
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

  // Returns the partition of some of the unknowns, `kept` in increasing order; their new numbers
  // are their places in the list. Collective. Throws InvalidArgument if an owner is kept and one of
  // its copies is not, or vice versa.
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
  std::vector<GlobalIndex> global_;    // size(), or empty: as they are
  GlobalIndex global_size_;
};

// Returns how the reduced unknowns of a problem are shared; one process has all of them.
const Partition& partition_of(const Problem& problem);

// A problem that ranks have together: each builds one of its own terms, on the unknowns that these
// touch. Energy, gradient and Hessian of the whole are the sums; points are vectors of this rank's
// unknowns, and checkers, of the same kinds on every rank, hold what they hold on each. build() is
// collective; it throws InvalidArgument for constraints that tie unknowns to each other, or hold an
// unknown on one rank and not on another.
ProblemBuilder shared_problem_builder(std::shared_ptr<const Partition> partition);

// A solver of matrices that are sums of those of several processes, each on its own unknowns:
// `pattern` and values are this rank's, r holds 0 in copies, p is to hold the owners' values there.
// Everything is collective, and the outcomes are the same on every rank. Both arguments outlive the
// solver's use of them.
class SharedSolver : public LinearSolver {
 public:
  virtual void analyze_shared(const SparsePattern& pattern, const Partition& partition) = 0;
};

// Analyses for one process or several: throws InvalidArgument where there are several and the
// solver knows one only.
void analyze_shared(LinearSolver& solver, const SparsePattern& pattern, const Partition& partition);

// Returns the mean of the diagonal of the sum of all ranks' matrices. Collective.
double mean_diagonal(const SparsePattern& pattern, const Vec& values, const Partition& partition);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
