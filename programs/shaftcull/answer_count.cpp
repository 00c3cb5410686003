// SPDX-License-Identifier: MIT
#include "answer_count.hpp"

#include <algorithm>
#include <random>
#include <span>
#include <vector>

#include "shaftcull/cull.hpp"
#include "shaftcull/occluded.hpp"
#include "shaftcull/streams.hpp"

namespace shaftcull::cli {
namespace {

bool holds_all_of(const Box& box, const Box& end) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (end.lo[axis] < box.lo[axis] || end.hi[axis] > box.hi[axis]) return false;
  }
  return true;
}

AnswerCount count_answers(const RandomShafts& shafts, const ShaftChoice& choice, const Bounds& bounds,
                          const Query& query) {
  std::mt19937_64 random(shafts.seed);
  AnswerCount sum;
  for (std::uint32_t i = 0; i < shafts.count; ++i) {
    const BoxPair pair = next_pair(shafts, choice, random);
    const KeptCounts counts = count_classified(choice.form(pair.a, pair.b).compiled(), bounds, query);
    const std::size_t kept = counts.overlap + counts.inside;
    sum.bounds += bounds.size();
    sum.inside += counts.inside;
    sum.outside += bounds.size() - kept;
    if (choice.contact() == Contact::open) {
      sum.touching += count(choice.form(pair.a, pair.b, Contact::closed).compiled(), bounds, query) - kept;
    }
  }
  return sum;
}

}  // namespace

AnswerCount count_cubes(const RandomShafts& shafts, const ShaftChoice& choice) {
  return count_answers(shafts, choice, BoxStream(grid_of_cubes(shafts)), {});
}

AnswerCount count_triangles(const RandomShafts& shafts, const ShaftChoice& choice, TriangleTest test) {
  return count_answers(shafts, choice, TriangleStream(triangles_in_cubes(shafts)), {.triangle_test = test});
}

OcclusionCount count_blocking(const RandomShafts& shafts, const ShaftChoice& choice) {
  const std::vector<Box> all = grid_of_cubes(shafts);
  const BoxStream cubes(all);
  std::mt19937_64 random(shafts.seed);
  std::vector<std::uint32_t> blocking(all.size());
  OcclusionCount sum;
  for (std::uint32_t i = 0; i < shafts.count; ++i) {
    const BoxPair pair = next_pair(shafts, choice, random);
    const std::size_t found = list_occluders(choice.form(pair.a, pair.b).compiled(), cubes, std::span(blocking));
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
