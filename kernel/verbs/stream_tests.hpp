// SPDX-License-Identifier: MIT
/// The tests of a query about many shafts and bounds in streams.
#pragma once

#include <optional>

#include "flat/packed.hpp"
#include "flat/shaft_tests.hpp"
#include "verbs/asked.hpp"

namespace shaftcull::kernel {

/// The tests of all shafts against bounds in streams: those of a view, or a copy of the candidates.
class StreamTests {
 public:
  explicit StreamTests(const Asked& asked)
      : tests_(asked.shafts(), asked.options().only() ? packed_.emplace(asked.scanned()).bounds() : asked.scanned(),
               asked.question(), asked.options(), asked.kernels()) {}

  [[nodiscard]] const ShaftTests& get() const noexcept { return tests_; }

 private:
  std::optional<PackedCandidates> packed_;
  ShaftTests tests_;
};

}  // namespace shaftcull::kernel
