// SPDX-License-Identifier: MIT
/// entry_times(): of bounds that are named.
#include <limits>
#include <string>

#include "compiled/answers.hpp"
#include "exact/first_entry.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/first_contact.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"
#include "verbs/asked.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

template <class View>
void write_times(const kernel::Asked& asked, std::span<const std::uint32_t> indices, std::span<float> times) {
  const kernel::ShaftData& shaft = asked.shafts()[0];
  const kernel::ScannedBounds& bounds = asked.scanned();
  kernel::KeepsOne* const keeps = asked.kernels().keeps_one(View());
  kernel::in_float_environment([&] {
    const kernel::EntryTimesOf<View> entry(shaft);
    for (std::size_t i = 0; i != indices.size(); ++i) {
      const kernel::BoundPlace bound = bounds.at(bounds.position[indices[i]]);
      float coordinate[6];
      for (std::size_t s = 0; s != View().stream.size(); ++s) coordinate[s] = bound.stream[s][bound.i];
      times[i] = keeps(shaft, coordinate) ? entry.rounded_down(entry.exact(bound.stream, bound.i))
                                          : std::numeric_limits<float>::infinity();
    }
  });
}

}  // namespace

void entry_times(const CompiledShaft& shaft, const Bounds& bounds, std::span<const std::uint32_t> indices,
                 std::span<float> times) {
  kernel::require_below("indices", indices, bounds.size());
  const kernel::Asked asked("entry_times", {&shaft, 1}, bounds, kernel::Question::kept, {.only = indices}, {});
  asked.require_no_triangles();
  kernel::require_motion(asked.shafts()[0], 0);
  if (times.size() != indices.size()) {
    kernel::fail(InvalidArgument("entry_times: times has room for " + std::to_string(times.size()) + " times; " +
                                 kernel::counted_indices(indices.size()) + " need one each"));
  }
  kernel::require_memory("times", times, "times");
  kernel::require_apart("entry_times", "times", kernel::bytes_of(times), "indices", kernel::bytes_of(indices));
  if (asked.kind() == kernel::BoundKind::spheres) {
    write_times<SphereView>(asked, indices, times);
  } else {
    write_times<BoxView>(asked, indices, times);
  }
}

}  // namespace shaftcull
