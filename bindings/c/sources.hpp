// SPDX-License-Identifier: MIT
/// Sources: bounds in the caller's memory, as the C++ interface takes them.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "arguments.hpp"

namespace shaftcull::binding {

/// The bounds of a source. Triangles have been copied.
using Source = std::variant<StridedBoxes, StridedCentreExtents, StridedSpheres, std::vector<Triangle>, MeshView,
                            BoxView, SphereView, TriangleView>;

/// Throws InvalidArgument for an unknown kind, for fields that are not 0 though the kind has no such field, and for a
/// NULL pointer to records.
[[nodiscard]] Source as_source(const shaftcull_source* source, const char* name);

/// Whether the source has a count of boxes, spheres or triangles, and no data. Throws for fields as as_source().
[[nodiscard]] bool has_no_data(const shaftcull_source& source, const char* name);

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

/// The boxes of a source in streams: where they are, if they are in streams, and copied otherwise. Copies of records
/// are not checked: calls that take the view check the boxes that they use. Copying one box allocates nothing.
class BoxesInStreams {
 public:
  BoxesInStreams(const shaftcull_source* source, const char* name);
  BoxesInStreams(const BoxesInStreams&) = delete;
  BoxesInStreams& operator=(const BoxesInStreams&) = delete;
  [[nodiscard]] const BoxView& view() const noexcept { return view_; }

 private:
  void copy(const StridedBoxes& records);

  std::array<float, 6> one_{};
  std::vector<float> many_;
  BoxStream packed_;
  BoxView view_;
};

}  // namespace shaftcull::binding
