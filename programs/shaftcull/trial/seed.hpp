// SPDX-License-Identifier: MIT
/// Seeds of trials.
#pragma once

#include <cstdint>

namespace shaftcull::cli {

/// Sebastiano Vigna's splitmix64: neighbouring numbers become unrelated seeds.
constexpr std::uint64_t mixed(std::uint64_t x) noexcept {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111eb;
  return x ^ (x >> 31U);
}

}  // namespace shaftcull::cli
