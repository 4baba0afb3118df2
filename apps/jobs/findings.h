// The findings of `check` in words.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

inline constexpr double kClose = kTenDigits;  // relative to the size of the map or surface

// A list of findings; an empty list means that the check passed. Violations are proven, open
// findings are questions that could not be decided. Both fail the check.
class Findings {
 public:
  void require(bool holds, std::string what) {
    if (!holds) add_violation(std::move(what));
  }
  void add_violation(std::string what) {
    list_.insert(list_.begin() + static_cast<std::ptrdiff_t>(violations_++), std::move(what));
  }
  void add_open(const std::string& what) { list_.push_back(what); }

  bool violated() const { return violations_ > 0; }
  const std::vector<std::string>& list() const { return list_; }  // violations first

 private:
  std::size_t violations_ = 0;
  std::vector<std::string> list_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
