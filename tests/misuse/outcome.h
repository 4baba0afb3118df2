// Wrong calls and their outcomes: a line with the exception or the result, part of which is
// compared with an expected text.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/minimizer.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant::misuse {

// Returns the message of a result; empty for void.
inline std::string printed(const SolveResult& r) {
  return std::string(status_name(r.status)) + ": " + r.message;
}
inline std::string printed(const ParametrizationResult& r) {
  return std::string(status_name(r.status)) + ": " + r.message;
}
inline std::string printed(const std::string& text) { return text; }

struct Call {
  std::string name, expected;
  std::function<std::string()> make;

  // A call may return anything that printed() accepts; any other result counts as accepted.
  template <class F>
  Call(std::string n, std::string e, F call) : name(std::move(n)), expected(std::move(e)) {
    make = [call]() -> std::string {
      if constexpr (std::is_void_v<decltype(call())>) {
        call();
        return "accepted";
      } else if constexpr (requires { printed(call()); }) {
        return printed(call());
      } else {
        static_cast<void>(call());
        return "accepted";
      }
    };
  }
};
inline std::ostream& operator<<(std::ostream& out, const Call& call) { return out << call.name; }

inline std::string outcome(const std::function<std::string()>& call) {
  static constexpr const char* kKinds[] = {"Usage", "Unreadable", "Unsupported", "Infeasible",
                                           "Invalid"};
  try {
    return call();
  } catch (const InvalidArgument& e) {
    return std::string("InvalidArgument: ") + e.what();
  } catch (const Error& e) {
    return std::string("Error ") + kKinds[static_cast<int>(e.kind())] + ": " + e.what();
  } catch (const std::exception& e) {
    return std::string("foreign exception: ") + e.what();
  }
}

class Misuse : public testing::TestWithParam<Call> {};

// Expects the outcome to begin with the expected text, or to contain it if the text begins with
// "...".
inline void expect_refusal(const Call& call) {
  const std::string got = outcome(call.make);
  const bool anywhere = call.expected.starts_with("...");
  const auto place = got.find(anywhere ? call.expected.substr(3) : call.expected);
  EXPECT_TRUE(anywhere ? place != std::string::npos : place == 0)
      << "expected: " << call.expected << "\ngot:      " << got;
  EXPECT_EQ(got.find("--"), std::string::npos) << "no flags: " << got;
  EXPECT_EQ(got.find(": :"), std::string::npos) << got;
  EXPECT_EQ(got.find('\n'), std::string::npos) << got;
}

inline std::string name_of(const testing::TestParamInfo<Call>& info) { return info.param.name; }

}  // namespace majorant::misuse

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
