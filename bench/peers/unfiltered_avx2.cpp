// SPDX-License-Identifier: MIT
#include "compiled/shaft_data.hpp"
#include "kernels/boxes/slab_interval.hpp"
#include "kernels/shared/word.hpp"
#include "peers/unfiltered.hpp"
#include "simd/x86/avx2.hpp"
#include "support/compiler.hpp"

namespace shaftcull::bench {
namespace {

struct UnfilteredLanes : kernel::avx2::Floats {};

template <unsigned uppers>
void cull_words(const kernel::ShaftData& shaft, const float* const* stream, std::size_t words,
                std::uint64_t* kept) noexcept {
  using L = UnfilteredLanes;
  const kernel::Slab<L, uppers, kernel::ShaftData::SlabForm::fused> slab(shaft, 0.0F, true);
  const float* x[6];
  for (unsigned i = 0; i < 6; ++i) x[i] = stream[shaft.slab_near[i]];
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t outside = 0;
    SHAFTCULL_UNROLL(2)
    for (unsigned four = 0; four < kernel::word_bits; four += 4 * L::width) {
      L::Vector length[4];
      SHAFTCULL_UNROLL(4)
      for (unsigned v = 0; v < 4; ++v) {
        const std::size_t at = w * kernel::word_bits + four + v * L::width;
        length[v] = slab.interval_length([&](unsigned i) { return L::load(x[i] + at); });
      }
      outside |= L::signs(length) << four;
    }
    kept[w] = ~outside;
  }
}

}  // namespace

void cull_unfiltered_avx2(const CompiledShaft& shaft, const BoxView& boxes, std::size_t words,
                          std::uint64_t* kept) noexcept {
  using Words = void(const kernel::ShaftData&, const float* const*, std::size_t, std::uint64_t*) noexcept;
  static constexpr Words* by_uppers[7] = {nullptr,       cull_words<1>, cull_words<2>, cull_words<3>,
                                          cull_words<4>, cull_words<5>, cull_words<6>};
  const kernel::ShaftData& data = kernel::data_of(shaft);
  by_uppers[data.slab_uppers](data, boxes.stream.data(), words, kept);
}

}  // namespace shaftcull::bench
