// SPDX-License-Identifier: MIT
#include "answer_count.hpp"

#include <algorithm>
#include <array>
#include <random>
#include <span>
#include <vector>

#include "bits.hpp"
#include "shaftcull/blocked.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/streams.hpp"

namespace shaftcull::cli {
namespace {

bool holds_all_of(const Box& box, const Box& end) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (end.lo[axis] < box.lo[axis] || end.hi[axis] > box.hi[axis]) return false;
  }
  return true;
}

/// Which triangles have all three corners inside a shaft.
class CornersInside {
 public:
  explicit CornersInside(std::span<const Triangle> triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::vector<Box> corners;
      for (const Triangle& triangle : triangles) corners.push_back({triangle.vertex[i], triangle.vertex[i]});
      corners_[i] = BoxStream(corners);
    }
  }

  /// Clears the bits of all others.
  void keep_in(std::span<std::uint64_t> bits, const CompiledShaft& shaft) {
    inside_.resize(bits.size());
    for (const BoxStream& corners : corners_) {
      contained(shaft, corners.view(), inside_);
      for (std::size_t w = 0; w < bits.size(); ++w) bits[w] &= inside_[w];
    }
  }

 private:
  std::array<BoxStream, 3> corners_;
  std::vector<std::uint64_t> inside_;
};

}  // namespace

AnswerCount count_cubes(const RandomShafts& shafts, const ShaftChoice& choice) {
  const BoxStream cubes(grid_of_cubes(shafts));
  std::mt19937_64 random(shafts.seed);
  std::vector<std::uint64_t> kept(words_for(cubes.size()));
  std::vector<std::uint64_t> inside(kept.size());
  AnswerCount sum;
  for (std::uint32_t i = 0; i < shafts.count; ++i) {
    const BoxPair pair = next_pair(shafts, choice, random);
    classify(choice.form(pair.a, pair.b).compiled(), cubes, kept, inside);
    const std::uint64_t kept_count = bits_in(kept);
    sum.bounds += cubes.size();
    sum.inside += bits_in(inside);
    sum.outside += cubes.size() - kept_count;
    if (choice.contact() == Contact::open) {
      sum.touching += count(choice.form(pair.a, pair.b, Contact::closed).compiled(), cubes) - kept_count;
    }
  }
  return sum;
}

AnswerCount count_triangles(const RandomShafts& shafts, const ShaftChoice& choice, TriangleTest test) {
  const std::vector<Triangle> all = triangles_in_cubes(shafts);
  const TriangleStream triangles{std::span<const Triangle>(all)};
  CornersInside corners(all);
  std::mt19937_64 random(shafts.seed);
  std::vector<std::uint64_t> kept(words_for(all.size()));
  AnswerCount sum;
  for (std::uint32_t i = 0; i < shafts.count; ++i) {
    const BoxPair pair = next_pair(shafts, choice, random);
    cull(choice.form(pair.a, pair.b).compiled(), triangles, kept, test);
    const std::uint64_t kept_count = bits_in(kept);
    sum.bounds += all.size();
    sum.outside += all.size() - kept_count;
    // Corners of what is inside may be in the surface of the shaft, where points are outside with open contact.
    const FormedShaft closed = choice.form(pair.a, pair.b, Contact::closed);
    if (choice.contact() == Contact::open) sum.touching += count(closed.compiled(), triangles, test) - kept_count;
    corners.keep_in(kept, closed.compiled());
    sum.inside += bits_in(kept);
  }
  return sum;
}

BlockingCount count_blocking(const RandomShafts& shafts, const ShaftChoice& choice) {
  const std::vector<Box> all = grid_of_cubes(shafts);
  const BoxStream cubes(all);
  std::mt19937_64 random(shafts.seed);
  std::vector<std::uint32_t> blocking(all.size());
  BlockingCount sum;
  for (std::uint32_t i = 0; i < shafts.count; ++i) {
    const BoxPair pair = next_pair(shafts, choice, random);
    const std::size_t found = list_blocking(choice.form(pair.a, pair.b).compiled(), cubes, std::span(blocking));
    const auto between = static_cast<std::size_t>(std::count_if(
        blocking.begin(), blocking.begin() + static_cast<std::ptrdiff_t>(found),
        [&](std::uint32_t cube) { return !holds_all_of(all[cube], pair.a) && !holds_all_of(all[cube], pair.b); }));
    sum.cubes.all += all.size();
    sum.cubes.by_any += found;
    sum.cubes.by_one_between += between;
    sum.shafts.all += 1;
    sum.shafts.by_any += found != 0 ? 1 : 0;
    sum.shafts.by_one_between += between != 0 ? 1 : 0;
  }
  return sum;
}

}  // namespace shaftcull::cli
