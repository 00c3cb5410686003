// SPDX-License-Identifier: MIT
/// factors/…: view factors of all pairs of a city, on one thread: blocks of 15 × 15 m every 30 m, 9 to 24 m high, and
/// the ground, in quadrilaterals of 7.5 m, as View3D was measured on.
///
/// factors/city/N has about N patches: visibility, integrals and rays, but not what add_mesh() takes. An item is a
/// patch. factors/rays/S casts S rays between the undecided pairs of the smaller one, in visible_fractions(); an item
/// is a pair. factors/lit/S casts S rays from its patches to 16 places of the sun, in lit_fractions(); an item is a
/// patch and a place.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "families/sees_scene.hpp"
#include "harness/suite.hpp"
#include "harness/threads.hpp"
#include "scenes/random.hpp"
#include "shaftcull/rays.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/triangles.hpp"
#include "shaftcull/view_factors.hpp"

namespace shaftcull::bench {
namespace {

/// Patches that are seen from where their corners run counterclockwise.
class QuadCity {
 public:
  explicit QuadCity(std::size_t blocks) {
    Random random(7);
    constexpr std::array<float, 4> heights{9, 12, 18, 24};
    const auto at = [](std::size_t i) { return 30 * static_cast<float>(i); };
    for (std::size_t i = 0; i != blocks * blocks; ++i) {
      const float x = at(i % blocks) + 10;
      const float y = at(i / blocks) + 10;
      const float height = heights[random.below(4)];
      add({x, y, 0}, {15, 0, 0}, {0, 0, height});
      add({x + 15, y, 0}, {0, 15, 0}, {0, 0, height});
      add({x + 15, y + 15, 0}, {-15, 0, 0}, {0, 0, height});
      add({x, y + 15, 0}, {0, -15, 0}, {0, 0, height});
      add({x, y, height}, {15, 0, 0}, {0, 15, 0});
    }
    const std::size_t tiles = 2 * blocks + 1;
    for (std::size_t i = 0; i != tiles * tiles; ++i) {
      const std::size_t column = i % tiles;
      const std::size_t row = i / tiles;
      if (column % 2 == 1 && row % 2 == 1) continue;  // a block stands there
      add({at(column) / 2 - 5, at(row) / 2 - 5, 0}, {15, 0, 0}, {0, 15, 0});
    }
    patches_ = PatchSet(corners_, first_);
    occluders_.add_mesh(TriangleStream(triangles_).view(), {.region = patches_.box()});
    benchmark::DoNotOptimize(
        view_factors(PatchSet(std::span(corners_).first(4), std::span(first_).first(2)), occluders_));
  }

  [[nodiscard]] const PatchSet& patches() const noexcept { return patches_; }
  [[nodiscard]] const Occluders& occluders() const noexcept { return occluders_; }

 private:
  void add(const Vec3& from, const Vec3& u, const Vec3& v) {
    constexpr float size = 7.5F;
    const auto pieces = [](const Vec3& of) {
      return static_cast<std::size_t>(std::ceil(std::hypot(of[0], of[1], of[2]) / size));
    };
    const std::size_t columns = pieces(u);
    const std::size_t rows = pieces(v);
    for (std::size_t i = 0; i != columns * rows; ++i) {
      const std::size_t column = i % columns;
      const std::size_t row = i / columns;
      std::array<Vec3, 4> corner{};
      constexpr std::size_t places[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      for (std::size_t c = 0; c != 4; ++c) {
        const float along = static_cast<float>(column + places[c][0]) / static_cast<float>(columns);
        const float up = static_cast<float>(row + places[c][1]) / static_cast<float>(rows);
        for (std::size_t k = 0; k != 3; ++k) corner[c][k] = from[k] + along * u[k] + up * v[k];
      }
      corners_.insert(corners_.end(), corner.begin(), corner.end());
      first_.push_back(corners_.size());
      triangles_.push_back({{corner[0], corner[1], corner[2]}});
      triangles_.push_back({{corner[0], corner[2], corner[3]}});
    }
  }

  std::vector<Vec3> corners_;
  std::vector<std::size_t> first_{0};
  std::vector<Triangle> triangles_;
  PatchSet patches_;
  Occluders occluders_;
};

}  // namespace

void declare_factors(Suite& suite, const Workload& /*workload*/) {
  const RunOptions options{.brief = !suite.quick(), .once = suite.quick()};
  for (const auto& [patches, blocks] : {std::pair{2500, 8}, std::pair{10000, 16}}) {
    if (suite.quick() && blocks != 8) continue;
    suite.add(
        fmt::format("factors/city/{}", patches), "",
        [blocks = static_cast<std::size_t>(blocks)](benchmark::State& state) {
          select_isa(measured_isa());
          const QuadCity city(blocks);
          run_on(1, [&] {
            for (auto _ : state) benchmark::DoNotOptimize(view_factors(city.patches(), city.occluders()));
          });
          state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(city.patches().size()));
        },
        options);
  }
  for (const std::uint32_t rays : {16U, 64U}) {
    suite.add(
        fmt::format("factors/rays/{}", rays), "",
        [rays](benchmark::State& state) {
          select_isa(measured_isa());
          const QuadCity city(8);
          run_on(1, [&] {
            const Visibility found = collect_visibility(city.patches(), city.occluders());
            std::vector<float> fractions(found.undecided.size());
            for (auto _ : state) {
              visible_fractions(city.patches(), city.patches(), city.occluders(),
                                {found.undecided, found.first_candidate, found.candidates}, fractions, {.rays = rays});
              benchmark::ClobberMemory();
            }
            state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(fractions.size()));
          });
        },
        options);
  }
  for (const std::uint32_t rays : {16U, 64U}) {
    suite.add(
        fmt::format("factors/lit/{}", rays), "",
        [rays](benchmark::State& state) {
          select_isa(measured_isa());
          const QuadCity city(8);
          std::vector<Vec3> suns;
          for (int i = 0; i != 16; ++i) {
            const float angle = 0.2F * (static_cast<float>(i) - 7.5F);
            suns.push_back({-std::sin(angle), -0.7F * std::cos(angle), 0.1F + 0.7F * std::cos(angle)});
          }
          std::vector<float> fractions(city.patches().size() * suns.size());
          run_on(1, [&] {
            for (auto _ : state) {
              lit_fractions(city.patches(), city.occluders(), suns, fractions, {.rays = rays});
              benchmark::ClobberMemory();
            }
          });
          state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(fractions.size()));
        },
        options);
  }
}

}  // namespace shaftcull::bench
