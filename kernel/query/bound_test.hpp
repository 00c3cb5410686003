// SPDX-License-Identifier: MIT
/// The test of one shaft against streams of bounds, of any kind.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "compiled/contact.hpp"
#include "compiled/shaft_data.hpp"
#include "compiled/with_planes.hpp"
#include "kernels/kernel_table.hpp"
#include "query/bound_streams.hpp"
#include "query/question.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Chooses the kernel of a question. For Question::inside `kept` may be null.
class BoundTest {
 public:
  BoundTest(const Kernels& kernels, Question question, BoundKind kind, TriangleTest triangle_test) noexcept
      : test_(question == Question::blocking         ? kernels.blocking.boxes
              : kind == BoundKind::boxes             ? kernels.boxes
              : kind == BoundKind::spheres           ? kernels.spheres
              : triangle_test == TriangleTest::exact ? kernels.triangles_exactly
                                                     : kernels.triangles_by_vertices),
        vertices_(kind == BoundKind::triangles && asks_for_inside(question) ? kernels.boxes : nullptr),
        needs_planes_(asks_for_inside(question)),
        reads_planes_(question == Question::kept && kind != BoundKind::triangles),
        are_spheres_(kind == BoundKind::spheres) {}

  void operator()(const ShaftData& shaft, const float* const* stream, std::size_t count, std::uint64_t* kept,
                  std::uint64_t* inside) const noexcept {
    if (vertices_ == nullptr) [[likely]]
      return test_(shaft, stream, count, kept, inside);
    test_triangles(shaft, stream, count, kept, inside);
  }

  /// Whether the joining planes of a shaft are read.
  [[nodiscard]] bool needs_planes(const ShaftData& shaft) const noexcept {
    return needs_planes_ || (reads_planes_ && outside_needs_planes(shaft, are_spheres_));
  }

 private:
  /// A triangle is inside if its vertices are, since a shaft is convex, and if it is kept.
  SHAFTCULL_NOINLINE void test_triangles(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                         std::uint64_t* kept, std::uint64_t* inside) const noexcept {
    constexpr std::size_t some = 1024;
    const WithClosedContact closed(shaft);  // a vertex may lie in the surface
    for (std::size_t first = 0; first < count; first += some) {
      const std::size_t size = std::min(some, count - first);
      const std::size_t words = bit_words(size);
      const float* part[9];
      for (std::size_t r = 0; r != 9; ++r) part[r] = stream[r] + first;
      std::uint64_t both_here[some / 64];
      std::fill_n(both_here, words, ~std::uint64_t{0});
      if (kept != nullptr || shaft.contact == Contact::open) test_(shaft, part, size, both_here, nullptr);
      if (kept != nullptr) std::copy_n(both_here, words, kept + first / 64);
      if (inside == nullptr) continue;
      for (std::size_t v = 0; v != 9; v += 3) {
        const float* const point[6] = {part[v], part[v + 1], part[v + 2], part[v], part[v + 1], part[v + 2]};
        std::uint64_t inside_here[some / 64];
        vertices_(closed.shaft(), point, size, nullptr, inside_here);
        for (std::size_t w = 0; w != words; ++w) both_here[w] &= inside_here[w];
      }
      std::copy_n(both_here, words, inside + first / 64);
    }
  }

  Test* test_;
  Test* vertices_;  // of points as boxes, for triangles that may be inside
  bool needs_planes_;
  bool reads_planes_;
  bool are_spheres_;
};

}  // namespace shaftcull::kernel
