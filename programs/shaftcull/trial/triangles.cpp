// SPDX-License-Identifier: MIT
/// What trials ask about triangles.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "bits.hpp"
#include "oracle/cases/moving.hpp"
#include "oracle/cases/triangles.hpp"
#include "oracle/random.hpp"
#include "oracle/triangle.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/triangles.hpp"
#include "trial/trial.hpp"

namespace shaftcull::cli {
namespace {

/// Of the trials with boxes, one in this many is asked about triangles: rationals work out all of the answers.
constexpr unsigned triangle_trials = 64;

bool is_finite(const Triangle& triangle) {
  return std::all_of(triangle.vertex.begin(), triangle.vertex.end(), [](const Vec3& vertex) {
    return std::isfinite(vertex[0]) && std::isfinite(vertex[1]) && std::isfinite(vertex[2]);
  });
}

/// The shaft between two boxes that random triangles lie around: the whole of a shaft, or a part of it.
ShaftInput nearby(Random& /*random*/, const ShaftInput& input) { return input; }
ShaftInput nearby(Random& random, const MovingInput& input) { return part_of(random, input); }
/// Between the box around some points of a hull and that around the others.
ShaftInput nearby(Random& random, const HullInput& input) {
  const auto count = static_cast<unsigned>(input.points.size());
  const auto around = [&](std::size_t first, std::size_t end) {
    Box box{input.points[first], input.points[first]};
    for (std::size_t i = first; i != end; ++i) box = joined(box, {input.points[i], input.points[i]});
    return box;
  };
  if (count == 1) return {around(0, 1), around(0, 1)};
  const std::size_t half = 1 + random.below(count - 1);
  return {around(0, half), around(half, count)};
}

template <class Input>
bool is_outside(const Input& input, const Triangle& triangle, TriangleTest test) {
  return oracle::is_outside(input, triangle, test);
}
bool is_outside(const HullInput& input, const Triangle& triangle, TriangleTest test) {
  return oracle::is_outside(input, triangle, test, input.contact);
}

}  // namespace

void Trial::sometimes_find_triangles(Random& random) {
  if (spheres_ || !random.one_in(triangle_trials)) return;
  if (const auto* const between = std::get_if<ShaftInput>(&input_)) find_triangles(random, *between);
  if (const auto* const moving = std::get_if<MovingInput>(&input_)) find_triangles(random, *moving);
  if (const auto* const hull = std::get_if<HullInput>(&input_)) find_triangles(random, *hull);
}

template <class Input>
void Trial::find_triangles(Random& random, const Input& input) {
  const ShaftInput near = nearby(random, input);
  for (std::vector<std::uint64_t>& kept : kept_triangles_) kept.resize(bit_words(count_));
  while (triangles_.size() != count_) {
    const Triangle triangle = random.one_in(2) ? nearby_triangle(random, near) : touching_triangle(random, near);
    if (!is_finite(triangle)) continue;  // of a huge shaft
    const std::size_t i = triangles_.size();
    triangles_.push_back(triangle);
    for (const TriangleTest test : {TriangleTest::vertices, TriangleTest::exact}) {
      if (is_outside(input, triangle, test)) continue;
      kept_triangles_[static_cast<std::size_t>(test)][i / 64] |= bit_of(i);
    }
  }
}

void Trial::ask_triangles(const CompiledShaft& shaft, const char* how) {
  if (triangles_.empty()) return;
  const TriangleStream stream{std::span<const Triangle>(triangles_)};
  const TriangleTree tree(stream.view());
  for (const TriangleTest test : {TriangleTest::vertices, TriangleTest::exact}) {
    const std::vector<std::uint64_t>& right = kept_triangles_[static_cast<std::size_t>(test)];
    const auto compare_triangles = [&](const std::vector<std::uint64_t>& got, const char* of) {
      for (std::size_t i = 0; i != count_; ++i) {
        if (BitView(got)[i] == BitView(right)[i]) continue;
        fail(i, fmt::format("cull of triangles of a {}, {}, {}, {}: bit {} instead of {} for {}", of, how,
                            name(active_isa()), test == TriangleTest::exact ? "exact" : "by vertices",
                            BitView(got)[i] ? 1 : 0, BitView(right)[i] ? 1 : 0, source_text(triangles_[i])));
      }
    };
    std::vector<std::uint64_t> kept(right.size());
    cull(shaft, stream, kept, {.triangle_test = test});
    compare_triangles(kept, "stream");
    cull(shaft, tree, kept, {.triangle_test = test});
    compare_triangles(kept, "tree");
  }
}

}  // namespace shaftcull::cli
