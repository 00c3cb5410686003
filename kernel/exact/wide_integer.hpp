// SPDX-License-Identifier: MIT
/// Integers of up to 2,944 bits, on the stack: for polynomials of so high a degree in floats that doubles would over-
/// or underflow.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace shaftcull::kernel {

/// A finite float's magnitude as digits · 2^exponent.
struct FloatDigits {
  std::uint32_t digits;
  int exponent;

  explicit FloatDigits(float x) noexcept {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t fraction = bits & 0x7fffffU;
    const std::uint32_t biased = bits >> 23U & 0xffU;
    digits = biased == 0 ? fraction : fraction | 0x800000U;
    exponent = static_cast<int>(biased == 0 ? 1 : biased) - 150;
  }
  /// The exponent of the lowest bit that is set; not for 0.
  [[nodiscard]] int lowest_bit() const noexcept { return exponent + std::countr_zero(digits); }
};

/// A sign and a magnitude, which takes as many words as it needs. Sums and products are the caller's to keep below
/// 2^most_bits.
class WideInteger {
 public:
  static constexpr unsigned most_bits = 2880;

  WideInteger() noexcept = default;  // 0
  WideInteger(const WideInteger& other) noexcept { *this = other; }
  WideInteger& operator=(const WideInteger& other) noexcept {  // copies what is there, not all words
    for (std::size_t i = 0; i < other.size_; ++i) word_[i] = other.word_[i];
    size_ = other.size_;
    is_negative_ = other.is_negative_;
    return *this;
  }
  ~WideInteger() = default;

  /// x · 2^scale, which must be an integer.
  static WideInteger scaled(float x, int scale) noexcept {
    WideInteger result;
    const FloatDigits of(x);
    if (of.digits == 0) return result;
    std::uint64_t digits = of.digits;
    int shift = of.exponent + scale;
    if (shift < 0) {  // the bits that this drops are zeros
      digits >>= static_cast<unsigned>(-shift);
      shift = 0;
    }
    const auto first = static_cast<std::size_t>(shift) / 32;
    digits <<= static_cast<unsigned>(shift) % 32;
    for (std::size_t i = 0; i < first; ++i) result.word_[i] = 0;
    result.word_[first] = static_cast<std::uint32_t>(digits);
    result.word_[first + 1] = static_cast<std::uint32_t>(digits >> 32U);
    result.size_ = first + 2;
    result.is_negative_ = x < 0;
    result.trim();
    return result;
  }

  /// −1, 0 or 1.
  [[nodiscard]] int sign() const noexcept { return size_ == 0 ? 0 : is_negative_ ? -1 : 1; }

  friend WideInteger operator-(const WideInteger& a) noexcept {
    WideInteger negated = a;
    negated.is_negative_ = !a.is_negative_;
    return negated;
  }
  friend WideInteger operator+(const WideInteger& a, const WideInteger& b) noexcept {
    return a.is_negative_ == b.is_negative_ ? sum_of_magnitudes(a, b) : difference_of_magnitudes(a, b);
  }
  friend WideInteger operator-(const WideInteger& a, const WideInteger& b) noexcept {
    return a.is_negative_ != b.is_negative_ ? sum_of_magnitudes(a, b) : difference_of_magnitudes(a, b);
  }
  friend WideInteger operator*(const WideInteger& a, const WideInteger& b) noexcept {
    WideInteger product;
    if (a.size_ == 0 || b.size_ == 0) return product;
    product.size_ = a.size_ + b.size_;
    product.is_negative_ = a.is_negative_ != b.is_negative_;
    for (std::size_t i = 0; i < product.size_; ++i) product.word_[i] = 0;
    for (std::size_t i = 0; i < a.size_; ++i) {
      const std::uint64_t factor = a.word_[i];
      if (factor == 0) continue;  // as many low words are, where coordinates differ much in size
      std::uint64_t carry = 0;
      for (std::size_t k = 0; k < b.size_; ++k) {
        carry += factor * b.word_[k] + product.word_[i + k];  // below 2⁶⁴
        product.word_[i + k] = static_cast<std::uint32_t>(carry);
        carry >>= 32U;
      }
      product.word_[i + b.size_] = static_cast<std::uint32_t>(carry);
    }
    product.trim();
    return product;
  }

 private:
  /// The words of two factors may be two more than those of their product need.
  static constexpr std::size_t most_words = most_bits / 32 + 2;

  void trim() noexcept {
    while (size_ != 0 && word_[size_ - 1] == 0) --size_;
  }

  /// |a| + |b| with the sign of a.
  static WideInteger sum_of_magnitudes(const WideInteger& a, const WideInteger& b) noexcept {
    const WideInteger& longer = a.size_ < b.size_ ? b : a;
    const WideInteger& shorter = a.size_ < b.size_ ? a : b;
    WideInteger sum;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < longer.size_; ++i) {
      carry += std::uint64_t{longer.word_[i]} + (i < shorter.size_ ? shorter.word_[i] : 0);
      sum.word_[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32U;
    }
    sum.size_ = longer.size_;
    if (carry != 0) sum.word_[sum.size_++] = static_cast<std::uint32_t>(carry);
    sum.is_negative_ = a.is_negative_;
    return sum;
  }

  /// |a| − |b| with the sign of a: its magnitude has that sign, or the other one.
  static WideInteger difference_of_magnitudes(const WideInteger& a, const WideInteger& b) noexcept {
    const bool is_swapped = is_magnitude_less(a, b);
    const WideInteger& larger = is_swapped ? b : a;
    const WideInteger& smaller = is_swapped ? a : b;
    WideInteger difference;
    std::uint32_t borrow = 0;
    for (std::size_t i = 0; i < larger.size_; ++i) {
      const std::uint64_t less = std::uint64_t{i < smaller.size_ ? smaller.word_[i] : 0} + borrow;
      borrow = larger.word_[i] < less ? 1 : 0;
      difference.word_[i] = static_cast<std::uint32_t>(larger.word_[i] - less);
    }
    difference.size_ = larger.size_;
    difference.is_negative_ = a.is_negative_ != is_swapped;
    difference.trim();
    return difference;
  }

  static bool is_magnitude_less(const WideInteger& a, const WideInteger& b) noexcept {
    if (a.size_ != b.size_) return a.size_ < b.size_;
    for (std::size_t i = a.size_; i-- != 0;) {
      if (a.word_[i] != b.word_[i]) return a.word_[i] < b.word_[i];
    }
    return false;
  }

  std::array<std::uint32_t, most_words> word_;  // lowest first; those from size_ on are not written
  std::size_t size_ = 0;                        // the highest word is not 0
  bool is_negative_ = false;                    // of 0, either
};

}  // namespace shaftcull::kernel
