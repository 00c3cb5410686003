// SPDX-License-Identifier: MIT
/// Numbers in the user's memory that threads change at the same time.
#pragma once

#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// An unsigned number as std::atomic_ref has it, which standard libraries lack (libc++ before 19). Relaxed: nothing
/// else is put in order by it.
template <class Number>
class SharedNumber {
 public:
  explicit SharedNumber(Number& number) noexcept : number_(&number) {}

  [[nodiscard]] Number load() const noexcept { return atomic_load(number_); }
  void add(Number more) const noexcept { atomic_add(number_, more); }
  void set_bits(Number bits) const noexcept { atomic_or(number_, bits); }
  /// Makes it `wanted` if it is `expected`; otherwise, or for no reason, sets `expected` to what it is.
  [[nodiscard]] bool exchange(Number& expected, Number wanted) const noexcept {
    return atomic_exchange(number_, expected, wanted);
  }

 private:
  Number* number_;
};

}  // namespace shaftcull::kernel
