// SPDX-License-Identifier: MIT
/// Sources: bounds in the caller's memory, as the C++ interface takes them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "arguments.hpp"

namespace shaftcull::binding {

/// What a source names. Triangles have been copied.
using Source = std::variant<StridedBoxes, StridedCentreExtents, StridedSpheres, std::vector<Triangle>, MeshView,
                            BoxView, SphereView, TriangleView>;

/// Throws InvalidArgument for a kind that there is not, for fields that it does not have, and for NULL.
[[nodiscard]] Source as_source(const shaftcull_source* source, const char* name);

/// Calls use(records), where the type of records is one that the C++ interface has for the source; false if `use` does
/// not take that type.
template <class Use>
[[nodiscard]] bool use_source(const Source& source, Use&& use) {
  return std::visit(
      [&]<class Records>(const Records& records) {
        if constexpr (std::is_same_v<Records, std::vector<Triangle>>) {
          if constexpr (std::is_invocable_v<Use&, std::span<const Triangle>>) {
            use(std::span<const Triangle>(records));
            return true;
          }
        } else if constexpr (std::is_invocable_v<Use&, const Records&>) {
          use(records);
          return true;
        }
        return false;
      },
      source);
}

/// Boxes for a batch of shafts: read where they are, if they are in streams, and packed otherwise.
class BatchBoxes {
 public:
  BatchBoxes(const shaftcull_source* source, const char* name);
  [[nodiscard]] const BoxView& view() const noexcept { return view_; }

 private:
  BoxStream packed_;
  BoxView view_;
};

/// "boxes", "spheres" or "triangles".
[[nodiscard]] std::string name_of_kind(shaftcull_bound_kind kind);

/// "a tree of boxes", say.
[[nodiscard]] std::string name_of(const shaftcull_bounds& bounds);

}  // namespace shaftcull::binding
