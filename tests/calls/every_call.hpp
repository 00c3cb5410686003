// SPDX-License-Identifier: MIT
/// Every public call that computes something, in one table, for tests of what is promised of all of them.
#pragma once

#include <cstddef>
#include <vector>

#include "calls/call_table.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

/// The calls, and all that they are given. Calls may be made again and again; each leaves what it was given as it was.
/// They do no floating-point arithmetic of their own.
class EveryCall {
 public:
  /// `shafts` are what queries ask; a group of them and more if there are over 64. Must be at least 1. Bounds and
  /// shafts touch often, so that exact predicates run too.
  EveryCall(std::vector<CompiledShaft> shafts, std::size_t bounds);
  EveryCall(const EveryCall&) = delete;
  EveryCall& operator=(const EveryCall&) = delete;

  [[nodiscard]] const std::vector<PublicCall>& calls() const noexcept { return table_.calls; }

  /// Shafts of all kinds: in slab form, with purple faces, with added planes, with and without their planes, of moving
  /// boxes, and with open contact.
  static std::vector<CompiledShaft> shafts(std::size_t count);

 private:
  CallTable table_;
};

}  // namespace shaftcull
