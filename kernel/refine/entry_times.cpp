// SPDX-License-Identifier: MIT
/// entry_times(): of boxes that are named, in a view or a tree.
#include <limits>
#include <string>
#include <type_traits>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "exact/first_entry.hpp"
#include "refine/positions.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/first_contact.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

/// Checks what is asked, but for the view or tree.
template <class View>
void require_askable(const kernel::ShaftData& shaft, std::size_t count, std::span<const std::uint32_t> indices,
                     std::span<float> times) {
  kernel::require_answers(shaft, true, false, std::is_same_v<View, SphereView>, 0);
  kernel::require_motion(shaft, 0);
  kernel::require_below("indices", indices, count);
  if (times.size() != indices.size()) {
    kernel::fail(InvalidArgument("entry_times: times has room for " + std::to_string(times.size()) + " times; " +
                                 kernel::counted_indices(indices.size()) + " need one each"));
  }
  kernel::require_memory("times", times, "times");
  kernel::require_apart("entry_times", "times", kernel::bytes_of(times), "indices", kernel::bytes_of(indices));
}

template <class View, class Position>
void write_times(const kernel::ShaftData& shaft, const View& bounds, std::span<const std::uint32_t> indices,
                 const Position& position, std::span<float> times) {
  kernel::KeepsOne* const keeps = kernel::active_kernels().keeps_one(bounds);
  kernel::in_float_environment([&] {
    const kernel::EntryTimesOf<View> entry(shaft);
    for (std::size_t i = 0; i != indices.size(); ++i) {
      const View bound = bounds.slice(position(indices[i]), 1);
      times[i] = keeps(shaft, bound.stream.data()) ? entry.rounded_down(entry.exact(bound.stream.data(), 0))
                                                   : std::numeric_limits<float>::infinity();
    }
  });
}

template <class View>
void write_times_in_view(const CompiledShaft& shaft, const View& bounds, std::span<const std::uint32_t> indices,
                         std::span<float> times) {
  kernel::require_view(bounds);
  require_askable<View>(kernel::data_of(shaft), bounds.count, indices, times);
  write_times(kernel::data_of(shaft), bounds, indices, kernel::PositionInView(), times);
}

}  // namespace

void entry_times(const CompiledShaft& shaft, const BoxView& boxes, std::span<const std::uint32_t> indices,
                 std::span<float> times) {
  write_times_in_view(shaft, boxes, indices, times);
}
void entry_times(const CompiledShaft& shaft, const SphereView& spheres, std::span<const std::uint32_t> indices,
                 std::span<float> times) {
  write_times_in_view(shaft, spheres, indices, times);
}

template <class Bound>
void entry_times(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<const std::uint32_t> indices,
                 std::span<float> times) {
  kernel::require_refitted("entry_times", tree);
  require_askable<ViewOf<Bound>>(kernel::data_of(shaft), tree.size(), indices, times);
  write_times<ViewOf<Bound>>(kernel::data_of(shaft), tree.leaves(), indices, kernel::places_of(tree), times);
}

#define SHAFTCULL_ENTRY_TIMES(Bound)                                                                        \
  template void entry_times(const CompiledShaft&, const BoundsTree<Bound>&, std::span<const std::uint32_t>, \
                            std::span<float>);
SHAFTCULL_ENTRY_TIMES(Box)
SHAFTCULL_ENTRY_TIMES(Sphere)
#undef SHAFTCULL_ENTRY_TIMES

}  // namespace shaftcull
