// SPDX-License-Identifier: MIT
#include "compiled/answers.hpp"
#include "support/fail.hpp"

#include <string>

#include "shaftcull/error.hpp"

namespace shaftcull::kernel {

void refuse_shaft(const ShaftData& shaft, bool outside, bool inside, std::size_t position) {
  const std::string which = "shaft " + std::to_string(position);
  if (!shaft.is_formed()) {
    kernel::fail(InvalidArgument(which + " was never formed: a default CompiledShaft answers nothing; assign it what " +
                                 "compile() returns, or pass it to compile_batch()"));
  }
  const char* missing = "spheres";
  if (inside && !shaft.answers_inside) missing = "inside";
  if (outside && !shaft.answers_outside) missing = "outside";
  kernel::fail(InvalidArgument(which + " was formed without " + missing + " (see ShaftOptions) and is asked for it"));
}

void refuse_kind(std::size_t position) {
  kernel::fail(InvalidArgument("shaft " + std::to_string(position) +
                               " is that of a moving box or a hull, and is asked what " +
                               "blocks it; only a shaft between two boxes has two ends to hide from each other"));
}

void refuse_contact_of_hull(std::size_t position) {
  kernel::fail(InvalidArgument(
      "shaft " + std::to_string(position) +
      " is a convex hull, whose contact is closed; only shafts between boxes and of moving boxes have " +
      "a choice of contact"));
}

void refuse_exact_test(std::size_t position) {
  kernel::fail(InvalidArgument("shaft " + std::to_string(position) +
                               " is a convex hull, which triangles are compared with by " +
                               "their vertices only; ask it with TriangleTest::vertices"));
}

void refuse_hull(std::size_t position) {
  kernel::fail(InvalidArgument("shaft " + std::to_string(position) +
                               " is a convex hull, in which nothing moves; shafts are asked when they reach a box"));
}

}  // namespace shaftcull::kernel
