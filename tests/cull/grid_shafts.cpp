/// What shafts on a grid may be off by, which random bounds seldom show (docs/exactness.md, "On a grid").
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cases/shafts.hpp"
#include "compile/grid.hpp"
#include "cull/agreement.hpp"
#include "dice.hpp"
#include "instruction_sets.hpp"
#include "shaftcull/many.hpp"
#include "test/kernels.hpp"

namespace shaftcull {
namespace {

using kernel::GridFrame;
using kernel::GridShaft;

/// A face on a grid, as a near corner is compared with it.
struct GridFace {
  double middle;
  double way;
};

GridFace face_of(const CompiledShaft& shaft, const GridFrame& frame, std::uint8_t near_stream) {
  const bool is_lo = near_stream >= 3;  // the bound's hi corner is near the lo face
  const std::size_t k = near_stream % 3;
  const auto on_grid = [&](const Box& box) {
    const double x = static_cast<double>(is_lo ? box.lo[k] : box.hi[k]) - static_cast<double>(frame.origin[k]);
    return (is_lo ? -x : x) * static_cast<double>(frame.steps[k]);
  };
  return {0.5 * (on_grid(shaft.a) + on_grid(shaft.b)), on_grid(shaft.b) - on_grid(shaft.a)};
}

/// What the kernels compute of a coordinate.
int product(int coordinate, int scale) { return (coordinate * scale + (1 << 14)) >> 15; }

void expect_bounds_within_slack(const CompiledShaft& shaft, const GridFrame& frame, const GridShaft& grid) {
  const unsigned moving = 6U - grid.standing;
  double length = 2 * static_cast<double>(kernel::grid_edge);
  for (unsigned i = 0; i != moving; ++i) length = std::min(length, std::abs(face_of(shaft, frame, grid.near_stream[i]).way));
  length *= 0.5;
  constexpr double floats = 0.01;
  EXPECT_LE(grid.begin, -length / 2 + floats);
  EXPECT_GE(grid.end, length / 2 - floats);
  EXPECT_LE(grid.end, length / 2 + 1 + floats);
  for (unsigned i = 0; i != 6; ++i) {
    const GridFace face = face_of(shaft, frame, grid.near_stream[i]);
    const bool stands = i >= moving;
    const double scale = stands ? -0.5 : length / face.way;
    const double zero = stands ? face.middle + 0.5 * std::abs(face.way) : face.middle;
    ASSERT_TRUE(stands || (i < grid.uppers) == (scale < 0));
    const double half = 0.5 * std::abs(face.way);
    const double step = std::max(1.0, half / 500);
    for (double at = face.middle - half; at <= face.middle + half; at += step) {
      const int q = static_cast<int>(std::floor(at));
      const int computed = stands ? grid.shift[i] - product(q, grid.scale[i]) : product(q, grid.scale[i]) + grid.shift[i];
      const double exact = scale * (q - zero);
      const double permissive = stands || i < grid.uppers ? computed - exact : exact - computed;
      const double by_scale = static_cast<double>(kernel::scale_slack) * std::abs(face.way);
      ASSERT_GT(permissive, -0.5) << "at " << q << ", constraint " << i;  // two of them: less than one step, and all are integers
      ASSERT_LT(permissive, static_cast<double>(kernel::bound_slack + kernel::bound_error) + 2 * by_scale + floats) << "at " << q << ", constraint " << i;
    }
  }
}

TEST(GridShafts, BoundsOnTAreOffByLessThanTheirSlack) {
  constexpr std::uint64_t seed = 191;
  SCOPED_TRACE("seed " + std::to_string(seed));
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const kernel::GridKernels& kernels = kernel::active_kernels().grid;
    if (kernels.frame == nullptr) continue;
    Dice dice(seed);
    for (unsigned group = 0; group != 40; ++group) {
      std::vector<CompiledShaft> shafts;
      for (unsigned i = 0; i != 16; ++i) {
        const Subject subject = i % 4 == 0   ? nearly_equal_subject(dice)
                                : i % 4 == 1 ? distant_subject(dice, std::ldexp(1.0F, static_cast<int>(group % 16)))
                                             : random_subject(dice);
        shafts.push_back(compile(Shaft(subject.a, subject.b)));
      }
      const GridFrame frame = kernels.frame(shafts.data(), shafts.size());
      ASSERT_TRUE(frame.exists());
      std::vector<GridShaft> on_grid(shafts.size());
      kernels.form_shafts(shafts.data(), shafts.size(), frame, on_grid.data());
      for (std::size_t s = 0; s != shafts.size() && !HasFailure(); ++s) expect_bounds_within_slack(shafts[s], frame, on_grid[s]);
    }
  }
}

/// Four roundings that agree, and a limit just below an integer.
TEST(GridShafts, TheShiftBelongsToTheRoundedScale) {
  const Box frame{{-27000, -27000, -27000}, {27000, 27000, 27000}};
  const Box a{{-27000, -27000, -27000}, {6529.10742F, -6599.60059F, 27000}};
  const Box b{{-27000, -27000, -27000}, {26923.916F, -26908.6836F, 27000 - 20073.0176F}};
  std::vector<CompiledShaft> shafts(8, compile(Shaft(frame, frame)));
  shafts[0] = compile(Shaft(a, b));
  const std::vector<Box> boxes(4096, Box{{26570.0605F, -26555.9395F, -1e6F}, {1e6F, 1e6F, 1e6F}});
  const BoxStream stream{std::span<const Box>(boxes)};
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    std::vector<std::uint64_t> counts(shafts.size());
    count_many(shafts, stream.view(), counts);
    EXPECT_EQ(counts[0], 0U) << "on " << name(isa);
  }
}

}  // namespace
}  // namespace shaftcull
