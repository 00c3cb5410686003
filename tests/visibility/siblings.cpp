// SPDX-License-Identifier: MIT
/// Kernels of sibling shafts, against exact integers: every shaft of random words with every bound and solid, and
/// planes with boxes.
#include "kernels/siblings/siblings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "instruction_sets.hpp"
#include "oracle/sight.hpp"
#include "oracle/sight_scene.hpp"
#include "sanitizers.hpp"
#include "visibility/box_row.hpp"

namespace shaftcull {
namespace {

using kernel::BoxRow;
using kernel::most_siblings;
using kernel::PlaneRow;
using kernel::PlaneStreams;
using kernel::SiblingKernels;
using kernel::Siblings;

/// Boxes in six streams that can be read to the end of a vector.
class Streams {
 public:
  explicit Streams(const std::vector<Box>& boxes) {
    for (std::size_t s = 0; s != 6; ++s) {
      memory_[s].assign(2 * most_siblings, 0.0F);
      for (std::size_t i = 0; i != boxes.size(); ++i) memory_[s][i] = s < 3 ? boxes[i].lo[s] : boxes[i].hi[s - 3];
      stream_[s] = memory_[s].data();
      opposite_[(s + 3) % 6] = memory_[s].data();
    }
  }
  [[nodiscard]] const float* const* get() const { return stream_; }
  /// The opposite faces: of relative interiors, all faces are left out.
  [[nodiscard]] const float* const* inward() const { return opposite_; }

 private:
  std::vector<float> memory_[6];
  const float* stream_[6] = {};
  const float* opposite_[6] = {};
};

/// The shafts from one box to up to 64 others, with all that is true of them.
struct Word {
  oracle::SightQuestion question;
  std::vector<BoxRow> bounds;
  std::vector<BoxRow> solids;
  std::vector<std::uint64_t> kept;      ///< of each bound
  std::vector<std::uint64_t> occluded;  ///< of each solid

