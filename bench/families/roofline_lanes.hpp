// SPDX-License-Identifier: MIT
/// The kernels of roofline_kernels.hpp over vectors of `L`, a type that only one translation unit has
/// (kernel/kernels/README.md).
#pragma once

#include <cstddef>
#include <cstdint>

#include "families/roofline_kernels.hpp"
#include "support/compiler.hpp"

namespace shaftcull::bench {

template <class L>
float sum_of(typename L::Vector a) noexcept {
  float lanes[L::width];
  L::store(lanes, a);
  return lanes[0] + lanes[L::width - 1];
}

template <class L>
float slab_arithmetic(std::size_t vectors) noexcept {
  // Two independent tests at a time, so that the rate of issue is the limit and not the latency of a chain.
  auto scale = L::all(0.5F);
  auto shift = L::all(0.25F);
  constexpr unsigned chains = 6;
  typename L::Vector extreme[chains];
  for (auto& e : extreme) e = L::all(0.125F);
  for (std::size_t v = 0; v < vectors; v += 2) {
    SHAFTCULL_UNROLL(12)
    for (unsigned i = 0; i < 12; ++i) {
      // Hidden from the optimiser, which knows that the same operands give the same result.
      asm volatile("" : "+v"(scale.data), "+v"(shift.data));
      const auto bound =
          i % 6 == 0 ? scale : L::multiply_add(scale, shift, scale);  // one of six bounds is a coordinate itself
      const unsigned e = i % chains;
      extreme[e] = e % 2 == 0 ? L::minimum(bound, extreme[e]) : L::maximum(bound, extreme[e]);
    }
  }
  auto sum = extreme[0];
  for (unsigned e = 1; e < chains; ++e) sum = L::add(sum, extreme[e]);
  return sum_of<L>(sum);
}

template <class L>
float grid_arithmetic(std::size_t vectors) noexcept {
  using S = typename L::Integers16;
  auto scale = S::all(12345);
  auto coordinate = S::all(23456);
  constexpr unsigned chains = 6;
  typename S::Vector extreme[chains];
  for (auto& e : extreme) e = coordinate;
  for (std::size_t v = 0; v < vectors; v += 4) {  // of floats: two of these
    SHAFTCULL_UNROLL(12)
    for (unsigned i = 0; i < 12; ++i) {
      asm volatile("" : "+v"(scale.data), "+v"(coordinate.data));
      const unsigned e = i % chains;
      const auto bound =
          e == 0 ? coordinate : S::multiply(scale, coordinate);  // that of the reference face is its coordinate
      extreme[e] = e % 2 == 0 ? S::minimum(bound, extreme[e]) : S::maximum(bound, extreme[e]);
    }
  }
  auto sum = extreme[0];
  for (unsigned e = 1; e < chains; ++e) sum = S::add(sum, extreme[e]);
  alignas(64) std::int16_t lanes[S::width];
  sum.store_aligned(lanes);
  return static_cast<float>(lanes[0] + lanes[S::width - 1]);
}

template <class L>
float divide(std::size_t vectors) noexcept {
  auto dividend = L::all(0.5F);
  auto divisor = L::all(3.0F);
  auto quotient = dividend;
  for (std::size_t v = 0; v < vectors; v += 4) {
    SHAFTCULL_UNROLL(4)
    for (unsigned i = 0; i < 4; ++i) {
      asm volatile("" : "+v"(dividend.data), "+v"(divisor.data));
      quotient = L::divide(dividend, divisor);
      asm volatile("" : : "v"(quotient.data));
    }
  }
  return sum_of<L>(quotient);
}

template <class L>
float read(const float* const* stream, std::size_t count) noexcept {
  typename L::Vector seen[6];
  for (auto& each : seen) each = L::all(0.0F);
  const float* at[6];
  for (unsigned s = 0; s < 6; ++s) at[s] = stream[s];
  for (std::size_t i = 0; i < count; i += 2 * L::width) {
    SHAFTCULL_UNROLL(6)
    for (unsigned s = 0; s < 6; ++s) {
      // A bitwise or with what is in memory: no instruction is cheaper.
      seen[s] = seen[s] | L::load(at[s] + i);
      seen[s] = seen[s] | L::load(at[s] + i + L::width);
    }
  }
  auto all = seen[0];
  for (unsigned s = 1; s < 6; ++s) all = all | seen[s];
  return sum_of<L>(all);
}

template <class L>
void write_shafts(CompiledShaft* shafts, std::size_t count) noexcept {
  constexpr std::size_t written = 128;
  const auto value = L::all(1.0F);
  for (std::size_t s = 0; s < count; ++s) {
    auto* const floats = reinterpret_cast<float*>(shafts + s);
    for (std::size_t i = 0; i < written / sizeof(float); i += L::width) L::store(floats + i, value);
  }
}

template <class L>
constexpr RooflineKernels roofline_kernels_for = {L::width, slab_arithmetic<L>, grid_arithmetic<L>, divide<L>,
                                                  read<L>,  write_shafts<L>};

}  // namespace shaftcull::bench
