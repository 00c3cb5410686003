// SPDX-License-Identifier: MIT
/// Floating-point modes of the user's callbacks.
#pragma once

#include "support/float_environment.hpp"

namespace shaftcull::kernel {

/// The modes of the thread that makes this, in which it then runs callbacks, wherever they are called from.
class CallersModes {
 public:
  template <class Callback>
  decltype(auto) operator()(const Callback& callback) const {
    const Restore standard;
    modes_.set();
    return callback();
  }

 private:
  struct Restore {
    FloatState state = FloatState::now();
    Restore() = default;
    Restore(const Restore&) = delete;
    Restore& operator=(const Restore&) = delete;
    ~Restore() { state.set(); }
  };

  FloatState modes_ = FloatState::now();
};

}  // namespace shaftcull::kernel
