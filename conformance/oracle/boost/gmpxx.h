// SPDX-License-Identifier: MIT
/// What the oracle and the tests use of GMP's C++ interface, by Boost.Multiprecision: for systems that have no GMP.
///
/// Of fractions only powers of two are always cancelled, which is quick and enough for sums and products of floats. The
/// rest is when they have grown.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdlib>

#include <boost/multiprecision/cpp_int.hpp>

using mpz_class =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<512>, boost::multiprecision::et_off>;

inline int sgn(const mpz_class& x) { return x.sign(); }

/// Bits of an integer, its sign left out.
inline int bits_of(const mpz_class& x) {
  return x == 0 ? 0 : static_cast<int>(boost::multiprecision::msb(mpz_class(abs(x)))) + 1;
}

class mpq_class {
 public:
  mpq_class() = default;
  template <std::integral Integer>
  mpq_class(Integer x) : over_(x) {}
  mpq_class(const mpz_class& x) : over_(x) {}
  mpq_class(const mpz_class& over, const mpz_class& under) : over_(over), under_(under) { cancel(); }
  mpq_class(float x) : mpq_class(double{x}) {}
  mpq_class(double x) {
    constexpr int digits = 53;
    int exponent = 0;
    over_ = mpz_class(std::ldexp(std::frexp(x, &exponent), digits));
    exponent -= digits;
    (exponent < 0 ? under_ : over_) <<= static_cast<unsigned>(std::abs(exponent));
    cancel();
  }

  [[nodiscard]] const mpz_class& get_num() const { return over_; }
  [[nodiscard]] const mpz_class& get_den() const { return under_; }
  [[nodiscard]] double get_d() const;

  friend int sgn(const mpq_class& x) { return x.over_.sign(); }
  friend int cmp(const mpq_class& x, const mpq_class& y) {
    return mpz_class(x.over_ * y.under_).compare(y.over_ * x.under_);
  }
  friend mpq_class abs(const mpq_class& x) { return sgn(x) < 0 ? -x : x; }

  friend mpq_class operator+(const mpq_class& x, const mpq_class& y) {
    return {x.over_ * y.under_ + y.over_ * x.under_, x.under_ * y.under_};
  }
  friend mpq_class operator-(const mpq_class& x, const mpq_class& y) {
    return {x.over_ * y.under_ - y.over_ * x.under_, x.under_ * y.under_};
  }
  friend mpq_class operator*(const mpq_class& x, const mpq_class& y) {
    return {x.over_ * y.over_, x.under_ * y.under_};
  }
  friend mpq_class operator/(const mpq_class& x, const mpq_class& y) {
    return {y.over_ < 0 ? mpz_class(-x.over_ * y.under_) : mpz_class(x.over_ * y.under_), x.under_ * abs(y.over_)};
  }
  friend mpq_class operator<<(const mpq_class& x, unsigned doublings) { return {x.over_ << doublings, x.under_}; }
  mpq_class operator-() const {
    mpq_class negative = *this;
    negative.over_ = -over_;
    return negative;
  }
  mpq_class& operator+=(const mpq_class& y) { return *this = *this + y; }
  mpq_class& operator-=(const mpq_class& y) { return *this = *this - y; }
  mpq_class& operator*=(const mpq_class& y) { return *this = *this * y; }
  mpq_class& operator/=(const mpq_class& y) { return *this = *this / y; }

  friend bool operator==(const mpq_class& x, const mpq_class& y) { return cmp(x, y) == 0; }
  friend bool operator!=(const mpq_class& x, const mpq_class& y) { return cmp(x, y) != 0; }
  friend bool operator<(const mpq_class& x, const mpq_class& y) { return cmp(x, y) < 0; }
  friend bool operator>(const mpq_class& x, const mpq_class& y) { return cmp(x, y) > 0; }
  friend bool operator<=(const mpq_class& x, const mpq_class& y) { return cmp(x, y) <= 0; }
  friend bool operator>=(const mpq_class& x, const mpq_class& y) { return cmp(x, y) >= 0; }

 private:
  void cancel() {
    constexpr unsigned grown = 1024;  // bits
    if (over_ == 0) {
      under_ = 1;
      return;
    }
    const unsigned twos = static_cast<unsigned>(std::min(lsb(mpz_class(abs(over_))), lsb(under_)));
    over_ >>= twos;
    under_ >>= twos;
    if (msb(under_) < grown || lsb(under_) == msb(under_)) return;
    const mpz_class common = gcd(over_, under_);
    over_ /= common;
    under_ /= common;
  }

  mpz_class over_ = 0;
  mpz_class under_ = 1;  ///< positive
};

/// GMP's has some bits. Here it is a rational that is not rounded, but for square roots, which have 512 bits or more.
class mpf_class : public mpq_class {
 public:
  mpf_class() = default;
  mpf_class(const mpq_class& x, unsigned /*bits*/ = 0) : mpq_class(x) {}

  friend mpf_class sqrt(const mpf_class& x) {
    const int shift = std::max(0, 512 - (bits_of(x.get_num()) - bits_of(x.get_den())) / 2);
    const mpz_class square = (x.get_num() << 2 * static_cast<unsigned>(shift)) / x.get_den();
    return mpq_class(boost::multiprecision::sqrt(square), mpz_class(1) << static_cast<unsigned>(shift));
  }
};

inline double mpq_class::get_d() const {
  // Cut off, as GMP does, not rounded.
  constexpr int digits = 53;
  const mpz_class size = abs(over_);
  const int exponent = bits_of(size) - bits_of(under_) - digits - 1;  // so that the quotient has one digit more, or two
  const mpz_class quotient = exponent < 0 ? mpz_class((size << static_cast<unsigned>(-exponent)) / under_)
                                          : mpz_class(size / (under_ << static_cast<unsigned>(exponent)));
  const int rest = std::max(0, bits_of(quotient) - digits);
  const double head = static_cast<double>(mpz_class(quotient >> static_cast<unsigned>(rest)));
  return std::ldexp(over_ < 0 ? -head : head, rest + exponent);
}
