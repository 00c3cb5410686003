// SPDX-License-Identifier: MIT
/// Vectors of numbers without intrinsics: those of the compilers, g++ and clang, and arrays for a compiler that has
/// none, with the same operators.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "support/compiler.hpp"

#if !defined(SHAFTCULL_COMPILER_VECTORS) && (defined(__GNUC__) || defined(__clang__))
#define SHAFTCULL_COMPILER_VECTORS 1
#endif

namespace shaftcull::kernel {

#if SHAFTCULL_COMPILER_VECTORS

/// A vector of `count` elements: operators work on each, comparisons give −1 or 0 in integers of the same size. The
/// types of a processor's own intrinsics convert from it and to it.
template <class Element, unsigned count>
struct CompilerVector {
  typedef Element Type SHAFTCULL_VECTOR(count * sizeof(Element));  // NOLINT: `using` has no such attribute
};

/// a where the mask is −1, b where it is 0.
template <class Mask, class Vector>
SHAFTCULL_ALWAYS_INLINE inline Vector where(Mask mask, Vector a, Vector b) noexcept {
  return mask ? a : b;
}

/// The same numbers as elements of another type, towards zero. They must fit.
template <class To, class From>
SHAFTCULL_ALWAYS_INLINE inline To converted(From a) noexcept {
  return SHAFTCULL_CONVERT_VECTOR(a, To);
}

#else

template <std::size_t bytes>
using SignedOfBytes =
    std::conditional_t<bytes == 8, std::int64_t, std::conditional_t<bytes == 4, std::int32_t, std::int16_t> >;

template <class Element, unsigned count>
struct ArrayVector {
  using Mask = ArrayVector<SignedOfBytes<sizeof(Element)>, count>;

  Element of[count];

  ArrayVector() noexcept = default;
  SHAFTCULL_ALWAYS_INLINE ArrayVector(Element a) noexcept {  // NOLINT: a number stands for as many in all of them
    for (Element& each : of) each = a;
  }

  SHAFTCULL_ALWAYS_INLINE Element& operator[](unsigned i) noexcept { return of[i]; }
  SHAFTCULL_ALWAYS_INLINE const Element& operator[](unsigned i) const noexcept { return of[i]; }

#define SHAFTCULL_OPERATOR(op)                                                                           \
  SHAFTCULL_ALWAYS_INLINE friend ArrayVector operator op(ArrayVector a, const ArrayVector& b) noexcept { \
    for (unsigned i = 0; i < count; ++i) a.of[i] = static_cast<Element>(a.of[i] op b.of[i]);             \
    return a;                                                                                            \
  }                                                                                                      \
  SHAFTCULL_ALWAYS_INLINE ArrayVector& operator op##=(const ArrayVector& b) noexcept { return *this = *this op b; }
#define SHAFTCULL_COMPARISON(op)                                                                         \
  SHAFTCULL_ALWAYS_INLINE friend Mask operator op(const ArrayVector& a, const ArrayVector& b) noexcept { \
    Mask mask;                                                                                           \
    for (unsigned i = 0; i < count; ++i) mask.of[i] = a.of[i] op b.of[i] ? -1 : 0;                       \
    return mask;                                                                                         \
  }
  SHAFTCULL_OPERATOR(+)
  SHAFTCULL_OPERATOR(-)
  SHAFTCULL_OPERATOR(*)
  SHAFTCULL_OPERATOR(/)
  SHAFTCULL_OPERATOR(&)
  SHAFTCULL_OPERATOR(|)
  SHAFTCULL_OPERATOR(^)
  SHAFTCULL_OPERATOR(<<)
  SHAFTCULL_OPERATOR(>>)
  SHAFTCULL_COMPARISON(<)
  SHAFTCULL_COMPARISON(<=)
  SHAFTCULL_COMPARISON(>)
  SHAFTCULL_COMPARISON(>=)
#undef SHAFTCULL_OPERATOR
#undef SHAFTCULL_COMPARISON
  SHAFTCULL_ALWAYS_INLINE friend ArrayVector operator~(ArrayVector a) noexcept {
    for (Element& each : a.of) each = static_cast<Element>(~each);
    return a;
  }
};

template <class Element, unsigned count>
struct CompilerVector {
  using Type = ArrayVector<Element, count>;
};

template <class Mask, class Element, unsigned count>
SHAFTCULL_ALWAYS_INLINE inline ArrayVector<Element, count> where(const Mask& mask, ArrayVector<Element, count> a,
                                                                 const ArrayVector<Element, count>& b) noexcept {
  for (unsigned i = 0; i < count; ++i) a.of[i] = mask.of[i] != 0 ? a.of[i] : b.of[i];
  return a;
}

template <class To, class Element, unsigned count>
SHAFTCULL_ALWAYS_INLINE inline To converted(const ArrayVector<Element, count>& a) noexcept {
  To to;
  for (unsigned i = 0; i < count; ++i) to.of[i] = static_cast<std::remove_reference_t<decltype(to.of[i])> >(a.of[i]);
  return to;
}

#endif

}  // namespace shaftcull::kernel
