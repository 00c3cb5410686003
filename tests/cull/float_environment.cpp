/// Answers do not depend on the floating-point mode that the caller runs in, and calls leave it as it was.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cases/families.hpp"
#include "columns.hpp"
#include "compile/grid.hpp"
#include "dice.hpp"
#include "float_modes.hpp"
#include "instruction_sets.hpp"
#include "on_grid.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/shaft.hpp"
#include "test/kernels.hpp"

#ifdef __SSE__

namespace shaftcull {
namespace {

/// The answers of all calls, one word behind the other.
template <class View>
std::vector<std::uint64_t> all_words(const Subject& subject, const View& bounds, unsigned doublings) {
  Shaft formed(subject.a, subject.b);
  for (const Plane& plane : subject.added) formed.add_plane(plane);
  const CompiledShaft shaft = compile(formed);
  const std::vector<Box> a(9, subject.a);
  const std::vector<Box> b(9, subject.b);
  const BoxColumns from(a);
  const BoxColumns to(b);
  std::vector<CompiledShaft> batch(9);
  compile_batch(from.view(), to.view(), batch);

  std::vector<std::uint64_t> words;
  std::vector<std::uint64_t> kept(words_for(bounds.count));
  std::vector<std::uint64_t> inside(kept);
  const auto note = [&](const std::vector<std::uint64_t>& row) { words.insert(words.end(), row.begin(), row.end()); };
  for (const CompiledShaft& each : {shaft, compile(subject.a, subject.b), batch[0], batch[8]}) {
    for (const Form form : {Form::slab, Form::planes}) {
      classify(each, bounds, kept, inside, form);
      note(kept);
      note(inside);
      cull(each, bounds, kept, form);
      note(kept);
    }
    contain(each, bounds, inside);
    note(inside);
    const GridAnswers on_grid = grid_answers(each, bounds, doublings);
    note(on_grid.kept);
    note(on_grid.inside);
  }
  return words;
}

template <class Bound>
void expect_same_in_all_modes(const Subject& subject, const std::vector<Bound>& bounds, unsigned doublings) {
  const auto memory = columns(bounds);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const std::vector<std::uint64_t> right = all_words(subject, memory.view(), doublings);
    for (const Mode& mode : modes) {
      std::vector<std::uint64_t> words;
      unsigned left = 0;
      {
        const InMode in(mode);
        words = all_words(subject, memory.view(), doublings);
        left = _mm_getcsr() & control_bits;
      }
      ASSERT_EQ(left, mode.bits & control_bits) << mode.name << " on " << name(isa);
      ASSERT_EQ(words, right) << mode.name << " on " << name(isa) << "\n  " << source_text(subject);
    }
  }
}

TEST(FloatEnvironment, AnswersAreTheSameInEveryMode) {
  constexpr std::uint64_t seed = 171;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (const Family& family : families) {
    SCOPED_TRACE(family.name);
    for (unsigned i = 0; i < 12 && !testing::Test::HasFailure(); i += 2) {
      const Subject subject = family.subject(dice, i);
      const oracle::QuickHull hull(subject);
      std::vector<Box> boxes;
      std::vector<Sphere> spheres;
      for (unsigned k = 0; k != 64; ++k) {
        boxes.push_back(family.box(dice, subject));
        spheres.push_back(family.sphere(dice, subject, hull));
      }
      expect_same_in_all_modes(subject, boxes, i);
      expect_same_in_all_modes(subject, spheres, i);
    }
  }
}

// What many shafts share is so well padded that answers would seldom show it.
TEST(FloatEnvironment, TilesAreMadeTheSameInEveryMode) {
  constexpr std::uint64_t seed = 172;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  std::vector<Sphere> spheres;
  std::vector<CompiledShaft> shafts;
  for (unsigned i = 0; i != bounds_on_grid; ++i) spheres.push_back({dice.vec3(-5, 5), dice.uniform(0.0F, 1.0F)});
  for (unsigned i = 0; i != 64; ++i) {
    const Subject subject = random_subject(dice);
    shafts.push_back(compile(Shaft(subject.a, subject.b)));
  }
  const auto memory = columns(spheres);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const kernel::Kernels& kernels = kernel::active_kernels();
    const auto made = [&] {
      std::vector<float> boxes(6 * bounds_on_grid);
      float* box[6];
      for (std::size_t s = 0; s != 6; ++s) box[s] = boxes.data() + s * bounds_on_grid;
      kernels.box_spheres(memory.view().stream.data(), bounds_on_grid, box);
      std::vector<std::int16_t> numbers;
      if (kernels.grid.frame != nullptr) {
        const kernel::GridFrame frame = kernels.grid.frame(shafts.data(), shafts.size());
        std::vector<kernel::GridShaft> on_grid(shafts.size());
        kernels.grid.form_shafts(shafts.data(), shafts.size(), frame, on_grid.data());
        alignas(64) static std::int16_t snapped[6][bounds_on_grid];
        std::int16_t* const grid[6] = {snapped[0], snapped[1], snapped[2], snapped[3], snapped[4], snapped[5]};
        kernels.grid.snap_boxes(frame, box, bounds_on_grid, grid);
        for (const auto& stream : snapped) numbers.insert(numbers.end(), std::begin(stream), std::end(stream));
        for (const kernel::GridShaft& each : on_grid) {
          numbers.insert(numbers.end(), std::begin(each.scale), std::end(each.scale));
          numbers.insert(numbers.end(), std::begin(each.shift), std::end(each.shift));
        }
      }
      return std::pair(boxes, numbers);
    };
    const auto right = made();
    for (const Mode& mode : modes) {
      const auto in_mode = [&] {
        const InMode in(mode);
        return made();
      }();
      EXPECT_EQ(in_mode.first, right.first) << mode.name << " on " << name(isa);
      EXPECT_EQ(in_mode.second, right.second) << mode.name << " on " << name(isa);
    }
  }
}

}  // namespace
}  // namespace shaftcull

#endif
