// SPDX-License-Identifier: MIT
#include "shaftcull/error.hpp"

#include "support/exact_floats.hpp"

namespace shaftcull {

InvalidArgument::~InvalidArgument() = default;
BadBound::~BadBound() = default;
NeedsRefit::~NeedsRefit() = default;

}  // namespace shaftcull