  Word(SightScenery scenery, std::uint64_t seed) {
    SightScene scene = random_sight_scene(scenery, seed, most_siblings);
    if (scene.is_of_one_set) scene.b = scene.a;
    question.a = {scene.a.front()};
    question.b = scene.b;
    question.contact = scene.contact;
    question.solids_around_ends = scene.solids_around_ends;
    const auto add_bounds = [&](const std::vector<Box>& boxes) {
      for (const Box& box : boxes) {
        question.occluders.push_back({box, {}});
        bounds.push_back(row_of(box));
        question.solids.push_back(box);
        solids.push_back(row_of(box));
      }
    };
    add_bounds(scene.boxes);
    add_bounds(scene.solids);
    add_bounds(scene.a);
    const oracle::SightOracle oracle(question);
    const auto word = [&](const auto& is_so) {
      std::uint64_t bits = 0;
      for (std::size_t lane = 0; lane != question.b.size(); ++lane) bits |= std::uint64_t{is_so(lane)} << lane;
      return bits;
    };
    for (std::size_t k = 0; k != bounds.size(); ++k) {
      kept.push_back(word([&](std::size_t lane) { return oracle.reaches(0, lane, k); }));
      occluded.push_back(word([&](std::size_t lane) { return oracle.blocks(0, lane, k); }));
    }
  }
};

/// What a wrong answer looks like in tests of mutants, too.
std::string wrong(const char* form, std::uint64_t right, std::uint64_t answered, std::size_t bound) {
  const std::uint64_t differing = right ^ answered;
  if (differing == 0) return {};
  const bool is = (right & differing & (~differing + 1)) != 0;
  const bool blocks = std::string(form) == "occluded siblings";
  return std::string("on ") + std::string(name(active_isa())) + ", form " + form + "; bound " + std::to_string(bound) +
         " of lanes " + std::to_string(differing) + " is " +
         (blocks ? (is ? "blocking" : "not blocking") : (is ? "overlap" : "outside")) + ", answered " +
         (blocks ? (is ? "not blocking" : "blocking") : (is ? "outside" : "overlap"));
}

void expect_exact(const Word& word, Random& random) {
  const SiblingKernels& kernels = kernel::active_kernels().siblings;
  const auto count = static_cast<unsigned>(word.question.b.size());
  const Streams others(word.question.b);
  const BoxRow fixed = row_of(word.question.a.front());
  Siblings siblings;
  const std::uint64_t all = count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
  kernels.form(fixed.face, others.get(), count, all, siblings);
  siblings.contact = word.question.contact;
  siblings.solids_around_ends = word.question.solids_around_ends;
  siblings.are_groups = false;
  const Box& end = word.question.a.front();
  const float fixed_inward[6] = {end.hi[0], end.hi[1], end.hi[2], end.lo[0], end.lo[1], end.lo[2]};
  siblings.fixed_inward = fixed_inward;
  siblings.other_inward = others.inward();

  std::vector<std::uint32_t> list(word.bounds.size());
  std::vector<std::uint64_t> may(list.size());
  for (std::size_t i = 0; i != list.size(); ++i) {
    list[i] = static_cast<std::uint32_t>(list.size() - 1 - i);
    const std::uint64_t high = std::uint64_t{random.below(~0U)} << 32U;
    may[i] = high | random.below(~0U);
  }
  std::vector<std::uint64_t> kept(list.size());
  for (const bool is_masked : {false, true}) {
    const std::uint64_t asked = is_masked ? all & 0x5a5a5a5a5a5a5a5aU : all;
    const std::uint64_t* const mask = is_masked ? may.data() : nullptr;
    const std::uint64_t any =
        kernels.keep(siblings, word.bounds.data(), list.data(), list.size(), mask, asked, kept.data());
    std::uint64_t right_any = 0;
    for (std::size_t i = 0; i != list.size(); ++i) {
      const std::uint64_t right = word.kept[list[i]] & asked & (is_masked ? may[i] : ~std::uint64_t{0});
      right_any |= right;
      ASSERT_EQ(wrong("siblings", right, kept[i], list[i]), "");
    }
    ASSERT_EQ(any, right_any);
    ASSERT_EQ(kernels.keep_any(siblings, word.bounds.data(), list.data(), list.size(), mask, asked), right_any);
    std::uint64_t right_occluded = 0;
    for (std::size_t i = 0; i != list.size(); ++i) {
      const std::uint64_t lanes = asked & (is_masked ? may[i] : ~std::uint64_t{0});
      right_occluded |= word.occluded[list[i]] & lanes;
      const std::uint64_t alone =
          kernels.block(siblings, word.solids.data(), &list[i], 1, is_masked ? &may[i] : nullptr, asked);
      ASSERT_EQ(wrong("occluded siblings", word.occluded[list[i]] & lanes, alone, list[i]), "");
    }
    ASSERT_EQ(kernels.block(siblings, word.solids.data(), list.data(), list.size(), mask, asked), right_occluded);
    // It may say that a solid may block, but not say no of one that does.
    kernels.may_block(siblings, word.solids.data(), list.data(), list.size(), mask, asked, kept.data());
    for (std::size_t i = 0; i != list.size(); ++i) {
      const std::uint64_t lanes = asked & (is_masked ? may[i] : ~std::uint64_t{0});
      ASSERT_EQ(word.occluded[list[i]] & lanes & ~kept[i], 0U) << "solid " << list[i];
    }
  }
}

TEST(Siblings, AnswersAreTheSameOnEveryInstructionSet) {
  constexpr SightScenery sceneries[] = {SightScenery::lattice, SightScenery::flat,       SightScenery::uniform,
                                        SightScenery::nudged,  SightScenery::near_edges, SightScenery::near_edges,
                                        SightScenery::wild,    SightScenery::tiny,       SightScenery::huge};
  for (std::uint64_t seed = 1; seed <= random_cases(270); ++seed) {
    const SightScenery scenery = sceneries[seed % std::size(sceneries)];
    if (scenery == SightScenery::wild && seed % 2 == 0) continue;
    SCOPED_TRACE(std::string("Word(") + name(scenery) + ", " + std::to_string(seed) + ")");
    const Word word(scenery, seed);
    on_each_instruction_set([&] {
      Random random(seed);
      expect_exact(word, random);
    });
    if (HasFailure()) return;
  }
}

/// Shafts and bounds that touch as nearly as floats can say, of each of which only some lanes do.
TEST(Siblings, DecideWhatRoundingCannot) {
  for (std::uint64_t seed = 1; seed <= random_cases(1500); ++seed) {
    SCOPED_TRACE("near edges, " + std::to_string(seed));
    Random random(seed);
    Word word(SightScenery::near_edges, seed);
    // One bound and one solid for a lane, with faces where the moving box is at a time of theirs.
    oracle::SightQuestion& question = word.question;
    question.b.resize(std::min<std::size_t>(question.b.size(), 16));
    question.occluders.clear();
    question.solids.clear();
    word.bounds.clear();
    for (const Box& b : question.b) {
      const Box& a = question.a.front();
      const double t = double{random.uniform(0.05F, 0.95F)};
      Box bound{};
      Box solid{};
      const std::size_t open_axis = random.below(3);
      for (std::size_t k = 0; k != 3; ++k) {
        const auto lo = static_cast<float>((1 - t) * double{a.lo[k]} + t * double{b.lo[k]});
        const auto hi = static_cast<float>((1 - t) * double{a.hi[k]} + t * double{b.hi[k]});
        const bool is_above = random.one_in(2);
        bound.lo[k] = k == open_axis ? -4.0F : is_above ? random.nudge(hi) : -4.0F;
        bound.hi[k] = k == open_axis ? 4.0F : is_above ? 4.0F : random.nudge(lo);
        // Solid on two axes from just outside of the box at a time on, and thin along none.
        solid.lo[k] = random.one_in(2) ? random.nudge(lo) : -4.0F;
        solid.hi[k] = random.one_in(2) ? std::max(solid.lo[k], random.nudge(hi)) : 4.0F;
      }
      for (const Box& box : {bound, solid}) {
        question.occluders.push_back({box, {}});
        question.solids.push_back(box);
        word.bounds.push_back(row_of(box));
      }
    }
    word.solids = word.bounds;
    word.kept.clear();
    word.occluded.clear();
    const oracle::SightOracle oracle(question);
    for (std::size_t k = 0; k != word.bounds.size(); ++k) {
      std::uint64_t kept = 0;
      std::uint64_t occluded = 0;
      for (std::size_t lane = 0; lane != question.b.size(); ++lane) {
        kept |= std::uint64_t{oracle.reaches(0, lane, k)} << lane;
        occluded |= std::uint64_t{oracle.blocks(0, lane, k)} << lane;
      }
      word.kept.push_back(kept);
      word.occluded.push_back(occluded);
    }
    on_each_instruction_set([&] { expect_exact(word, random); });
    if (HasFailure()) return;
  }
}

// Groups: what one of their patches would keep is kept. A flat bound in a face of the shaft of the groups may be in the
// plane of two flat patches.
TEST(Siblings, OfGroupsKeepFlatBoundsThatTouch) {
  const Box group{{0, 0, 0}, {1, 1, 1}};
  const std::vector<Box> others{{{4, 0, 0}, {5, 1, 1}}, {{4, 0, 4}, {5, 1, 5}}};
  const Box flat{{2, 1, -1}, {3, 1, 6}};     // in the plane of all upper faces
  const Box deep{{2, 1, -1}, {3, 1.5F, 6}};  // touches that plane only
  const BoxRow rows[] = {row_of(flat), row_of(deep)};
  const std::uint32_t list[] = {0, 1};
  const Streams streams(others);
  const BoxRow fixed = row_of(group);
  on_each_instruction_set([&] {
    const SiblingKernels& kernels = kernel::active_kernels().siblings;
    Siblings siblings;
    kernels.form(fixed.face, streams.get(), 2, 3, siblings);
    siblings.solids_around_ends = true;
    siblings.contact = Contact::open;
    std::uint64_t kept[2] = {};
    siblings.are_groups = true;
    kernels.keep(siblings, rows, list, 2, nullptr, 3, kept);
    EXPECT_EQ(kept[0], 3U);
    EXPECT_EQ(kept[1], 0U);
    siblings.are_groups = false;
    kernels.keep(siblings, rows, list, 2, nullptr, 3, kept);
    EXPECT_EQ(kept[0], 0U);
    EXPECT_EQ(kept[1], 0U);
  });
}

TEST(Siblings, BoxesAreBehindPlanesExactly) {
  for (std::uint64_t seed = 1; seed <= random_cases(150); ++seed) {
    constexpr SightScenery sceneries[] = {SightScenery::lattice, SightScenery::uniform, SightScenery::nudged,
                                          SightScenery::tiny,    SightScenery::huge,    SightScenery::room};
    const SightScenery scenery = sceneries[seed % std::size(sceneries)];
    SCOPED_TRACE(std::string(name(scenery)) + ", " + std::to_string(seed));
    SightScene scene = random_sight_scene(scenery, seed, most_siblings);
    if (scene.a_planes.empty()) continue;
    oracle::SightQuestion question;
    question.a = scene.a;
    question.a_planes = scene.a_planes;
    question.b = scene.a;
    const oracle::SightOracle oracle(question);
    const auto count = static_cast<unsigned>(scene.a.size());
    // NaN: floats say nothing, and all is decided exactly.
    std::vector<float> error(2 * most_siblings, std::numeric_limits<float>::quiet_NaN());
    std::vector<std::vector<float>> normal(3, std::vector<float>(2 * most_siblings, 0.0F));
    std::vector<float> offset(2 * most_siblings, 0.0F);
    for (std::size_t i = 0; i != count; ++i) {
      const Plane& plane = scene.a_planes[i];
      for (std::size_t k = 0; k != 3; ++k) normal[k][i] = plane.normal[k];
      offset[i] = plane.offset;
      double size = std::fabs(double{plane.offset});
      for (std::size_t k = 0; k != 3; ++k) {
        double most = 0;
        for (const Box& box : scene.a) {
          most = std::max({most, std::fabs(double{box.lo[k]}), std::fabs(double{box.hi[k]})});
        }
        size += std::fabs(double{plane.normal[k]}) * most;
      }
      if (size < 0x1p100) error[i] = static_cast<float>(8 * 0x1p-24 * size + 0x1p-120);
    }
    PlaneStreams planes{};
    for (std::size_t k = 0; k != 3; ++k) planes.least_normal[k] = planes.largest_normal[k] = normal[k].data();
    planes.least_offset = offset.data();
    planes.error = error.data();
    for (std::size_t k = 0; k != 3; ++k) planes.exact.normal[k] = normal[k].data();
    planes.exact.offset = offset.data();
    const Streams boxes(scene.a);
    on_each_instruction_set([&] {
      const SiblingKernels& kernels = kernel::active_kernels().siblings;
      for (unsigned i = 0; i != count; ++i) {
        const Plane& plane = scene.a_planes[i];
        PlaneRow row{{plane.normal[0], plane.normal[1], plane.normal[2]},
                     {plane.normal[0], plane.normal[1], plane.normal[2]},
                     plane.offset,
                     error[i],
                     planes.exact,
                     i};
        const BoxRow box = row_of(scene.a[i]);
        const std::uint64_t all = count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
        const std::uint64_t some = all & 0x3333333333333333U;
        std::uint64_t of_plane = 0;
        std::uint64_t of_box = 0;
        for (unsigned j = 0; j != count; ++j) {
          of_plane |= std::uint64_t{oracle.is_behind(i, j)} << j;
          of_box |= std::uint64_t{oracle.is_behind(j, i)} << j;
        }
        ASSERT_EQ(kernels.behind_plane(row, boxes.get(), count), of_plane) << "plane " << i;
        ASSERT_EQ(kernels.behind_planes(planes, count, box.face, all), of_box) << "box " << i;
        ASSERT_EQ(kernels.behind_planes(planes, count, box.face, some), of_box & some) << "box " << i;
        // As groups they may say no, never yes where it is no.
        ASSERT_EQ(kernels.behind_group(row, boxes.get(), count) & ~of_plane, 0U) << "plane " << i;
        ASSERT_EQ(kernels.behind_groups(planes, count, box.face, all) & ~of_box, 0U) << "box " << i;
        std::vector<Vec3> points;
        for (unsigned c = 0; c != 8; ++c) {
          Vec3 corner{};
          for (unsigned k = 0; k != 3; ++k) corner[k] = (c >> k & 1U) != 0 ? scene.a[i].hi[k] : scene.a[i].lo[k];
          points.push_back(corner);
        }
        ASSERT_EQ(kernels.points_behind_planes(planes, count, points.data(), points.size(), some), of_box & some)
            << "box " << i;
      }
    });
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace shaftcull
