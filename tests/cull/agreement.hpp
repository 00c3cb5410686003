// SPDX-License-Identifier: MIT
/// Compares what the library answers, in every form and on every instruction set under test, with what is right.
#pragma once

#include <vector>

#include "oracle/shaft_input.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"

namespace shaftcull {

/// The answers of classify() for a form, after checking that cull() keeps the same bounds.
std::vector<Answer> answers(const ShaftInput& input, const std::vector<Box>& bounds, Form form);
std::vector<Answer> answers(const ShaftInput& input, const std::vector<Sphere>& bounds, Form form);

/// Fails, with a reproducer for the first wrong one, unless all answers are `right`.
void expect_answers(const ShaftInput& input, const std::vector<Box>& bounds, const std::vector<Answer>& right);
void expect_answers(const ShaftInput& input, const std::vector<Sphere>& bounds, const std::vector<Answer>& right);

/// As above, against the oracle.
void expect_exact(const ShaftInput& input, const std::vector<Box>& bounds);
void expect_exact(const ShaftInput& input, const std::vector<Sphere>& bounds);

}  // namespace shaftcull
