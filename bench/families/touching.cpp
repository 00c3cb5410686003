// SPDX-License-Identifier: MIT
/// exact/touching/…: what a test costs that only exact arithmetic decides: boxes, points and spheres that touch a
/// joining plane.
///
/// All coordinates and radii are integers, and joining planes of the axes x and y have normals like (4, −3) / 5, so
/// that bounds touch them exactly. Moved out by 2⁻¹⁰ they are outside.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "harness/suite.hpp"
#include "scenes/random.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/isa.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::size_t shafts = 16;
constexpr std::size_t bounds = 256;  // of each shaft, all touching it

float integer(Random& random, int low, int high) {
  return static_cast<float>(low + static_cast<int>(random.below(static_cast<unsigned>(high - low + 1))));
}

/// A box with integer corners in −8 … 24 and sides of up to `side`.
Box integer_box(Random& random, int side) {
  Box box{};
  for (std::size_t k = 0; k < 3; ++k) {
    box.lo[k] = integer(random, -8, 24 - side);
    box.hi[k] = box.lo[k] + integer(random, 0, side);
  }
  return box;
}

Box translated(Box box, const Vec3& by) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.lo[k] += by[k];
    box.hi[k] += by[k];
  }
  return box;
}

Sphere translated(Sphere sphere, const Vec3& by) {
  for (std::size_t k = 0; k < 3; ++k) sphere.centre[k] += by[k];
  return sphere;
}

/// A box that moves by (3 k, ±4 k, m), and by how much a bound must move to be farther from a joining plane of x and y.
struct Moving {
  Box from;
  Box to;
  Vec3 outwards;

  explicit Moving(Random& random) {
    const float k = integer(random, 1, 3);
    const float y = random.below(2) == 0 ? 4 * k : -4 * k;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from.lo[axis] = integer(random, 0, 8);
      from.hi[axis] = from.lo[axis] + integer(random, 1, 4);
    }
    to = translated(from, {3 * k, y, integer(random, -6, 6)});
    const float side = random.below(2) == 0 ? 0x1p-10F : -0x1p-10F;
    outwards = {side, y > 0 ? -side : side, 0};
  }
};

/// Bits of the bounds that a shaft keeps.
template <class Stream, class Bound>
std::vector<std::uint64_t> kept_of(const CompiledShaft& shaft, const std::vector<Bound>& of) {
  std::vector<std::uint64_t> kept(bit_words(of.size()));
  cull(shaft, Stream(std::span<const Bound>(of)).view(), kept);
  return kept;
}

/// Shafts, and bounds that touch them.
template <class Stream>
struct Scene {
  std::vector<CompiledShaft> compiled;
  std::vector<Stream> touching;

  /// `make` makes one bound that may touch.
  template <class Make>
  Scene(std::uint32_t seed, Make make) {
    using Bound = std::invoke_result_t<Make, Random&>;
    constexpr std::size_t tries = 4096;
    Random random(seed);
    for (std::size_t s = 0; s < shafts; ++s) {
      const Moving moving(random);
      compiled.push_back(compile(moving.from, moving.to));
      complete(compiled.back());
      std::vector<Bound> found;
      while (found.size() < bounds) {
        std::vector<Bound> tried;
        std::vector<Bound> farther;
        for (std::size_t i = 0; i < tries; ++i) {
          tried.push_back(make(random));
          farther.push_back(translated(tried[i], moving.outwards));
        }
        const auto kept = kept_of<Stream>(compiled[s], tried);
        const auto kept_farther = kept_of<Stream>(compiled[s], farther);
        for (std::size_t i = 0; i < tries && found.size() < bounds; ++i) {
          if (BitView(kept)[i] && !BitView(kept_farther)[i]) found.push_back(tried[i]);
        }
      }
      touching.push_back(Stream(std::span<const Bound>(found)));
    }
  }
};

template <class Stream, class Make>
void declare_scene(Suite& suite, const std::string& name, std::uint32_t seed, Make make) {
  const auto scene = std::make_shared<std::unique_ptr<const Scene<Stream>>>();
  for (const Isa isa : available_isas()) {
    if (isa != Isa::avx2 && isa != Isa::avx512) continue;
    suite.add(name + "/" + std::string(shaftcull::name(isa)), "", [=](benchmark::State& state) {
      select_isa(isa);
      if (!*scene) *scene = std::make_unique<const Scene<Stream>>(seed, make);
      std::array<std::uint64_t, bit_words(bounds)> kept{};
      for (auto _ : state) {
        for (std::size_t s = 0; s < shafts; ++s) {
          cull((*scene)->compiled[s], (*scene)->touching[s].view(), kept);
          benchmark::DoNotOptimize(kept);
        }
      }
      state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(shafts * bounds));
    });
    if (name != "exact/touching/boxes") {
      suite.add_time_ratio_target(name + "/" + std::string(shaftcull::name(isa)),
                                  "exact/touching/boxes/" + std::string(shaftcull::name(isa)), 3);
    }
  }
}

}  // namespace

void declare_touching(Suite& suite, const Workload& /*workload*/) {
  declare_scene<BoxStream>(suite, "exact/touching/boxes", 3010, [](Random& random) { return integer_box(random, 4); });
  const auto centre = [](Random& random) {
    return Vec3{integer(random, -8, 24), integer(random, -8, 24), integer(random, -8, 24)};
  };
  declare_scene<SphereStream>(suite, "exact/touching/points", 3011, [=](Random& random) {
    return Sphere{centre(random), 0};
  });
  declare_scene<SphereStream>(suite, "exact/touching/spheres", 3012, [=](Random& random) {
    return Sphere{centre(random), integer(random, 1, 4)};
  });
}

}  // namespace shaftcull::bench
