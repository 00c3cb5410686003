// SPDX-License-Identifier: MIT
/// Reading bounds from the user's arrays of structs, at any stride and alignment.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "shaftcull/streams.hpp"
#include "simd/baseline_four_floats.hpp"
#include "support/overlap.hpp"
#include "support/padding.hpp"

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
  /// The same three floats, and 0.
  [[nodiscard]] FourFloats read_vector(std::size_t i) const noexcept {
    return FourFloats::three_at(first + i * stride);
  }

  /// Whether the memory from the first of `count` records of `size` floats to the last has a byte in common with
  /// `memory`.
  [[nodiscard]] bool overlaps(std::span<const std::byte> memory, std::size_t count, std::size_t size) const noexcept {
    if (count == 0) return false;
    const auto last = static_cast<std::ptrdiff_t>((count - 1) * stride);  // negative where records go backwards
    const std::ptrdiff_t from = last < 0 ? last : 0;
    const std::ptrdiff_t to = (last < 0 ? 0 : last) + static_cast<std::ptrdiff_t>(size * sizeof(float));
    return overlap(memory, {first + from, static_cast<std::size_t>(to - from)});
  }

  /// Copies the three floats of records which[0 … 3] to to[0 … 2][0 … 3].
  template <class Which>
  void read_four(Which which, float* const* to) const noexcept {
    FourFloats row[4] = {read_vector(which[0]), read_vector(which[1]), read_vector(which[2]), read_vector(which[3])};
    transpose(row);
    for (std::size_t k = 0; k != 3; ++k) row[k].store(to[k]);
  }
};

// Every reader has the same shape; those of Box and Sphere also static is_legal(bound) and is_clearly_legal(bound):
//   rows             how many streams a bound is packed into
//   noun             what messages call a bound
//   is_legal(i)      whether record i may be packed; without branches, but for the rare empty box
//   are_clearly_legal(i, j)  whether records [i, j) are, at a glance: false of some that are
//   read(i, bound)   packs record i into `bound`
//   read_four(which, row)  packs records which[0 … 3] into row[·][0 … 3]; `which` is a pointer to indices, or InOrder
//   overlaps(memory) whether records lie in that memory
//   fault(i)         what is wrong with record i, for messages

/// Records one after the other, in place of a pointer to their indices.
struct InOrder {
  std::size_t first;

  [[nodiscard]] std::size_t operator[](std::size_t i) const noexcept { return first + i; }
  [[nodiscard]] InOrder operator+(std::size_t i) const noexcept { return {first + i}; }
};

/// Packs records which[0 … count − 1] into row[·][0 … count − 1]; calls before(i) before it reads which[i … i + 3].
template <class Reader, class Which, class Before>
void read_rows(const Reader& reader, Which which, std::size_t count, float* const* row, Before before) noexcept {
  float* to[Reader::rows];
  for (std::size_t k = 0; k != Reader::rows; ++k) to[k] = row[k];
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    before(i);
    reader.read_four(which + i, to);
    for (float*& at : to) at += 4;
  }
  for (; i < count; ++i) {
    float bound[Reader::rows];
    reader.read(which[i], bound);
    for (std::size_t k = 0; k != Reader::rows; ++k) *to[k]++ = bound[k];
  }
}

template <class Reader, class Which>
void read_rows(const Reader& reader, Which which, std::size_t count, float* const* row) noexcept {
  read_rows(reader, which, count, row, [](std::size_t) {});
}

/// The first of records [first, end) that may not be packed; `end` if there is none.
template <class Reader>
std::size_t first_illegal(const Reader& reader, std::size_t first, std::size_t end) noexcept {
  constexpr std::size_t block = 256;  // records checked between two branches
  for (; first < end; first += block) {
    const std::size_t block_end = end - first < block ? end : first + block;
    if (reader.are_clearly_legal(first, block_end)) continue;
    for (std::size_t i = first; i != block_end; ++i) {
      if (!reader.is_legal(i)) return i;
    }
  }
  return end;
}

