/// any_many(): a task tests its bounds tile by tile, each with those shafts only that have kept nothing yet.
#include <algorithm>
#include <atomic>
#include <bit>
#include <limits>

#include "dispatch/active_kernels.hpp"
#include "flat/batch_job.hpp"
#include "parallel/parallel.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull {
namespace {

template <class View>
void find_any(std::span<const kernel::ShaftData> shafts, const View& bounds, std::span<std::uint64_t> any, Form form) {
  kernel::require_valid_query(shafts, bounds, kernel::Bits::kept, form);
  kernel::require_shaft_bits("any", any, shafts.size());
  std::fill(any.begin(), any.end(), 0);
  kernel::Test* const test = kernel::active_kernels().test(bounds, form);
  const kernel::Tiling tiling = kernel::Tiling::unordered(bounds.count, shafts.size());
  static_assert(kernel::group_shafts == std::numeric_limits<std::uint64_t>::digits, "a group's bits are one word");
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const kernel::IndexRange block = tiling.block(b);
    const kernel::IndexRange group = tiling.group(g);
    const std::uint64_t all = ~std::uint64_t{0} >> (kernel::group_shafts - group.size);
    const std::atomic_ref<std::uint64_t> found(any[g]);
    for (std::size_t first = block.first; first != block.end();) {
      const View tile = bounds.slice(first, std::min(kernel::float_tile_bounds, block.end() - first));
      std::uint64_t found_here = 0;
      std::uint64_t left = all & ~found.load(std::memory_order_relaxed);
      if (left == 0) return;
      for (; left != 0; left &= left - 1) {
        const auto s = static_cast<std::size_t>(std::countr_zero(left));
        std::uint64_t kept[words_for(kernel::float_tile_bounds)];
        test(shafts[group.first + s], tile.stream.data(), tile.count, kept, nullptr);
        const bool is_any =
            std::any_of(kept, kept + words_for(tile.count), [](std::uint64_t word) { return word != 0; });
        found_here |= std::uint64_t{is_any} << s;
      }
      found.fetch_or(found_here, std::memory_order_relaxed);
      first += tile.count;
    }
  });
}

}  // namespace

void any_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::span<std::uint64_t> any, Form form) {
  find_any(kernel::data_of(shafts), boxes, any, form);
}

void any_many(std::span<const CompiledShaft> shafts, const SphereView& spheres, std::span<std::uint64_t> any,
              Form form) {
  find_any(kernel::data_of(shafts), spheres, any, form);
}

}  // namespace shaftcull
