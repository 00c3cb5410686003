// SPDX-License-Identifier: MIT
/// What must hold for every input, however odd.
#pragma once

#include <optional>
#include <stdexcept>

#include "fuzz/case.hpp"

namespace shaftcull::fuzz {

/// Something that must hold does not; what() says what, and for which shaft and bound, as C++ source text.
class Fault : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Packs, forms, compiles and tests, and throws Fault unless
/// * packing and formation, of all kinds of shafts and of hulls, refuse exactly what the headers say, and pack exactly
///   what they are given;
/// * every instruction set gives the answers of the scalar one;
/// * both forms agree, and so do cull() and classify(), of bounds inside alone too, on bounds that are legal or have a
///   NaN;
/// * what is inside is kept, and nothing with a NaN is inside;
/// * what blocks is kept, has no NaN, and is the same alone and in a view.
/// With a draw, it picks the one instruction set that is compared with the scalar one, and one case in four for a whole
/// tile. Over millions of inputs, a new input finds more than one more comparison of the same input does.
void check_answers(const Case& it, std::optional<unsigned> draw = std::nullopt);

/// Throws Fault unless the answers for the first bounds of either kind, and entry times of boxes, are those of exact
/// arithmetic. Slow.
void check_exact(const Case& it, std::size_t most_bounds);

}  // namespace shaftcull::fuzz
