// SPDX-License-Identifier: MIT
/// Shafts and bounds for the tests of many against many, and the arenas to run them in.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"

#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace shaftcull {

/// Thread counts that results must not depend on; fewer under a sanitizer, which makes each slow.
inline constexpr int all_thread_counts[] = {1, 5, 2};
inline constexpr std::span<const int> thread_counts(all_thread_counts, has_shadow_memory ? 2 : 3);

/// Runs `call` with that many threads, more than there are processors if need be; without oneTBB, just runs it.
template <class Call>
void with_threads([[maybe_unused]] int threads, const Call& call) {
#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena(threads).execute(call);
#else
  call();
#endif
}

/// What counts are filled with before they are asked for, to see what was written.
inline constexpr KeptCounts untouched_counts{SIZE_MAX / 3, SIZE_MAX / 3};

inline std::vector<CompiledShaft> random_shafts(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  std::vector<CompiledShaft> shafts;
  for (std::size_t s = 0; s != count; ++s) {
    shafts.push_back(compile(random.box(-5, 5, 0.2F, 2.0F), random.box(-5, 5, 0.2F, 2.0F)));
    if (s % 4 == 3) set_contact(shafts.back(), Contact::open);
  }
  return shafts;
}

inline std::vector<Box> random_boxes(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i != count; ++i) boxes.push_back(random.box(-5, 5, 0.01F, 0.2F));
  return boxes;
}

inline std::vector<Sphere> random_spheres(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i != count; ++i) spheres.push_back({random.vec3(-5, 5), random.uniform(0.01F, 0.2F)});
  return spheres;
}

/// What classify() says of one shaft: indices, ascending.
struct ExpectedLists {
  std::vector<std::uint32_t> kept;
  std::vector<std::uint32_t> overlap;
  std::vector<std::uint32_t> inside;
};

/// Rows of bits, as classify() gives them shaft by shaft.
struct ExpectedRows {
  std::size_t words;  ///< of a row
  std::vector<std::uint64_t> kept;
  std::vector<std::uint64_t> inside;

  template <class View>
  ExpectedRows(const std::vector<CompiledShaft>& shafts, const View& view)
      : words(bit_words(view.count)), kept(shafts.size() * words), inside(kept.size()) {
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      classify(shafts[s], view, std::span(kept).subspan(s * words, words), std::span(inside).subspan(s * words, words));
    }
  }

  [[nodiscard]] ExpectedLists lists(std::size_t shaft) const {
    ExpectedLists result;
    for (std::size_t w = 0; w != words; ++w) {
      for (std::uint64_t left = kept[shaft * words + w]; left != 0; left &= left - 1) {
        const int bit = std::countr_zero(left);
        const auto index = static_cast<std::uint32_t>(64 * w + static_cast<unsigned>(bit));
        const bool is_inside = (inside[shaft * words + w] >> bit & 1U) != 0;
        result.kept.push_back(index);
        (is_inside ? result.inside : result.overlap).push_back(index);
      }
    }
    return result;
  }
};

}  // namespace shaftcull
