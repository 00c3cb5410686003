// SPDX-License-Identifier: MIT
/// Exact sums and products of doubles as expansions: unevaluated sums of doubles that do not overlap.
///
/// J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
/// Discrete & Computational Geometry 18, 1997: two_sum (Theorem 7), two_product (Theorem 18, with the split of
/// Theorem 17), grow_expansion (Theorem 10), scale_expansion (Theorem 19). Needs round-to-nearest doubles without
/// contraction or excess precision, and no over- or underflow: products of up to four differences of floats keep to
/// 2^±700.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

/// a + b = sum + error exactly.
struct TwoTerms {
  double sum;
  double error;
};

inline TwoTerms two_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double b_virtual = sum - a;
  const double a_virtual = sum - b_virtual;
  return {sum, (a - a_virtual) + (b - b_virtual)};
}

/// The smallest float that is at least a + b, or +∞.
inline float sum_rounded_up(double a, double b) noexcept {
  const TwoTerms exact = two_sum(a, b);  // the error is NaN if the sum is infinite
  const auto nearest = static_cast<float>(exact.sum);
  const bool is_below = nearest < exact.sum || (nearest == exact.sum && exact.error > 0);
  return is_below ? std::nextafter(nearest, HUGE_VALF) : nearest;
}

/// The largest float that is at most a + b, or −∞.
inline float sum_rounded_down(double a, double b) noexcept { return -sum_rounded_up(-a, -b); }

inline TwoTerms two_product(double a, double b) noexcept {
  constexpr double splitter = 134217729.0;  // 2^27 + 1 halves a 53-bit significand
  const auto high = [](double x) {
    const double c = splitter * x;
    return c - (c - x);
  };
  const double product = a * b;
  const double a_high = high(a);
  const double a_low = a - a_high;
  const double b_high = high(b);
  const double b_low = b - b_high;
  const double error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
  return {product, error};
}

/// The exact sum of up to N doubles, smallest magnitude first, zeros left out. The empty sum is 0.
template <std::size_t N>
class Expansion {
 public:
  Expansion() noexcept = default;
  explicit Expansion(double value) noexcept { append(value); }
  Expansion(const Expansion& other) noexcept { *this = other; }
  Expansion& operator=(const Expansion& other) noexcept {  // copies what is there, not all of N
    for (std::size_t i = 0; i < other.size_; ++i) terms_[i] = other.terms_[i];
    size_ = other.size_;
    return *this;
  }
  ~Expansion() = default;

  /// The exact value a − b.
  static Expansion difference(double a, double b) noexcept requires(N == 2) {
    const TwoTerms d = two_sum(a, -b);
    Expansion result;
    result.append(d.error);
    result.append(d.sum);
    return result;
  }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] double operator[](std::size_t i) const noexcept { return terms_[i]; }

  /// −1, 0 or 1: the largest term outweighs all others.
  [[nodiscard]] int sign() const noexcept {
    if (size_ == 0) return 0;
    return terms_[size_ - 1] > 0 ? 1 : -1;
  }

  /// Adds one double; the caller keeps the number of terms within N.
  void grow(double value) noexcept {
    std::size_t kept = 0;
    double carry = value;
    for (std::size_t i = 0; i < size_; ++i) {
      const TwoTerms s = two_sum(carry, terms_[i]);
      carry = s.sum;
      if (s.error != 0) terms_[kept++] = s.error;
    }
    size_ = kept;
    append(carry);
  }

  /// Appends a term larger than all before it.
  void append(double value) noexcept {
    if (value != 0) terms_[size_++] = value;
  }

 private:
  std::array<double, N> terms_;
  std::size_t size_ = 0;
};

template <std::size_t N, std::size_t M>
Expansion<N + M> operator+(const Expansion<N>& a, const Expansion<M>& b) noexcept {
  Expansion<N + M> sum;
  for (std::size_t i = 0; i < a.size(); ++i) sum.append(a[i]);
  for (std::size_t i = 0; i < b.size(); ++i) sum.grow(b[i]);
  return sum;
}

template <std::size_t N>
Expansion<N> operator-(const Expansion<N>& a) noexcept {
  Expansion<N> negated;
  for (std::size_t i = 0; i < a.size(); ++i) negated.append(-a[i]);
  return negated;
}

template <std::size_t N, std::size_t M>
Expansion<N + M> operator-(const Expansion<N>& a, const Expansion<M>& b) noexcept {
  return a + -b;
}

/// Scales by one double.
template <std::size_t N>
Expansion<2 * N> operator*(const Expansion<N>& a, double factor) noexcept {
  Expansion<2 * N> product;
  if (a.size() == 0 || factor == 0) return product;
  TwoTerms carry = two_product(a[0], factor);
  product.append(carry.error);
  for (std::size_t i = 1; i < a.size(); ++i) {
    const TwoTerms p = two_product(a[i], factor);
    const TwoTerms low = two_sum(carry.sum, p.error);
    product.append(low.error);
    const TwoTerms high = two_sum(p.sum, low.sum);
    product.append(high.error);
    carry.sum = high.sum;
  }
  product.append(carry.sum);
  return product;
}

template <std::size_t N, std::size_t M>
Expansion<2 * N * M> operator*(const Expansion<N>& a, const Expansion<M>& b) noexcept {
  Expansion<2 * N * M> product;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Expansion<2 * N> part = a * b[i];
    for (std::size_t k = 0; k < part.size(); ++k) product.grow(part[k]);
  }
  return product;
}

}  // namespace shaftcull::kernel
