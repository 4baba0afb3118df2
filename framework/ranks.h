// Processes that solve one problem together, each with a part of it: what they must agree on.
//
//   const std::shared_ptr<const Ranks> ranks = one_process();
//   double parts = 2.5;
//   const double whole = ranks->sum(parts);      // 2.5 here, of all ranks elsewhere
//   const bool everywhere = ranks->all(whole > 0);
//
// All members but rank() and count() are collective: every rank calls them, in the same order, or
// all wait forever. So decide from what has been agreed on, never from what one rank alone knows.
// Who brings processes implements the virtual members (distributed/ does, on MPI); terms, checkers
// and elements never see this.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "majorant/framework/types.h"

namespace majorant {

class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const = 0;  // 0 .. count() - 1
  virtual int count() const = 0;

  // In place, entry by entry, over all ranks; as many entries everywhere. The same bits on every
  // rank and in every run with as many ranks: sums are made in the order of the ranks.
  virtual void sum(std::span<double> values) const = 0;
  virtual void min(std::span<double> values) const = 0;
  // What rank 0 has. As many bytes everywhere.
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
  // What rank 0 has of a number or an enumerator.
  template <class T>
  T of_first(T value) const {
    broadcast(std::as_writable_bytes(std::span(&value, 1)));
    return value;
  }
};

// This process is all there is: nothing is added up, nobody is asked, nothing is copied.
std::shared_ptr<const Ranks> one_process();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
