// SPDX-License-Identifier: MIT
/// All pairs of a small random scene, whether they see each other.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "oracle/sight_agreement.hpp"

namespace shaftcull::cli {

/// A scene that depends on its seed and number alone, and what is true of its pairs.
class SightTrial {
 public:
  SightTrial(std::uint64_t seed, std::uint64_t number);
  SightTrial(const SightTrial&) = delete;
  SightTrial& operator=(const SightTrial&) = delete;

  /// Asks the instruction set that is selected. May be called by many threads for one after the other.
  void ask();

  [[nodiscard]] std::uint64_t pairs() const { return case_.pairs(); }
  /// What was answered wrongly, or empty.
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }

 private:
  std::string what_;
  SightCase case_;
  SightTruths truths_;
  std::string failure_;
};

}  // namespace shaftcull::cli
