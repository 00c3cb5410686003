// SPDX-License-Identifier: MIT
#include "shaftcull/paper.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "formation/join.hpp"
#include "formation/order.hpp"
#include "formation/rule.hpp"
#include "formation/search.hpp"
#include "formation/table.hpp"
#include "formation/usable_box.hpp"
#include "formation/usable_plane.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace shaftcull {

void kernel::refuse_box(const Box& box, const char* name) {
  std::size_t k = 0;  // the first axis that is wrong
  while (std::isfinite(box.lo[k]) && std::isfinite(box.hi[k]) && box.lo[k] <= box.hi[k]) ++k;
  const std::string axis = {'.', "xyz"[k]};
  const std::string box_name = std::string("box ") + name + ": ";
  for (const bool is_hi : {false, true}) {
    const float value = is_hi ? box.hi[k] : box.lo[k];
    if (std::isfinite(value)) continue;
    kernel::fail(InvalidArgument(box_name + (is_hi ? "hi" : "lo") + axis + " = " + text(value) +
                                 "; a shaft joins finite boxes only"));
  }
  kernel::fail(InvalidArgument(box_name + "lo" + axis + " = " + text(box.lo[k]) + " is above hi" + axis + " = " +
                               text(box.hi[k]) + "; lo must be at most hi"));
}

Shaft::Shaft(const Box& a, const Box& b, const ShaftOptions& options) : a_(a), b_(b), options_(options) {
  kernel::in_float_environment([&] {
    kernel::require_finite(a, "a");
    kernel::require_finite(b, "b");
    if (options.order > PlaneOrder::by_added_volume) {
      kernel::fail(InvalidArgument("ShaftOptions::order is none of unsorted, by_volume and by_added_volume"));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      box_.lo[k] = std::min(a.lo[k], b.lo[k]);
      box_.hi[k] = std::max(a.hi[k], b.hi[k]);
    }

    const kernel::Faces6 a_faces = kernel::positions(a);
    const kernel::Faces6 b_faces = kernel::positions(b);
    const auto join_all = [&](const kernel::JoinedEdges& edges) {
      const kernel::JoinedPlanes planes = kernel::join(a_faces, b_faces, edges, false);
      for (std::size_t i = 0; i < edges.count; ++i) {
        const auto [red, blue] = edges.edge[i];
        joining_[i] = {{{0.0F, 0.0F, 0.0F}, planes.offset[i]}, red, blue};
        joining_[i].plane.normal[kernel::axis_of(red)] = planes.red_normal[i];
        joining_[i].plane.normal[kernel::axis_of(blue)] = planes.blue_normal[i];
      }
      joining_count_ = edges.count;
    };
    switch (options.formation) {
      case Formation::search:
        join_all(kernel::search_edges(a_faces, b_faces));
        break;
      case Formation::table64:
        join_all(kernel::table64_edges(a_faces, b_faces));
        break;
      case Formation::table729:
        join_all(kernel::table729_edges(a_faces, b_faces));
        break;
      default:
        kernel::fail(InvalidArgument("ShaftOptions::formation is none of search, table64 and table729"));
    }
    kernel::sort_planes(a, b, options.order, {joining_.data(), joining_count_});
  });
}

void kernel::require_usable(const Plane& plane, const PlaneName& name) {
  const auto fail = [&](const std::string& why) {
    kernel::fail(InvalidArgument(name.before + std::to_string(name.index) + name.after + ": " + why));
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (!std::isfinite(plane.normal[k])) {
      fail(std::string("normal.") + "xyz"[k] + " = " + text(plane.normal[k]) + "; it must be finite");
    }
  }
  if (plane.normal == Vec3{0, 0, 0}) fail("its normal is zero, which leaves no inside and outside to tell apart");
  if (!std::isfinite(plane.offset)) fail("offset = " + text(plane.offset) + "; it must be finite");
}

void Shaft::add_plane(const Plane& plane) {
  kernel::in_float_environment([&] { kernel::require_usable(plane, {"added plane ", added_count_, ""}); });
  if (added_count_ == max_added_planes) {
    kernel::fail(InvalidArgument("added plane " + std::to_string(added_count_) + ": a shaft has room for " +
                                 std::to_string(max_added_planes) + " added planes only"));
  }
  added_[added_count_++] = plane;
}

}  // namespace shaftcull
