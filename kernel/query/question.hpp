// SPDX-License-Identifier: MIT
/// The question that scans and walks answer for every bound.
#pragma once

#include <cstdint>

namespace shaftcull::kernel {

/// Which bits a call wants. For `inside` alone a walk reports kept bounds all the same. For `blocking`, of boxes only,
/// *kept* are those that block the shaft.
enum class Question : std::uint8_t { kept, kept_and_inside, inside, blocking };

[[nodiscard]] constexpr bool asks_for_inside(Question question) noexcept {
  return question == Question::kept_and_inside || question == Question::inside;
}

}  // namespace shaftcull::kernel
