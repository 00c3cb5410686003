// SPDX-License-Identifier: MIT
#include "compiled/answers.hpp"
#include "support/fail.hpp"

#include <string>

#include "shaftcull/error.hpp"

namespace shaftcull::kernel {

void refuse_unformed(std::size_t position) {
  kernel::fail(InvalidArgument("shaft " + std::to_string(position) +
                               " was never formed: a default CompiledShaft answers nothing; assign it what compile() "
                               "returns, or pass it to compile_batch()"));
}

void refuse_kind(std::size_t position) {
  kernel::fail(InvalidArgument("shaft " + std::to_string(position) + " is that of a moving box, and is asked what " +
                               "blocks it; only a shaft between two boxes or polygons has two ends to hide from each " +
                               "other"));
}

void refuse_hull_without_ends(std::size_t position) {
  kernel::fail(InvalidArgument("shaft " + std::to_string(position) +
                               " is a hull of one set of points, and is asked what blocks it; form it by " +
                               "between_polygons(), which tells its two ends apart"));
}

void refuse_hull(std::size_t position) {
  kernel::fail(InvalidArgument("shaft " + std::to_string(position) +
                               " is a convex hull, in which nothing moves; shafts are asked when they reach a box"));
}

}  // namespace shaftcull::kernel
