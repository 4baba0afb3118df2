#include "apps/mpi/internal/rethrow_collectively.h"

#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/mpi/internal/collect.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

// An exception as numbers: its kind, then the characters of its message. Empty: there is none.
enum class FailureKind { Error, BadAlloc, Other };

std::vector<double> numbers_of(const std::exception_ptr& failure) {
  if (!failure) return {};
  const auto numbers = [](FailureKind kind, double error_kind, const std::string& message) {
    std::vector<double> list{static_cast<double>(kind), error_kind};
    list.insert(list.end(), message.begin(), message.end());
    return list;
  };
  try {
    std::rethrow_exception(failure);
  } catch (const Error& e) {
    return numbers(FailureKind::Error, static_cast<double>(e.kind()), e.what());
  } catch (const std::bad_alloc&) {
    return numbers(FailureKind::BadAlloc, 0, "");
  } catch (const std::exception& e) {
    return numbers(FailureKind::Other, 0, e.what());
  }
}

[[noreturn]] void throw_from(const std::vector<double>& numbers) {
  std::string message;
  for (std::size_t k = 2; k < numbers.size(); ++k) message += static_cast<char>(numbers[k]);
  switch (static_cast<FailureKind>(static_cast<int>(numbers[0]))) {
    case FailureKind::Error:
      throw Error(static_cast<ErrorKind>(static_cast<int>(numbers[1])), message);
    case FailureKind::BadAlloc:
      throw std::bad_alloc();
    case FailureKind::Other:
      break;
  }
  throw std::runtime_error(message);
}

}  // namespace

void rethrow_collectively(const Ranks& ranks, const std::exception_ptr& failure) {
  if (!ranks.any(failure != nullptr)) return;
  const std::vector<std::vector<double>> all = gathered(ranks, numbers_of(failure));
  if (ranks.rank() > 0) throw ReportedByFirstRank();
  for (const std::vector<double>& numbers : all)
    if (!numbers.empty()) throw_from(numbers);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
