// SPDX-License-Identifier: MIT
/// The attributes, pragmas and functions that g++ and clang have beside C++. No other source has such a word (CTest
/// `compilers`), except __builtin_bit_cast(), which all compilers have.
///
/// The functions are always inlined, for units of different instruction sets include this (kernel/kernels/README.md).
#pragma once

#ifndef __GNUC__
#error "shaftcull is compiled by g++ or clang; for Windows, by those of mingw-w64"
#endif

#include <cstdint>

/// A function that must be inlined, and one that must not. Each stands first in its declaration.
#define SHAFTCULL_ALWAYS_INLINE [[gnu::always_inline]]
#define SHAFTCULL_NOINLINE [[gnu::noinline]]
/// The same as SHAFTCULL_NOINLINE, for a function that is seldom called.
#define SHAFTCULL_COLD [[gnu::noinline, gnu::cold]]
/// Behind the parameters of a lambda that must be inlined.
#define SHAFTCULL_ALWAYS_INLINE_LAMBDA __attribute__((always_inline))
/// A function with an instruction set beside those of its unit.
#define SHAFTCULL_TARGET(name) [[gnu::target(name)]]
/// Before a loop: its body is to be repeated so many times.
#define SHAFTCULL_UNROLL(times) SHAFTCULL_PRAGMA(GCC unroll times)
#define SHAFTCULL_PRAGMA(words) _Pragma(#words)

/// What every processor of the target has.
#if defined(__SSE2__)
#define SHAFTCULL_TARGET_SSE2
#elif defined(__aarch64__)
#define SHAFTCULL_TARGET_ARM64
#endif

/// Whether programs can use a feature of x86, "avx2" for example: the processor has it, and the operating system saves
/// its registers. False on other processors.
#ifdef SHAFTCULL_TARGET_SSE2
#define SHAFTCULL_PROCESSOR_HAS(feature) (__builtin_cpu_init(), __builtin_cpu_supports(feature) != 0)
#else
#define SHAFTCULL_PROCESSOR_HAS(feature) false
#endif

/// Whether there are integers of 128 bits: on 64-bit processors.
#if defined(__SIZEOF_INT128__)
#define SHAFTCULL_HAS_INT128
#endif

namespace shaftcull::kernel {

#ifdef SHAFTCULL_HAS_INT128
__extension__ using Int128 = __int128;
#endif

/// A vector of `count` elements: operators work on each, comparisons give −1 or 0 in integers of the same size, and
/// `mask ? a : b` takes a where the mask is −1. The types of a processor's own intrinsics convert from it and to it.
template <class Element, unsigned count>
struct CompilerVector {
  typedef Element Type __attribute__((vector_size(count * sizeof(Element))));  // NOLINT: `using` has no such attribute
};

/// The same numbers as elements of another type, towards zero. They must fit.
template <class To, class From>
SHAFTCULL_ALWAYS_INLINE inline To converted(From a) noexcept {
  return __builtin_convertvector(a, To);
}

/// How many bits are set.
SHAFTCULL_ALWAYS_INLINE inline int popcount(std::uint64_t word) noexcept { return __builtin_popcountll(word); }

/// The same outside of kernels, in code for all processors of the target: compilers would call a function for those of
/// x86. (H. S. Warren, "Hacker's Delight", 2002.)
SHAFTCULL_ALWAYS_INLINE inline int popcount_anywhere(std::uint64_t word) noexcept {
#if defined(SHAFTCULL_TARGET_SSE2)
  word -= word >> 1U & 0x5555555555555555U;
  word = (word & 0x3333333333333333U) + (word >> 2U & 0x3333333333333333U);
  word = (word + (word >> 4U)) & 0x0f0f0f0f0f0f0f0fU;
  return static_cast<int>(word * 0x0101010101010101U >> 56U);
#else
  return __builtin_popcountll(word);
#endif
}

/// The position of the lowest bit that is set. There must be one.
SHAFTCULL_ALWAYS_INLINE inline int trailing_zeros(std::uint64_t word) noexcept { return __builtin_ctzll(word); }

/// Prefetches a cache line that is soon read, written, or written a while later, into a cache that suits. Any address
/// is allowed.
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_read(const void* line) noexcept { __builtin_prefetch(line); }
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_read_later(const void* line) noexcept {
  __builtin_prefetch(line, 0, 2);
}
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_write(const void* line) noexcept { __builtin_prefetch(line, 1); }
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_write_later(const void* line) noexcept {
  __builtin_prefetch(line, 1, 2);
}

/// Of a number that other threads use at the same time. Relaxed: no other access is put in order by it.
template <class Number>
SHAFTCULL_ALWAYS_INLINE inline Number atomic_load(const Number* number) noexcept {
  return __atomic_load_n(number, __ATOMIC_RELAXED);
}
template <class Number>
SHAFTCULL_ALWAYS_INLINE inline void atomic_add(Number* number, Number more) noexcept {
  __atomic_fetch_add(number, more, __ATOMIC_RELAXED);
}
template <class Number>
SHAFTCULL_ALWAYS_INLINE inline void atomic_or(Number* number, Number bits) noexcept {
  __atomic_fetch_or(number, bits, __ATOMIC_RELAXED);
}
/// Makes the number `wanted` if it is `expected`; otherwise, or for no reason, sets `expected` to what it is.
template <class Number>
SHAFTCULL_ALWAYS_INLINE inline bool atomic_exchange(Number* number, Number& expected, Number wanted) noexcept {
  return __atomic_compare_exchange_n(number, &expected, wanted, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
}

/// The compiler moves no access to memory from one side of this to the other.
SHAFTCULL_ALWAYS_INLINE inline void keep_order_of_memory() noexcept { asm volatile("" : : : "memory"); }

#ifdef SHAFTCULL_TARGET_ARM64
/// Registers with modes and flags of floating-point arithmetic.
SHAFTCULL_ALWAYS_INLINE inline std::uint64_t read_fpcr() noexcept {
  std::uint64_t value;
  asm volatile("mrs %0, fpcr" : "=r"(value));
  return value;
}
SHAFTCULL_ALWAYS_INLINE inline std::uint64_t read_fpsr() noexcept {
  std::uint64_t value;
  asm volatile("mrs %0, fpsr" : "=r"(value));
  return value;
}
SHAFTCULL_ALWAYS_INLINE inline void write_fpcr(std::uint64_t value) noexcept {
  asm volatile("msr fpcr, %0" : : "r"(value));
}
SHAFTCULL_ALWAYS_INLINE inline void write_fpsr(std::uint64_t value) noexcept {
  asm volatile("msr fpsr, %0" : : "r"(value));
}
#endif

}  // namespace shaftcull::kernel
