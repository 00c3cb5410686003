// SPDX-License-Identifier: MIT
/// any_many().
#include "dispatch/active_kernels.hpp"
#include "flat/batch_job.hpp"
#include "flat/shaft_bits.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull {
namespace {

template <class View>
void find_any(std::span<const kernel::ShaftData> shafts, const View& bounds, std::span<std::uint64_t> any) {
  kernel::require_valid_query(shafts, bounds, kernel::Bits::kept);
  kernel::require_shaft_bits("any", any, shafts.size());
  kernel::Test* const test = kernel::active_kernels().test(bounds);
  kernel::find_by_shaft(shafts.size(), bounds, any, [&](std::size_t s, const View& tile, std::uint64_t* kept) {
    test(shafts[s], tile.stream.data(), tile.count, kept, nullptr);
  });
}

}  // namespace

void any_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::span<std::uint64_t> any) {
  find_any(kernel::data_of(shafts), boxes, any);
}

void any_many(std::span<const CompiledShaft> shafts, const SphereView& spheres, std::span<std::uint64_t> any) {
  find_any(kernel::data_of(shafts), spheres, any);
}

}  // namespace shaftcull
