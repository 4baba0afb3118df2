// The exceptions of the library: one base class, Error, with a kind, so that a program can turn it
// into an exit code.
//
//   try {
//     std::cout << status_name(parametrize(mesh, {}).status) << "\n";
//   } catch (const InvalidArgument& e) {   // the call is wrong: mend the program
//     std::cerr << "called wrongly: " << e.what() << "\n";
//   } catch (const Error& e) {             // the input is: tell the user
//     std::cerr << e.what() << "\n";
//   }
//
// The message is one line that names the place and the remedy. Meshes that were read from a file
// are told of by its name, lines and numbers from 1, as it has them; all else counts from 0, as
// programs do. Not for numerical trouble inside a solve, which is never thrown: it is a Status
// (run_record.h).
//
// Nothing else leaves the library, but std::bad_alloc, Stopped where a stop check of the caller's
// says so (stop_check.h), and whatever the caller's own code throws - terms, constraints, checkers,
// observers, solvers -, unchanged, from parallel loops too. After an exception the objects that it
// passed through may be destroyed, and problems and terms, which are immutable, used again.
#pragma once

#include <stdexcept>
#include <string>

namespace majorant {

enum class ErrorKind {
  Usage,        // wrong arguments
  Unreadable,   // input cannot be read: file, line, reason
  Unsupported,  // input read, but outside what the library handles: element and remedy
  Infeasible,   // no valid start for what was asked
  Invalid,      // a result that fails its checks
};

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

// A call that no input makes right: sizes that do not fit, null pointers, numbers that are not
// finite or out of range. The message names the function and the argument. Its kind is Usage.
class InvalidArgument : public Error {
 public:
  explicit InvalidArgument(const std::string& message) : Error(ErrorKind::Usage, message) {}
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
