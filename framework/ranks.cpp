#include "majorant/framework/ranks.h"

#include "majorant/framework/error.h"

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

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
