// SPDX-License-Identifier: MIT
/// The exceptions of the library. Every message states what is wrong, where, and what would be right.
///
/// *Without exceptions.* For toolchains without exceptions (WebAssembly without a runtime, consoles), build the library
/// with the CMake option `SHAFTCULL_WITH_EXCEPTIONS=OFF`. Errors then go to the handler of set_error_handler(). The
/// program ends (std::abort) if the handler returns, or if memory runs out.
///
/// The library defines the destructors. So the type information that a `catch` compares exists only once, however many
/// shared libraries a program loads. Standard libraries that compare its addresses need that.
#pragma once

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>

#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// An argument broke a rule of the function that was called. Nothing was changed.
class SHAFTCULL_EXPORT InvalidArgument : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
  InvalidArgument(const InvalidArgument&) = default;
  InvalidArgument& operator=(const InvalidArgument&) = default;
  ~InvalidArgument() override;
};

/// A bound or point in the user's memory cannot be used: NaN, lo > hi, a negative radius or half extent, or a value
/// that is not finite where the call needs finite values. For a batch of shafts (volumes.hpp), index() is the position
/// of the first shaft that cannot be formed.
class SHAFTCULL_EXPORT BadBound : public InvalidArgument {
 public:
  /// Makes the error of the bad bound at position `index`, with the message `what`.
  BadBound(std::size_t index, const std::string& what) : InvalidArgument(what), index_(index) {}
  BadBound(const BadBound&) = default;
  BadBound& operator=(const BadBound&) = default;
  ~BadBound() override;
  /// The position of the first bad bound in its input, counted from 0.
  [[nodiscard]] std::size_t index() const noexcept { return index_; }

 private:
  std::size_t index_;
};

/// A tree was queried after update() by index and before refit(). This is not an InvalidArgument: the arguments are
/// legal, but the order of calls is not. The tree stays as it is; call refit() or rebuild(), and query again.
class SHAFTCULL_EXPORT NeedsRefit : public std::logic_error {
 public:
  using std::logic_error::logic_error;
  NeedsRefit(const NeedsRefit&) = default;
  NeedsRefit& operator=(const NeedsRefit&) = default;
  ~NeedsRefit() override;
};

/// The function that a build without exceptions calls in place of throwing an error. The handler ends the program in
/// its own way: the library cannot continue, and does not undo its changes. The handler is not called if operator new
/// finds no memory.
using ErrorHandler = void (*)(const std::exception& error);

/// Sets the handler, and returns the previous handler. With a null handler, which is the default, the message goes to
/// standard error, and the program ends. Builds with exceptions never call the handler. Safe to call from any thread.
SHAFTCULL_EXPORT ErrorHandler set_error_handler(ErrorHandler handler) noexcept;

}  // namespace shaftcull
