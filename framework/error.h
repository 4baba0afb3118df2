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
// The message is one line that names the place and the remedy. For meshes read from a file it names
// the file and counts lines and elements from 1, as the file does; everything else counts from 0,
// as programs do. Numerical trouble inside a solve is never thrown: it is a Status (run_record.h).
//
// The library throws nothing else, except std::bad_alloc, Stopped if a stop check of the caller
// ends a run (stop_check.h), and exceptions of the caller's own code (terms, constraints, checkers,
// observers, solvers), which pass through unchanged, also from parallel loops. After an exception,
// the objects that it passed through can be destroyed, and problems and terms, which are immutable,
// can be used again.
#pragma once

#include <stdexcept>
#include <string>

namespace majorant {

enum class ErrorKind {
  Usage,        // wrong arguments
  Unreadable,   // input cannot be read: file, line, reason
  Unsupported,  // input read, but outside what the library handles: element and remedy
  Infeasible,   // no valid start for the request
  Invalid,      // a result that fails its checks
};

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

// A call that is wrong for every input: sizes that do not fit, null pointers, numbers that are not
// finite or out of range. The message names the function and the argument. Its kind is Usage.
class InvalidArgument : public Error {
 public:
  explicit InvalidArgument(const std::string& message) : Error(ErrorKind::Usage, message) {}
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
