/// entry_times(): of boxes that are named, in a view or a tree.
#include <limits>
#include <string>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "exact/entry_time.hpp"
#include "refine/positions.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/first_contact.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

/// Checks what is asked, but for the view or tree.
template <class Index>
void require_askable(const kernel::ShaftData& shaft, std::size_t count, std::span<const Index> indices,
                     std::span<float> times) {
  kernel::require_answers(shaft, true, false, false, 0);
  kernel::require_motion(shaft, 0);
  kernel::require_below("indices", indices, count);
  if (times.size() != indices.size()) {
    throw InvalidArgument("entry_times: times has room for " + std::to_string(times.size()) + " times; " +
                          kernel::counted_indices(indices.size()) + " need one each");
  }
  kernel::require_memory("times", times, "times");
  kernel::require_apart("entry_times", "times", kernel::bytes_of(times), "indices", kernel::bytes_of(indices));
}

template <class Index, class Position>
void write_times(const kernel::ShaftData& shaft, const BoxView& boxes, std::span<const Index> indices,
                 const Position& position, std::span<float> times) {
  kernel::KeepsOne* const keeps = kernel::active_kernels().keeps_one(boxes);
  kernel::in_float_environment([&] {
    const kernel::EntryTimes entry(shaft);
    for (std::size_t i = 0; i != indices.size(); ++i) {
      const BoxView box = boxes.slice(position(indices[i]), 1);
      times[i] = keeps(shaft, box.stream.data()) ? entry.rounded_down(entry.exact(box.stream.data(), 0))
                                                 : std::numeric_limits<float>::infinity();
    }
  });
}

template <class Index>
void write_times_in_view(const CompiledShaft& shaft, const BoxView& boxes, std::span<const Index> indices,
                         std::span<float> times) {
  kernel::require_view(boxes);
  require_askable(kernel::data_of(shaft), boxes.count, indices, times);
  write_times(kernel::data_of(shaft), boxes, indices, kernel::PositionInView(), times);
}

}  // namespace

void entry_times(const CompiledShaft& shaft, const BoxView& boxes, std::span<const std::uint32_t> indices,
                 std::span<float> times) {
  write_times_in_view(shaft, boxes, indices, times);
}
void entry_times(const CompiledShaft& shaft, const BoxView& boxes, std::span<const std::uint64_t> indices,
                 std::span<float> times) {
  write_times_in_view(shaft, boxes, indices, times);
}

template <BoundIndex Index>
void entry_times(const CompiledShaft& shaft, const BoundsTree<Box, Index>& tree,
                 std::type_identity_t<std::span<const Index>> indices, std::span<float> times) {
  kernel::require_refitted("entry_times", tree);
  require_askable<Index>(kernel::data_of(shaft), tree.size(), indices, times);
  write_times<Index>(kernel::data_of(shaft), tree.leaves(), indices, kernel::places_of(tree), times);
}

template void entry_times(const CompiledShaft&, const BoundsTree<Box, std::uint32_t>&, std::span<const std::uint32_t>,
                          std::span<float>);
template void entry_times(const CompiledShaft&, const BoundsTree<Box, std::uint64_t>&, std::span<const std::uint64_t>,
                          std::span<float>);

}  // namespace shaftcull
