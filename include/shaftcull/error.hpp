// SPDX-License-Identifier: MIT
/// What the library throws. Every message says what is wrong, where, and what would be right.
///
/// *Without exceptions.* Where a toolchain has none (WebAssembly without a runtime, consoles), the library is built
/// with the CMake option `SHAFTCULL_WITH_EXCEPTIONS=OFF`. What would be thrown is then given to a handler, the one of
/// set_error_handler(), and if that returns, the program ends (std::abort); so it does where memory runs out.
///
/// Destructors are defined in the library, and with them what a `catch` compares: there is one of it, however many
/// shared libraries a program loads. Standard libraries that compare addresses need that.
#pragma once

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>

#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// An argument broke a rule of the function that was called; nothing was changed.
class SHAFTCULL_EXPORT InvalidArgument : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
  InvalidArgument(const InvalidArgument&) = default;
  InvalidArgument& operator=(const InvalidArgument&) = default;
  ~InvalidArgument() override;
};

/// A bound or point in the user's memory cannot be used: NaN, lo > hi, a negative radius or half extent, or a value
/// that is not finite where the call needs finite ones. Of a batch of shafts (volumes.hpp): the first that cannot be
/// formed.
class SHAFTCULL_EXPORT BadBound : public InvalidArgument {
 public:
  /// `index` is what index() tells, and `what` the message.
  BadBound(std::size_t index, const std::string& what) : InvalidArgument(what), index_(index) {}
  BadBound(const BadBound&) = default;
  BadBound& operator=(const BadBound&) = default;
  ~BadBound() override;
  /// Position of the first bad bound in the input it came from, counted from 0.
  [[nodiscard]] std::size_t index() const noexcept { return index_; }

 private:
  std::size_t index_;
};

/// A tree was asked after update() by index and before refit(). Not an InvalidArgument: the arguments are fine, the
/// order of calls is not. The tree stays as it is; call refit() or rebuild() and ask again.
class SHAFTCULL_EXPORT NeedsRefit : public std::logic_error {
 public:
  using std::logic_error::logic_error;
  NeedsRefit(const NeedsRefit&) = default;
  NeedsRefit& operator=(const NeedsRefit&) = default;
  ~NeedsRefit() override;
};

/// What a build without exceptions calls in place of throwing an error. It ends the program in its own way: the library
/// cannot go on, and does not leave things as they were. Where operator new finds no memory, it is not called.
using ErrorHandler = void (*)(const std::exception& error);

/// Sets the handler, and returns the one before. Null, as at first: the message goes to standard error, and the program
/// ends. Builds with exceptions never call it. Safe to call from any thread.
SHAFTCULL_EXPORT ErrorHandler set_error_handler(ErrorHandler handler) noexcept;

}  // namespace shaftcull
