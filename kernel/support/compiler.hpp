// SPDX-License-Identifier: MIT
/// What compilers spell in their own ways: g++ and clang, clang-cl included, here; MSVC there. No other source has an
/// attribute, a pragma or a function of one compiler (CTest `compilers`), but for __builtin_bit_cast(), which all have.
///
/// The functions are always inlined, for units of different instruction sets include this (kernel/kernels/README.md).
#pragma once

#include <cstdint>

#if defined(__GNUC__) || defined(__clang__)

/// A function that must be inlined, and one that must not. Each stands first in its declaration.
#define SHAFTCULL_ALWAYS_INLINE [[gnu::always_inline]]
#define SHAFTCULL_NOINLINE [[gnu::noinline]]
/// The same as SHAFTCULL_NOINLINE, for a function that is seldom called.
#define SHAFTCULL_COLD [[gnu::noinline, gnu::cold]]
/// Behind the parameters of a lambda that must be inlined.
#define SHAFTCULL_ALWAYS_INLINE_LAMBDA __attribute__((always_inline))
/// A function with an instruction set beside those of its unit.
#define SHAFTCULL_TARGET(name) [[gnu::target(name)]]
/// Behind the name of a typedef: a vector of so many bytes; and such a vector as one of other numbers.
#define SHAFTCULL_VECTOR(bytes) __attribute__((vector_size(bytes)))
#define SHAFTCULL_CONVERT_VECTOR(vector, type) __builtin_convertvector(vector, type)
/// Before a loop: its body is to be repeated so many times.
#define SHAFTCULL_UNROLL(times) SHAFTCULL_PRAGMA(GCC unroll times)
#define SHAFTCULL_PRAGMA(words) _Pragma(#words)

#elif defined(_MSC_VER)

#include <intrin.h>

#include <atomic>

// Multiply-adds are fused only where the code says so. Others are told by a flag (kernel/CMakeLists.txt).
#pragma fp_contract(off)

#define SHAFTCULL_ALWAYS_INLINE [[msvc::forceinline]]
#define SHAFTCULL_NOINLINE [[msvc::noinline]]
#define SHAFTCULL_COLD [[msvc::noinline]]
#define SHAFTCULL_ALWAYS_INLINE_LAMBDA
#define SHAFTCULL_TARGET(name)  // every function may use every intrinsic
#define SHAFTCULL_UNROLL(times)

#else
#error "shaftcull knows g++, clang and MSVC; support/compiler.hpp says what it needs of another compiler"
#endif

/// What every processor of the target has.
#if defined(__SSE2__) || defined(_M_X64)
#define SHAFTCULL_TARGET_SSE2
#elif defined(__aarch64__) || defined(_M_ARM64)
#define SHAFTCULL_TARGET_ARM64
#endif

namespace shaftcull::kernel {

#if defined(__GNUC__) || defined(__clang__)

/// How many bits are set.
SHAFTCULL_ALWAYS_INLINE inline int popcount(std::uint64_t word) noexcept { return __builtin_popcountll(word); }

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

#ifdef SHAFTCULL_TARGET_SSE2
/// What the processor says of itself: EAX, EBX, ECX and EDX. Takes long, on a virtual machine most of all.
SHAFTCULL_ALWAYS_INLINE inline void cpuid(std::uint32_t leaf, std::uint32_t (&registers)[4]) noexcept {
  asm volatile("cpuid"
               : "=a"(registers[0]), "=b"(registers[1]), "=c"(registers[2]), "=d"(registers[3])
               : "a"(leaf), "c"(0));
}
/// Which registers the operating system saves. Only for processors with OSXSAVE.
SHAFTCULL_ALWAYS_INLINE inline std::uint64_t read_xcr0() noexcept {
  std::uint32_t low;
  std::uint32_t high;
  asm volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return std::uint64_t{high} << 32U | low;
}
#endif

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

#else

// Not __popcnt64(), an instruction that not every processor has.
SHAFTCULL_ALWAYS_INLINE inline int popcount(std::uint64_t word) noexcept {
  word -= word >> 1U & 0x5555'5555'5555'5555U;
  word = (word & 0x3333'3333'3333'3333U) + (word >> 2U & 0x3333'3333'3333'3333U);
  return static_cast<int>((word + (word >> 4U) & 0x0f0f'0f0f'0f0f'0f0fU) * 0x0101'0101'0101'0101U >> 56U);
}
SHAFTCULL_ALWAYS_INLINE inline int trailing_zeros(std::uint64_t word) noexcept {
  unsigned long position;
  _BitScanForward64(&position, word);
  return static_cast<int>(position);
}

#ifdef SHAFTCULL_TARGET_ARM64
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_read(const void* line) noexcept { __prefetch(line); }
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_read_later(const void* line) noexcept { __prefetch2(line, 2); }
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_write(const void* line) noexcept { __prefetch2(line, 16); }
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_write_later(const void* line) noexcept { __prefetch2(line, 18); }
#else
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_read(const void* line) noexcept {
  _mm_prefetch(static_cast<const char*>(line), _MM_HINT_T0);
}
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_read_later(const void* line) noexcept {
  _mm_prefetch(static_cast<const char*>(line), _MM_HINT_T1);
}
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_write(const void* line) noexcept { prefetch_to_read(line); }
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_write_later(const void* line) noexcept { prefetch_to_read_later(line); }
#endif

template <class Number>
SHAFTCULL_ALWAYS_INLINE inline Number atomic_load(const Number* number) noexcept {
  return std::atomic_ref(const_cast<Number&>(*number)).load(std::memory_order_relaxed);
}
template <class Number>
SHAFTCULL_ALWAYS_INLINE inline void atomic_add(Number* number, Number more) noexcept {
  std::atomic_ref(*number).fetch_add(more, std::memory_order_relaxed);
}
template <class Number>
SHAFTCULL_ALWAYS_INLINE inline void atomic_or(Number* number, Number bits) noexcept {
  std::atomic_ref(*number).fetch_or(bits, std::memory_order_relaxed);
}
template <class Number>
SHAFTCULL_ALWAYS_INLINE inline bool atomic_exchange(Number* number, Number& expected, Number wanted) noexcept {
  return std::atomic_ref(*number).compare_exchange_weak(expected, wanted, std::memory_order_relaxed);
}

#ifdef SHAFTCULL_TARGET_SSE2
SHAFTCULL_ALWAYS_INLINE inline void cpuid(std::uint32_t leaf, std::uint32_t (&registers)[4]) noexcept {
  __cpuidex(reinterpret_cast<int*>(registers), static_cast<int>(leaf), 0);
}
SHAFTCULL_ALWAYS_INLINE inline std::uint64_t read_xcr0() noexcept { return _xgetbv(0); }
#endif

SHAFTCULL_ALWAYS_INLINE inline void keep_order_of_memory() noexcept { _ReadWriteBarrier(); }

#ifdef SHAFTCULL_TARGET_ARM64
SHAFTCULL_ALWAYS_INLINE inline std::uint64_t read_fpcr() noexcept { return _ReadStatusReg(ARM64_FPCR); }
SHAFTCULL_ALWAYS_INLINE inline std::uint64_t read_fpsr() noexcept { return _ReadStatusReg(ARM64_FPSR); }
SHAFTCULL_ALWAYS_INLINE inline void write_fpcr(std::uint64_t value) noexcept { _WriteStatusReg(ARM64_FPCR, value); }
SHAFTCULL_ALWAYS_INLINE inline void write_fpsr(std::uint64_t value) noexcept { _WriteStatusReg(ARM64_FPSR, value); }
#endif

#endif

}  // namespace shaftcull::kernel