class MinMaxReader {
 public:
  static constexpr std::size_t rows = 6;
  static constexpr const char* noun = "box";
  static constexpr const char* nouns = "boxes";

  explicit MinMaxReader(const StridedBoxes& records);

  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  [[nodiscard]] bool is_legal(std::size_t i) const noexcept {
    float bound[rows];
    read(i, bound);
    return is_legal(bound);
  }
  [[nodiscard]] static bool is_legal(const float (&bound)[rows]) noexcept {
    if (is_clearly_legal(bound)) [[likely]]
      return true;
    return is_empty(bound);
  }
  [[nodiscard]] static bool is_clearly_legal(const float (&bound)[rows]) noexcept {
    // Comparisons with NaN are false.
    return (bound[0] <= bound[3]) & (bound[1] <= bound[4]) & (bound[2] <= bound[5]);
  }
  [[nodiscard]] bool are_clearly_legal(std::size_t first, std::size_t end) const noexcept {
    FourFloats::Truth legal;
    for (std::size_t i = first; i != end; ++i) legal &= lo_.read_vector(i) <= hi_.read_vector(i);
    return legal.everywhere();
  }

  void read(std::size_t i, float (&bound)[rows]) const noexcept {
    float lo[3];
    float hi[3];
    lo_.read(i, lo);
    hi_.read(i, hi);
    for (std::size_t k = 0; k < 3; ++k) {
      bound[k] = lo[k];
      bound[k + 3] = hi[k];
    }
  }
  template <class Which>
  void read_four(Which which, float* const* row) const noexcept {
    lo_.read_four(which, row);
    hi_.read_four(which, row + 3);
  }
  [[nodiscard]] bool overlaps(std::span<const std::byte> memory) const noexcept {
    return lo_.overlaps(memory, count_, 3) || hi_.overlaps(memory, count_, 3);
  }

  [[nodiscard]] std::string fault(std::size_t i) const;

 private:
  static bool is_empty(const float (&bound)[rows]) noexcept {
    for (std::size_t s = 0; s != rows; ++s) {
      if (bound[s] != padding_box[s]) return false;
    }
    return true;
  }

  VectorRecords lo_;
  VectorRecords hi_;
  std::size_t count_;
};

class CentreExtentReader {
 public:
  static constexpr std::size_t rows = 6;
  static constexpr const char* noun = "box";
  static constexpr const char* nouns = "boxes";

  explicit CentreExtentReader(const StridedCentreExtents& records);

  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  [[nodiscard]] bool is_legal(std::size_t i) const noexcept {
    float centre[3];
    float half[3];
    centre_.read(i, centre);
    half_.read(i, half);
    bool is_legal = true;
    for (std::size_t k = 0; k < 3; ++k) {
      // A NaN, or an infinite centre ± an infinite half extent, makes a corner NaN and the comparison false.
      is_legal &= (half[k] >= 0) & (centre[k] - half[k] <= centre[k] + half[k]);
    }
    return is_legal;
  }
  [[nodiscard]] bool are_clearly_legal(std::size_t first, std::size_t end) const noexcept {
    FourFloats::Truth legal;
    for (std::size_t i = first; i != end; ++i) {
      const FourFloats centre = centre_.read_vector(i);
      const FourFloats half = half_.read_vector(i);
      legal &= (FourFloats() <= half) & (centre - half <= centre + half);
    }
    return legal.everywhere();
  }

