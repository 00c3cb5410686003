// SPDX-License-Identifier: MIT
/// What stands for `catch` and `throw` of another error in builds without exceptions.
#pragma once

#include "shaftcull/error.hpp"
#include "shaftcull/function_ref.hpp"

namespace shaftcull::kernel {

/// Has tell_handler() tell another error of an InvalidArgument of this thread, until the end of the scope or the first
/// error. There is one at a time.
class TellingInstead {
 public:
  using Other = FunctionRef<BadBound(const InvalidArgument&)>;

  /// `other` must live as long as this.
  explicit TellingInstead(const Other& other) noexcept;
  ~TellingInstead();
  TellingInstead(const TellingInstead&) = delete;
  TellingInstead& operator=(const TellingInstead&) = delete;
};

}  // namespace shaftcull::kernel
