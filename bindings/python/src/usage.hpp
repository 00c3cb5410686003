// SPDX-License-Identifier: MIT
/// Who uses an object while the interpreter lock is released. Queries may run side by side; a change must be alone, or
/// Python could crash where C++ forbids a race. Both are begun and ended with the lock held, so counters need no
/// atomics.
#pragma once

#include <stdexcept>

namespace shaftcull::python {

struct Usage {
  int readers = 0;
  bool changing = false;
};

/// While a call reads an object, or changes it. Declared before the lock is released.
template <bool changes>
class Using {
 public:
  explicit Using(Usage& usage) : usage_(usage) {
    if (usage.changing || (changes && usage.readers != 0)) {
      throw std::runtime_error(
          changes ? "another thread uses this object; change it before or after that, or keep two"
                  : "another thread is changing this object; ask it before or after that, or keep two");
    }
    if constexpr (changes) {
      usage.changing = true;
    } else {
      ++usage.readers;
    }
  }
  Using(const Using&) = delete;
  Using& operator=(const Using&) = delete;
  ~Using() {
    if constexpr (changes) {
      usage_.changing = false;
    } else {
      --usage_.readers;
    }
  }

 private:
  Usage& usage_;
};

using Reading = Using<false>;
using Changing = Using<true>;

}  // namespace shaftcull::python