  void read(std::size_t i, float (&bound)[rows]) const noexcept {
    float centre[3];
    float half[3];
    centre_.read(i, centre);
    half_.read(i, half);
    for (std::size_t k = 0; k < 3; ++k) {
      // lo = c − h rounded down is −(−c + h rounded up).
      bound[k] = -sum_rounded_up(-centre[k], half[k]);
      bound[k + 3] = sum_rounded_up(centre[k], half[k]);
    }
  }
  template <class Which>
  void read_four(Which which, float* const* row) const noexcept {
    float centre[3][4];
    float half[3][4];
    float* const centres[3] = {centre[0], centre[1], centre[2]};
    float* const halves[3] = {half[0], half[1], half[2]};
    centre_.read_four(which, centres);
    half_.read_four(which, halves);
    for (std::size_t k = 0; k != 3; ++k) {
      float lo[4];
      float hi[4];
      for (std::size_t i = 0; i != 4; ++i) {
        lo[i] = -sum_rounded_up(-centre[k][i], half[k][i]);
        hi[i] = sum_rounded_up(centre[k][i], half[k][i]);
      }
      std::memcpy(row[k], lo, sizeof lo);
      std::memcpy(row[k + 3], hi, sizeof hi);
    }
  }
  [[nodiscard]] bool overlaps(std::span<const std::byte> memory) const noexcept {
    return centre_.overlaps(memory, count_, 3) || half_.overlaps(memory, count_, 3);
  }

  [[nodiscard]] std::string fault(std::size_t i) const;

 private:
  /// The smallest float not below x + y, where y is 0 or more; infinite sums stay.
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

  explicit SphereReader(const StridedSpheres& records);

  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  [[nodiscard]] bool is_legal(std::size_t i) const noexcept {
    float bound[rows];
    read(i, bound);
    return is_legal(bound);
  }
  [[nodiscard]] static bool is_legal(const float (&bound)[rows]) noexcept {
    // x − x is 0 if x is finite, else NaN.
    return (bound[0] - bound[0] == 0) & (bound[1] - bound[1] == 0) & (bound[2] - bound[2] == 0) & (bound[3] >= 0);
  }
  [[nodiscard]] static bool is_clearly_legal(const float (&bound)[rows]) noexcept { return is_legal(bound); }
  [[nodiscard]] bool are_clearly_legal(std::size_t first, std::size_t end) const noexcept {
    FourFloats::Truth finite;
    bool has_radius = true;
    for (std::size_t i = first; i != end; ++i) {
      const FourFloats centre = centre_.read_vector(i);
      finite &= FourFloats() <= centre - centre;
      float radius[1];
      radius_.read(i, radius);
      has_radius &= radius[0] >= 0;
    }
    return finite.everywhere() && has_radius;
  }

  void read(std::size_t i, float (&bound)[rows]) const noexcept {
    float centre[3];
    float radius[1];
    centre_.read(i, centre);
    radius_.read(i, radius);
    bound[0] = centre[0];
    bound[1] = centre[1];
    bound[2] = centre[2];
    bound[3] = radius[0];
  }
  template <class Which>
  void read_four(Which which, float* const* row) const noexcept {
    centre_.read_four(which, row);
    for (std::size_t i = 0; i != 4; ++i) {
      float radius[1];
      radius_.read(which[i], radius);
      row[3][i] = radius[0];
    }
  }
  [[nodiscard]] bool overlaps(std::span<const std::byte> memory) const noexcept {
    return centre_.overlaps(memory, count_, 3) || radius_.overlaps(memory, count_, 1);
  }

  [[nodiscard]] std::string fault(std::size_t i) const;

 private:
  VectorRecords centre_;
  VectorRecords radius_;
  std::size_t count_;
};

inline float CentreExtentReader::sum_rounded_up(float x, float y) noexcept {
  const float sum = x + y;
  const float part = sum - x;
  // sum + error = x + y (Knuth). It is NaN if the sum is infinite, or if `part` is, which has to be more than y, that
  // is, sum more than x + y: there is nothing to round then. With y below 0 it could be less.
  const float error = (x - (sum - part)) + (y - part);
  // The next float up, without a branch: bits of floats are ordered by magnitude. + 0 turns −0 into 0.
  const auto bits = std::bit_cast<std::int32_t>(sum + 0.0F);
  const std::int32_t upwards = bits >> 31 | 1;  // −1 if negative, else 1
  return std::bit_cast<float>(bits + (upwards & -static_cast<std::int32_t>(error > 0)));
}

}  // namespace shaftcull::kernel
