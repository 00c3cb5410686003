/// Reading bounds from the user's arrays of structs, at any stride and alignment.
#pragma once

#include <cstddef>
#include <cstring>
#include <limits>
#include <string>

#include "shaftcull/streams.hpp"

namespace shaftcull::kernel {

/// Three floats at a byte stride.
struct VectorRecords {
  const std::byte* first;
  std::size_t stride;

  VectorRecords(const void* start, std::size_t bytes) noexcept
      : first(static_cast<const std::byte*>(start)), stride(bytes) {}

  /// Copies `size` floats of record `i`, which need not be aligned.
  template <std::size_t size>
  void read(std::size_t i, float (&floats)[size]) const noexcept {
    std::memcpy(floats, first + i * stride, sizeof floats);
  }
};

// Every reader has the same shape:
//   rows             how many streams a bound is packed into
//   noun             what messages call a bound
//   read(i, bound)   packs record i into `bound`; returns whether it is legal
//   fault(i)         what is wrong with record i, for messages

class MinMaxReader {
 public:
  static constexpr std::size_t rows = 6;
  static constexpr const char* noun = "box";
  static constexpr const char* nouns = "boxes";

  explicit MinMaxReader(const MinMaxRecords& records);

  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  bool read(std::size_t i, float (&bound)[rows]) const noexcept {
    float lo[3];
    float hi[3];
    lo_.read(i, lo);
    hi_.read(i, hi);
    for (std::size_t k = 0; k < 3; ++k) {
      bound[k] = lo[k];
      bound[k + 3] = hi[k];
    }
    constexpr float infinity = std::numeric_limits<float>::infinity();
    // Comparisons with NaN are false. & instead of &&: no branches, almost all records are legal.
    const bool is_ordered = (lo[0] <= hi[0]) & (lo[1] <= hi[1]) & (lo[2] <= hi[2]);
    const bool is_empty = (lo[0] == infinity) & (lo[1] == infinity) & (lo[2] == infinity) & (hi[0] == -infinity) &
                          (hi[1] == -infinity) & (hi[2] == -infinity);
    return is_ordered | is_empty;
  }

  [[nodiscard]] std::string fault(std::size_t i) const;

 private:
  VectorRecords lo_;
  VectorRecords hi_;
  std::size_t count_;
};

class CentreExtentReader {
 public:
  static constexpr std::size_t rows = 6;
  static constexpr const char* noun = "box";
  static constexpr const char* nouns = "boxes";

  explicit CentreExtentReader(const CentreExtentRecords& records);

  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  bool read(std::size_t i, float (&bound)[rows]) const noexcept {
    float centre[3];
    float half[3];
    centre_.read(i, centre);
    half_.read(i, half);
    bool is_legal = true;
    for (std::size_t k = 0; k < 3; ++k) {
      // lo = c − h rounded down is −(h − c rounded up).
      bound[k] = -sum_rounded_up(half[k], -centre[k]);
      bound[k + 3] = sum_rounded_up(half[k], centre[k]);
      // NaN, or an infinite centre ± an infinite half extent, makes a corner NaN, and the comparison false.
      is_legal &= (half[k] >= 0) & (bound[k] <= bound[k + 3]);
    }
    return is_legal;
  }

  [[nodiscard]] std::string fault(std::size_t i) const;

 private:
  /// The smallest float not below x + y.
  static float sum_rounded_up(float x, float y) noexcept;

  VectorRecords centre_;
  VectorRecords half_;
  std::size_t count_;
};

class SphereReader {
 public:
  static constexpr std::size_t rows = 4;
  static constexpr const char* noun = "sphere";
  static constexpr const char* nouns = "spheres";

  explicit SphereReader(const SphereRecords& records);

  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  bool read(std::size_t i, float (&bound)[rows]) const noexcept {
    float centre[3];
    float radius[1];
    centre_.read(i, centre);
    radius_.read(i, radius);
    bound[0] = centre[0];
    bound[1] = centre[1];
    bound[2] = centre[2];
    bound[3] = radius[0];
    // x − x is 0 if x is finite, else NaN.
    return (centre[0] - centre[0] == 0) & (centre[1] - centre[1] == 0) & (centre[2] - centre[2] == 0) &
           (radius[0] >= 0);
  }

  [[nodiscard]] std::string fault(std::size_t i) const;

 private:
  VectorRecords centre_;
  VectorRecords radius_;
  std::size_t count_;
};

inline float CentreExtentReader::sum_rounded_up(float x, float y) noexcept {
  const double a = x;
  const double b = y;
  const double sum = a + b;
  const double part = sum - a;
  const double error = (a - (sum - part)) + (b - part);  // sum + error = x + y (Knuth); NaN if they are infinite
  const auto nearest = static_cast<float>(sum);
  const double rounded = nearest;
  const bool is_below = (rounded < sum) | ((rounded == sum) & (error > 0));
  return is_below ? __builtin_nextafterf(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

}  // namespace shaftcull::kernel
