// A Python object that C++ objects may own and any thread may release.
#pragma once

#include <pybind11/pybind11.h>

#include <utility>

namespace majorant::python {

class Kept {
 public:
  explicit Kept(pybind11::object object) : object_(std::move(object)) {}
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;
  ~Kept() {
    const pybind11::gil_scoped_acquire lock;
    object_.release().dec_ref();
  }
  // Requires the interpreter's lock.
  pybind11::handle get() const { return object_; }

 private:
  pybind11::object object_;
};

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
