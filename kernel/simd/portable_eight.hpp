/// Eight floats without vectors: of Eight's operations those that form one shaft, for instruction sets that have no
/// such register. Compilers make vectors of these loops where they can.
#pragma once

#include <cstdint>

namespace shaftcull::kernel {

/// `Tag` keeps one instruction set's copy from another's. As in Eight, the result where a lane is NaN is anything.
template <class Tag>
struct PortableEight {
  struct Vector {
    float of[8];
  };
  struct Three {
    float of[3];
  };

  static Vector load_faces(const void* box) noexcept {
    Vector faces;
    __builtin_memcpy(faces.of, box, 6 * sizeof(float));
    faces.of[6] = faces.of[4];
    faces.of[7] = faces.of[5];
    return faces;
  }
  static void store(void* to, const Vector& a) noexcept { __builtin_memcpy(to, a.of, sizeof a.of); }
  static Vector first_in_all(const Vector& a) noexcept {
    return each([&](unsigned) { return a.of[0]; });
  }
  static Vector pair_in_all(float even, float odd) noexcept { return {{even, odd, even, odd, even, odd, even, odd}}; }
  static float first(const Vector& a) noexcept { return a.of[0]; }

  static Vector subtract(const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return a.of[i] - b.of[i]; });
  }
  static Vector multiply(const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return a.of[i] * b.of[i]; });
  }
  static Vector divide(const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return a.of[i] / b.of[i]; });
  }
  static Vector maximum(const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return a.of[i] > b.of[i] ? a.of[i] : b.of[i]; });
  }
  static Vector magnitude(const Vector& a) noexcept {
    return each([&](unsigned i) { return __builtin_fabsf(a.of[i]); });
  }
  static Vector minus_magnitude(const Vector& a) noexcept {
    return each([&](unsigned i) { return -__builtin_fabsf(a.of[i]); });
  }
  static Three largest_of_three(const Vector& a, const Vector& b, const Vector& c) noexcept {
    return {{largest(a), largest(b), largest(c)}};
  }
  static bool is_ordered(const Vector& faces) noexcept {
    return (faces.of[0] <= faces.of[3]) & (faces.of[1] <= faces.of[4]) & (faces.of[2] <= faces.of[5]);
  }
  static Vector with_last_two(const Vector& a, const Vector& b) noexcept {
    return {{a.of[0], a.of[1], a.of[2], a.of[3], a.of[4], a.of[5], b.of[6], b.of[7]}};
  }
  static Vector permuted(const Vector& a, const std::uint32_t (&from)[8]) noexcept {
    return each([&](unsigned i) { return a.of[from[i]]; });
  }
  static unsigned signs(const Vector& a) noexcept {
    unsigned signs = 0;
    for (unsigned i = 0; i < 8; ++i) signs |= (__builtin_bit_cast(std::uint32_t, a.of[i]) >> 31U) << i;
    return signs;
  }

 private:
  template <class Lane>
  static Vector each(Lane lane) noexcept {
    Vector all;
    for (unsigned i = 0; i < 8; ++i) all.of[i] = lane(i);
    return all;
  }
  static float largest(const Vector& a) noexcept {  // halves, then pairs: in a row each would wait for the one before
    const auto larger = [](float x, float y) { return x > y ? x : y; };
    const float four[4] = {larger(a.of[0], a.of[4]), larger(a.of[1], a.of[5]), larger(a.of[2], a.of[6]),
                           larger(a.of[3], a.of[7])};
    return larger(larger(four[0], four[2]), larger(four[1], four[3]));
  }
};

}  // namespace shaftcull::kernel
