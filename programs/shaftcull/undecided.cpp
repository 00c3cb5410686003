// SPDX-License-Identifier: MIT
#include "undecided.hpp"

#include <algorithm>
#include <cstddef>

#include "kernels/table_of_set.hpp"
#include "simd/scalar.hpp"

namespace shaftcull::cli {
namespace {

/// The scalar path, watched: decide_lanes() notes what it is asked.
struct WatchedLanes : kernel::scalar::Floats {
  static inline thread_local std::uint64_t asked = 0;
  static void note_undecided(std::uint64_t lanes) noexcept { asked |= lanes; }
};

const kernel::Kernels& watched = kernel::kernels_for<WatchedLanes>;

template <class View>
void watch(const CompiledShaft& shaft, const View& bounds, kernel::Test* test, std::span<std::uint64_t> asked,
           std::span<std::uint64_t> kept, std::span<std::uint64_t> inside) {
  for (std::size_t w = 0; w != asked.size(); ++w) {
    const std::size_t first = w * kernel::word_bits;
    const View word = bounds.slice(first, std::min<std::size_t>(kernel::word_bits, bounds.count - first));
    WatchedLanes::asked = 0;
    test(kernel::data_of(shaft), word.stream.data(), word.count, &kept[w], &inside[w]);
    asked[w] = WatchedLanes::asked;
  }
}

}  // namespace

void undecided(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> asked,
               std::span<std::uint64_t> kept, std::span<std::uint64_t> inside) {
  watch(shaft, boxes, watched.boxes, asked, kept, inside);
}

void undecided(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> asked,
               std::span<std::uint64_t> kept, std::span<std::uint64_t> inside) {
  watch(shaft, spheres, watched.spheres, asked, kept, inside);
}

}  // namespace shaftcull::cli
