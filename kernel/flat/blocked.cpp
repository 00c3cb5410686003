// SPDX-License-Identifier: MIT
/// blocked() and its like of a box and of views, but for lists of many shafts, which lists.cpp makes.
#include "shaftcull/blocked.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "exact/blocking.hpp"
#include "exact/polygon.hpp"
#include "flat/shaft_bits.hpp"
#include "kernels/table.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace shaftcull {
namespace {

/// Most boxes in a chunk, whose bits stay on the stack.
constexpr std::size_t chunk_boxes = 16384;
/// In the first chunk; each has twice as many as the one before.
constexpr std::size_t first_boxes = 512;

/// The shaft, if it can be asked about these boxes; otherwise throws InvalidArgument.
const kernel::ShaftData& checked(const CompiledShaft& shaft, const BoxView& solids) {
  const kernel::ShaftData& data = kernel::data_of(shaft);
  kernel::require_two_ends(data, 0);
  kernel::require_view(solids);
  return data;
}

/// Calls visit(first, bits, words) for chunk after chunk, the bits of those boxes from `first` on that block the shaft,
/// until it returns false.
template <class Visit>
void for_each_chunk(const kernel::ShaftData& shaft, const BoxView& solids, std::size_t chunk, const Visit& visit) {
  kernel::Test* const test = kernel::active_kernels().blocking.boxes;
  const kernel::FloatEnvironment environment;
  std::uint64_t blocking[words_for(chunk_boxes)];
  for (std::size_t first = 0; first != solids.count;) {
    const BoxView part = solids.slice(first, std::min(chunk, solids.count - first));
    test(shaft, part.stream.data(), part.count, blocking, nullptr);
    if (!visit(first, blocking, words_for(part.count))) return;
    first += part.count;
    chunk = std::min(2 * chunk, chunk_boxes);
  }
}

std::size_t list_blockers(const CompiledShaft& shaft, const BoxView& solids, std::span<std::uint32_t> blocking) {
  const kernel::ShaftData& data = checked(shaft, solids);
  kernel::require_index_width("list_blocking()", solids.count);
  kernel::require_memory("blocking", blocking, "indices");
  std::size_t count = 0;
  for_each_chunk(data, solids, chunk_boxes, [&](std::size_t first, const std::uint64_t* bits, std::size_t words) {
    for (std::size_t w = 0; w != words; ++w) {
      for (std::uint64_t left = bits[w]; left != 0; left &= left - 1, ++count) {
        const std::size_t index = first + w * 64 + static_cast<std::size_t>(std::countr_zero(left));
        if (count < blocking.size()) blocking[count] = static_cast<std::uint32_t>(index);
      }
    }
    return true;
  });
  return count;
}

}  // namespace

bool blocked(const CompiledShaft& shaft, const Box& solid) {
  const kernel::ShaftData& data = kernel::data_of(shaft);
  kernel::require_two_ends(data, 0);
  const float bound[6] = {solid.lo[0], solid.lo[1], solid.lo[2], solid.hi[0], solid.hi[1], solid.hi[2]};
  return kernel::in_float_environment([&] { return kernel::box_blocks(data, bound); });
}

bool blocked(const CompiledShaft& shaft, std::span<const Vec3> polygon) {
  const kernel::ShaftData& data = kernel::data_of(shaft);
  kernel::require_two_ends(data, 0);
  kernel::require_memory("polygon", polygon, "corners");
  if (polygon.size() < 3) {
    kernel::fail(
        InvalidArgument("polygon has " + kernel::counted(polygon.size(), "corner") + "; it takes three or more"));
  }
  for (std::size_t i = 0; i != polygon.size(); ++i) {
    const Vec3& corner = polygon[i];
    if (std::all_of(corner.begin(), corner.end(), [](float x) { return std::isfinite(x); })) continue;
    kernel::fail(InvalidArgument("polygon[" + std::to_string(i) + "] is not finite; corners are points"));
  }
  return kernel::in_float_environment([&] { return kernel::polygon_blocks(data, polygon); });
}

bool blocked(const CompiledShaft& shaft, const BoxView& solids) { return blocked_by(shaft, solids).has_value(); }

std::optional<std::size_t> blocked_by(const CompiledShaft& shaft, const BoxView& solids) {
  std::optional<std::size_t> blocker;
  for_each_chunk(checked(shaft, solids), solids, first_boxes,
                 [&](std::size_t first, const std::uint64_t* blocking, std::size_t words) {
                   const std::uint64_t* const word =
                       std::find_if(blocking, blocking + words, [](std::uint64_t bits) { return bits != 0; });
                   if (word == blocking + words) return true;
                   blocker = first + static_cast<std::size_t>(word - blocking) * 64 +
                             static_cast<std::size_t>(std::countr_zero(*word));
                   return false;
                 });
  return blocker;
}

std::size_t list_blocking(const CompiledShaft& shaft, const BoxView& solids, std::span<std::uint32_t> blocking) {
  return list_blockers(shaft, solids, blocking);
}

void blocked_many(std::span<const CompiledShaft> shafts, const BoxView& solids, std::span<std::uint64_t> blocked) {
  const std::span<const kernel::ShaftData> data = kernel::data_of(shafts);
  kernel::require_memory("shafts", shafts, "shafts");
  kernel::require_view(solids);
  for (std::size_t s = 0; s != data.size(); ++s) kernel::require_two_ends(data[s], s);
  kernel::require_shaft_bits("blocked", blocked, data.size());
  kernel::Test* const test = kernel::active_kernels().blocking.boxes;
  kernel::find_by_shaft(data.size(), solids, blocked, [&](std::size_t s, const BoxView& tile, std::uint64_t* blocking) {
    test(data[s], tile.stream.data(), tile.count, blocking, nullptr);
  });
}

}  // namespace shaftcull
