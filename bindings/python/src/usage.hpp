// SPDX-License-Identifier: MIT
/// Who uses an object while the interpreter lock is released. Queries may run side by side; a change must be alone, or
/// Python could crash where C++ forbids a race. Both are begun and ended with the lock held, so counters need no
/// atomics.
#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>

namespace shaftcull::python {

struct Usage {
  int readers = 0;
  bool changing = false;
};

/// While a call reads an object.
class Reading {
 public:
  explicit Reading(Usage& usage) : usage_(usage) {
    if (usage.changing) {
      throw std::runtime_error("another thread is changing this object; ask it before or after that, or keep two");
    }
    ++usage_.readers;
  }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  ~Reading() { --usage_.readers; }

 private:
  Usage& usage_;
};

/// While a call changes an object. Declared before the lock is released.
class Changing {
 public:
  explicit Changing(Usage& usage) : usage_(usage) {
    if (usage.changing || usage.readers != 0) {
      throw std::runtime_error("another thread uses this object; change it before or after that, or keep two");
    }
    usage_.changing = true;
  }
  Changing(const Changing&) = delete;
  Changing& operator=(const Changing&) = delete;
  ~Changing() { usage_.changing = false; }

 private:
  Usage& usage_;
};

}  // namespace shaftcull::python
