#define xsimd xsimd_unfiltered_avx2
#include "simd/lanes.hpp"
#include "test/box_slab.hpp"
#include "unfiltered.hpp"

namespace shaftcull::bench {
namespace {

struct UnfilteredLanes : kernel::Lanes<xsimd::fma3<xsimd::avx2>> {};

template <unsigned uppers>
void cull_words(const CompiledShaft& shaft, const float* const* stream, std::size_t words, std::uint64_t* kept) noexcept {
  using L = UnfilteredLanes;
  const kernel::Slab<L, uppers, CompiledShaft::SlabForm::fused> slab(shaft, 0.0F);
  const float* x[6];
  for (unsigned i = 0; i < 6; ++i) x[i] = stream[shaft.slab_near[i]];
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t outside = 0;
#pragma GCC unroll 2
    for (unsigned four = 0; four < kernel::word_bits; four += 4 * L::width) {
      L::Vector room[4];
#pragma GCC unroll 4
      for (unsigned v = 0; v < 4; ++v) {
        const std::size_t at = w * kernel::word_bits + four + v * L::width;
        room[v] = slab.room([&](unsigned i) { return L::load(x[i] + at); });
      }
      outside |= L::signs(room) << four;
    }
    kept[w] = ~outside;
  }
}

}  // namespace

void cull_unfiltered_avx2(const CompiledShaft& shaft, const BoxView& boxes, std::size_t words, std::uint64_t* kept) noexcept {
  using Words = void(const CompiledShaft&, const float* const*, std::size_t, std::uint64_t*) noexcept;
  static constexpr Words* by_uppers[6] = {cull_words<1>, cull_words<2>, cull_words<3>,
                                          cull_words<4>, cull_words<5>, cull_words<6>};
  by_uppers[shaft.slab_uppers - 1](shaft, boxes.stream.data(), words, kept);
}

float slab_arithmetic_avx2(std::size_t vectors) noexcept {
  using L = UnfilteredLanes;
  // Two independent tests at a time, so that the rate of issue is the limit and not the latency of a chain.
  L::Vector scale = L::all(0.5F);
  L::Vector shift = L::all(0.25F);
  L::Vector bound[12];
  for (auto& b : bound) b = L::all(0.125F);
  L::Vector extreme[4] = {L::all(1.0F), L::all(0.0F), L::all(1.0F), L::all(0.0F)};
  for (std::size_t v = 0; v < vectors; v += 2) {
#pragma GCC unroll 12
    for (unsigned i = 0; i < 12; ++i) {
      // Hidden from the optimiser, which knows that the same operands give the same result.
      asm volatile("" : "+x"(scale.data), "+x"(shift.data));
      bound[i] = L::multiply_add(scale, shift, scale);
      const unsigned e = i % 4;
      extreme[e] = e % 2 == 0 ? L::minimum(bound[i], extreme[e]) : L::maximum(bound[i], extreme[e]);
    }
  }
  float sum[L::width];
  L::store(sum, L::add(L::add(extreme[0], extreme[1]), L::add(extreme[2], extreme[3])));
  return sum[0];
}

}  // namespace shaftcull::bench
