// SPDX-License-Identifier: MIT
// The code that recipes compare the library with: boxes in blocks of 64 neighbours, eight at a
// time in vectors, as an engine would write it. Compile with -O3 -march=native to measure.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <shaftcull/shaftcull.hpp>
#include <span>
#include <vector>

#ifdef __AVX2__
#include <immintrin.h>
#endif
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are passed between inlined functions only

namespace by_hand {

namespace sc = shaftcull;

constexpr unsigned lanes = 8;
using Floats [[gnu::vector_size(32)]] = float;
using Mask [[gnu::vector_size(32)]] = std::int32_t;

inline Floats all(float x) { return Floats{} + x; }
inline Floats smaller(const Floats& a, const Floats& b) { return a < b ? a : b; }
inline Floats larger(const Floats& a, const Floats& b) { return a > b ? a : b; }
inline Floats load(const float* p) { return *reinterpret_cast<const Floats*>(p); }
inline unsigned bits(const Mask& mask) {
#ifdef __AVX2__
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<const __m256&>(mask)));
#else
  unsigned bits = 0;
  for (unsigned i = 0; i != lanes; ++i) bits |= (mask[i] < 0 ? 1U : 0U) << i;
  return bits;
#endif
}

/// Eight boxes: lo x, y, z and hi x, y, z.
using EightBoxes = std::array<Floats, 6>;

/// Boxes along a Morton curve, 64 in a block, with the box around each block.
class Blocks {
 public:
  explicit Blocks(std::span<const sc::Box> boxes) : order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    std::vector<std::uint64_t> code;
    for (const sc::Box& box : boxes) code.push_back(morton(box));
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return code[a] < code[b]; });
    blocks_ = (boxes.size() + 63) / 64;
    allocate(boxes_, 64 * blocks_);
    allocate(around_, (blocks_ + 7) / 8 * 8);
    for (std::size_t i = 0; i != order_.size(); ++i) {
      for (std::size_t k = 0; k != 3; ++k) {
        const sc::Box& box = boxes[order_[i]];
        floats(boxes_, k)[i] = box.lo[k];
        floats(boxes_, k + 3)[i] = box.hi[k];
        floats(around_, k)[i / 64] = std::min(floats(around_, k)[i / 64], box.lo[k]);
        floats(around_, k + 3)[i / 64] = std::max(floats(around_, k + 3)[i / 64], box.hi[k]);
      }
    }
  }

  /// Writes the indices of boxes for which kept(EightBoxes) is true, and returns how many. A
  /// box around others must be kept if one of them is.
  template <class Test>
  std::size_t list(const Test& kept, std::uint32_t* found) const {
    std::uint32_t* next = found;
    for (std::size_t b = 0; b < blocks_; b += lanes) {
      for (unsigned near = bits(kept(eight(around_, b))); near != 0; near &= near - 1) {
        const std::size_t first = 64 * (b + static_cast<unsigned>(std::countr_zero(near)));
        if (first >= 64 * blocks_) break;
        for (std::size_t i = first; i != first + 64; i += lanes) {
          for (unsigned left = bits(kept(eight(boxes_, i))); left != 0; left &= left - 1) {
            *next++ = order_[i + static_cast<unsigned>(std::countr_zero(left))];
          }
        }
      }
    }
    return static_cast<std::size_t>(next - found);
  }

 private:
  using Columns = std::array<std::vector<Floats>, 6>;

  static float* floats(Columns& columns, std::size_t c) {
    return reinterpret_cast<float*>(columns[c].data());
  }
  static void allocate(Columns& columns, std::size_t count) {  // of empty boxes
    for (std::size_t c = 0; c != 6; ++c)
      columns[c].assign(count / lanes, all(c < 3 ? 1e30F : -1e30F));
  }
  static EightBoxes eight(const Columns& columns, std::size_t i) {
    EightBoxes boxes;
    for (std::size_t c = 0; c != 6; ++c) boxes[c] = columns[c][i / lanes];
    return boxes;
  }
  static std::uint64_t morton(const sc::Box& box) {
    std::uint64_t code = 0;
    for (std::size_t k = 0; k != 3; ++k) {
      const auto cell = static_cast<std::uint64_t>(512 * (box.lo[k] + box.hi[k]) / 2 + 0x1p19F);
      for (unsigned bit = 0; bit != 20; ++bit) code |= (cell >> bit & 1U) << (3 * bit + k);
    }
    return code;
  }

  std::vector<std::uint32_t> order_;
  std::size_t blocks_ = 0;
  Columns boxes_;
  Columns around_;
};

