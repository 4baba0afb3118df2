// Errors at set-up: one exception type with a kind, so that a program can turn it into an exit
// code.
//
//   throw Error(ErrorKind::Unsupported, "mesh.obj: edge (4, 7) has 3 faces; split it");
//
// The message is one line that names the file, the place and the remedy. Numerical trouble inside a
// solve is never thrown: it is a Status (minimizer.h).
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

}  // namespace majorant
