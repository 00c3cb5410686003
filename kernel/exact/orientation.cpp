// SPDX-License-Identifier: MIT
#include "exact/orientation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "exact/expansion.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {
namespace {

using Exact = Expansion<2>;

#ifdef SHAFTCULL_HAS_INT128

int sign_of(Int128 x) noexcept { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Three steps along one axis, times a power of two, as whole numbers below 2^41. Returns false if they are none.
bool take_whole(const Step& u, const Step& v, const Step& w, std::int64_t (&whole)[3]) noexcept {
  const int bits = 41;
  const TwoTerms difference[3] = {two_sum(u.end, -u.start), two_sum(v.end, -v.start), two_sum(w.end, -w.start)};
  double largest = 0;
  for (const TwoTerms& d : difference) largest = std::max(largest, std::fabs(d.sum));
  // Differences of floats are no denormal doubles, and neither is the power of two. That of 0 is 2^0.
  constexpr int bias = 1023;
  const int exponent = largest == 0 ? bits - 1 : static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52U) - bias;
  const double power = std::bit_cast<double>(static_cast<std::uint64_t>(bias + bits - 1 - exponent) << 52U);
  bool are_exact = true;
  for (unsigned i = 0; i < 3; ++i) {
    const double scaled = difference[i].sum * power;
    whole[i] = static_cast<std::int64_t>(scaled);
    are_exact = are_exact && difference[i].error == 0 && static_cast<double>(whole[i]) == scaled;
  }
  return are_exact;
}

/// The sign of (u × v) · w in integers of 128 bits, if they are enough: the six products are below 2^123.
std::optional<int> whole_sign(const Step (&u)[3], const Step (&v)[3], const Step (&w)[3]) noexcept {
  std::int64_t of[3][3];
  for (unsigned k = 0; k < 3; ++k) {
    if (!take_whole(u[k], v[k], w[k], of[k])) return {};
  }
  Int128 sum = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const std::int64_t(&i)[3] = of[(k + 1) % 3];
    const std::int64_t(&j)[3] = of[(k + 2) % 3];
    sum += (Int128{i[0]} * j[1] - Int128{j[0]} * i[1]) * of[k][2];
  }
  return sign_of(sum);
}

#else

std::optional<int> whole_sign(const Step (&)[3], const Step (&)[3], const Step (&)[3]) noexcept { return {}; }

#endif

}  // namespace

int exact_sign(const Step (&u)[3], const Step (&v)[3], const Step (&w)[3]) noexcept {
  if (const std::optional<int> sign = whole_sign(u, v, w)) return *sign;
  return (determinant<Exact>(u[1], u[2], v[1], v[2]) * w[0].in<Exact>() +
          determinant<Exact>(u[2], u[0], v[2], v[0]) * w[1].in<Exact>() +
          determinant<Exact>(u[0], u[1], v[0], v[1]) * w[2].in<Exact>())
      .sign();
}

int exact_sign(const Step& a, const Step& b, const Step& c, const Step& d) noexcept {
  const auto difference = [](const Step& step) { return two_sum(step.end, -step.start); };
  const TwoTerms of[4] = {difference(a), difference(d), difference(b), difference(c)};
  if (of[0].error != 0 || of[1].error != 0 || of[2].error != 0 || of[3].error != 0) {
    return determinant<Exact>(a, b, c, d).sign();
  }
  const TwoTerms left = two_product(of[0].sum, of[1].sum);
  const TwoTerms right = two_product(of[2].sum, of[3].sum);
  // Of numbers that are rounded to different doubles, the one with the larger double is larger.
  if (left.sum != right.sum) return left.sum > right.sum ? 1 : -1;
  return left.error > right.error ? 1 : left.error < right.error ? -1 : 0;
}

double exact_determinant(const Step& a, const Step& b, const Step& c, const Step& d) noexcept {
  const auto exact = determinant<Exact>(a, b, c, d);
  double sum = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) sum += exact[i];  // smallest first
  return sum;
}

}  // namespace shaftcull::kernel