/// Boxes that are not wholly beyond one plane.
struct InsidePlanes {
  std::vector<sc::Plane> planes;

  Mask operator()(const EightBoxes& box) const {
    Floats farthest = all(-1);
    for (const sc::Plane& plane : planes) {
      Floats beyond = all(-plane.offset);
      for (std::size_t k = 0; k != 3; ++k) {
        beyond += plane.normal[k] * box[plane.normal[k] > 0 ? k : k + 3];
      }
      farthest = larger(farthest, beyond);
    }
    return farthest <= all(0);
  }
};

/// Boxes that a ball reaches.
struct InReach {
  sc::Sphere ball;

  Mask operator()(const EightBoxes& box) const {
    Floats square = all(0);
    for (std::size_t k = 0; k != 3; ++k) {
      const Floats c = all(ball.centre[k]);
      const Floats gap = larger(larger(box[k] - c, c - box[k + 3]), all(0));
      square += gap * gap;
    }
    return square <= all(ball.radius * ball.radius);
  }
};

/// Boxes that meet the shaft from a to b: six bounds on the share of the way.
class InShaft {
 public:
  InShaft(const sc::Box& a, const sc::Box& b) {
    for (std::size_t k = 0; k != 3; ++k) {
      face(k, a.lo[k], b.lo[k], k + 3, false);  // lo(t) <= box.hi
      face(k + 3, a.hi[k], b.hi[k], k, true);   // hi(t) >= box.lo
    }
  }
  Mask operator()(const EightBoxes& box) const {
    Floats first = all(0);
    Floats last = all(1);
    for (std::size_t f = 0; f != uppers_; ++f)
      last = smaller(last, box[near_[f]] * scale_[f] + shift_[f]);
    for (std::size_t f = uppers_; f != 6; ++f)
      first = larger(first, box[near_[f]] * scale_[f] + shift_[f]);
    return first <= last;
  }

 private:
  void face(std::size_t, float from, float to, std::size_t near, bool is_hi) {
    const float slope = to - from;
    const float inverse =
        slope == 0 ? 1e30F : 1 / slope;  // a face that stays: never, or always
    const bool bounds_above = is_hi ? inverse < 0 : inverse > 0;
    const std::size_t f = bounds_above ? uppers_++ : 5 - lowers_++;
    near_[f] = near;
    scale_[f] = inverse;
    shift_[f] = -from * inverse;
  }
  std::array<std::size_t, 6> near_{};
  std::array<float, 6> scale_{};
  std::array<float, 6> shift_{};
  std::size_t uppers_ = 0;
  std::size_t lowers_ = 0;
};

/// Numbers that are the same everywhere.
class Random {
 public:
  float operator()(float low, float high) {
    seed_ = seed_ * 1664525 + 1013904223;
    return low + (high - low) * (static_cast<float>(seed_ >> 8U) / 0x1p24F);
  }

 private:
  std::uint32_t seed_ = 1;
};

/// Microseconds that work() takes: the least of some turns.
template <class Work>
double microseconds(const Work& work) {
  double least = 1e30;
  for (int turn = 0; turn != 9; ++turn) {
    const auto begin = std::chrono::steady_clock::now();
    std::chrono::duration<double, std::micro> taken{};
    int times = 0;
    while (taken.count() < 20000) {
      work(), ++times;
      taken = std::chrono::steady_clock::now() - begin;
    }
    least = std::min(least, taken.count() / times);
  }
  return least;
}

}  // namespace by_hand
