#include "oracle/entry_time.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

namespace shaftcull::oracle {
namespace {

/// The times at which what was asked so far holds: from `from` to `to`, or on without end.
struct Times {
  mpq_class from = 0;
  std::optional<mpq_class> to;

  [[nodiscard]] bool are_none() const { return to && from > *to; }
};

/// Cuts times down to the t with start + t speed ≤ limit.
void keep_at_most(const mpq_class& start, const mpq_class& speed, const mpq_class& limit, Times& times) {
  if (speed == 0) {
    if (start > limit) times.to = times.from - 1;  // never
    return;
  }
  const mpq_class then = (limit - start) / speed;
  if (speed > 0) {
    if (!times.to || then < *times.to) times.to = then;
  } else {
    if (then > times.from) times.from = then;
  }
}

/// Where a face of a moving box is on an axis at time 0, and how far it goes in a unit of time.
struct Face {
  mpq_class start;
  mpq_class speed;
};

/// The first of some times at which a moving box and `box` have a common point; lo(k) and hi(k) are its faces.
template <class FaceOf>
std::optional<mpq_class> first_time(Times times, const FaceOf& lo, const FaceOf& hi, const Box& box) {
  for (std::size_t k = 0; k != 3; ++k) {
    // Two intervals meet where neither begins after the other has ended.
    if (std::isinf(box.hi[k])) {
      if (box.hi[k] < 0) return std::nullopt;
    } else {
      const Face face = lo(k);
      keep_at_most(face.start, face.speed, mpq_class(box.hi[k]), times);
    }
    if (std::isinf(box.lo[k])) {
      if (box.lo[k] > 0) return std::nullopt;
    } else {
      const Face face = hi(k);
      keep_at_most(-face.start, -face.speed, -mpq_class(box.lo[k]), times);
    }
    if (times.are_none()) return std::nullopt;
  }
  return times.from;
}

}  // namespace

std::optional<mpq_class> entry_time(const Box& a, const Box& b, const Box& box) {
  using FaceOf = std::function<Face(std::size_t)>;
  const FaceOf lo = [&](std::size_t k) { return Face{a.lo[k], mpq_class(b.lo[k]) - mpq_class(a.lo[k])}; };
  const FaceOf hi = [&](std::size_t k) { return Face{a.hi[k], mpq_class(b.hi[k]) - mpq_class(a.hi[k])}; };
  return first_time<FaceOf>({0, 1}, lo, hi, box);
}

std::optional<mpq_class> entry_time(const MovingInput& input, const Box& box) {
  using FaceOf = std::function<Face(std::size_t)>;
  // A box of a shadow is as wide as what lies between the light's far sides: its lo comes from the light's hi.
  const FaceOf lo = [&](std::size_t k) {
    const mpq_class start = input.box.lo[k];
    return Face{start, input.is_shadow() ? mpq_class(start - mpq_class(input.light.hi[k])) : input.displacement[k]};
  };
  const FaceOf hi = [&](std::size_t k) {
    const mpq_class start = input.box.hi[k];
    return Face{start, input.is_shadow() ? mpq_class(start - mpq_class(input.light.lo[k])) : input.displacement[k]};
  };
  Times times;
  if (!input.is_endless()) times.to = input.is_shadow() ? mpq_class(mpq_class(input.reach) - 1) : mpq_class(1);
  return first_time<FaceOf>(times, lo, hi, box);
}

float rounded_down(const mpq_class& time) {
  // Floats that are not negative are in the order of their bits.
  std::uint32_t low = 0;
  std::uint32_t high = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity());
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    (mpq_class(std::bit_cast<float>(middle)) <= time ? low : high) = middle;
  }
  return std::bit_cast<float>(low);
}

}  // namespace shaftcull::oracle
