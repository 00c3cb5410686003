// SPDX-License-Identifier: MIT
/// Writes the seed corpus: `test_fuzz_seeds FOLDER` makes one file for each kind of input that fuzzing should start
/// from.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "fuzz/case.hpp"
#include "oracle/cases/families.hpp"
#include "oracle/cases/hulls.hpp"
#include "oracle/cases/moving.hpp"
#include "oracle/convex_hull.hpp"
#include "oracle/moving_hull.hpp"

namespace {

using namespace shaftcull;

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// An input under construction, as Case::read() takes it.
class Seed {
 public:
  Seed(const ShaftInput& input, std::uint8_t options, std::uint8_t flags) {
    bytes_.reserve(1024);  // g++ 12 warns of copies that cannot happen if this may have to grow
    bytes_.push_back(options);
    const auto planes = std::min<std::size_t>(input.added.size(), 3);
    bytes_.push_back(static_cast<std::uint8_t>(flags | planes));
    add(input.a);
    add(input.b);
    for (std::size_t i = 0; i != planes; ++i) add(input.added[i]);
  }
  Seed(const MovingInput& input, std::uint8_t options, std::uint8_t flags) {
    bytes_.reserve(1024);
    bytes_.push_back(options);
    const auto subject = static_cast<unsigned>(fuzz::Case::Subject::swept) + static_cast<unsigned>(input.kind);
    const auto planes = std::min<std::size_t>(input.added.size(), 3);
    bytes_.push_back(static_cast<std::uint8_t>(flags | subject << fuzz::subject_shift | planes));
    add(input.box);
    add(input.is_shadow() ? input.light : Box{input.displacement, {}});
    if (input.kind == MovingInput::Kind::shadow) add(input.reach);
    for (std::size_t i = 0; i != planes; ++i) add(input.added[i]);
  }
  /// Of a hull that is fitted().
  Seed(const HullInput& input, std::uint8_t flags) {
    bytes_.reserve(1024);
    bytes_.push_back(0);
    std::vector<Vec3> vertices = input.points;
    vertices.insert(vertices.end(), input.directions.begin(), input.directions.end());
    const auto subject = static_cast<unsigned>(input.directions.empty() ? fuzz::Case::Subject::hull
                                                                        : fuzz::Case::Subject::hull_without_end);
    bytes_.push_back(static_cast<std::uint8_t>(flags | subject << fuzz::subject_shift | (vertices.size() - 4)));
    for (std::size_t i = 0; i != vertices.size(); ++i) {
      for (const float x : vertices[i]) add(x);
      if (i >= 4) add(0.0F);  // an offset
    }
  }
  void add(float x) {
    std::uint8_t raw[sizeof x];
    std::memcpy(raw, &x, sizeof x);
    bytes_.insert(bytes_.end(), std::begin(raw), std::end(raw));
  }
  void add(const Plane& plane) {
    for (const float n : plane.normal) add(n);
    add(plane.offset);
  }
  void add(const Box& box) {
    for (const float x : box.lo) add(x);
    for (const float x : box.hi) add(x);
  }
  void add(const Sphere& sphere) {
    for (const float x : sphere.centre) add(x);
    add(sphere.radius);
  }
  void add_byte(unsigned byte) { bytes_.push_back(static_cast<std::uint8_t>(byte)); }

  void write(const std::filesystem::path& folder, std::string name) const {
    for (char& c : name) c = c == ' ' || c == ',' ? '-' : c;
    std::ofstream file(folder / name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
  }

 private:
  std::vector<std::uint8_t> bytes_;
};

void write_families(const std::filesystem::path& folder) {
  Random random(1);
  std::uint8_t options = 0;
  for (const Family& family : families) {
    const ShaftInput input = family.shaft(random, random.below(colourings));
    const oracle::QuickHull hull(input);
    Seed boxes(input, options++ % 16, 0);
    Seed spheres(input, 0, 0);
    Seed derived(input, 0, fuzz::sort_corners | fuzz::derive_bounds);
    Seed open(input, fuzz::open_contact, fuzz::sort_corners | fuzz::derive_bounds);
    for (int i = 0; i != 4; ++i) boxes.add(family.box(random, input));
    for (int i = 0; i != 6; ++i) spheres.add(family.sphere(random, input, hull));
    for (int i = 0; i != 36; ++i) {
      const unsigned byte = random.below(256);
      derived.add_byte(byte);
      open.add_byte(byte);
    }
    boxes.write(folder, std::string(family.name) + "-boxes");
    spheres.write(folder, std::string(family.name) + "-spheres");
    derived.write(folder, std::string(family.name) + "-derived");
    open.write(folder, std::string(family.name) + "-open");
  }
}

/// The hull of as many of its last vertices as an input may have: four to seven points, or three and one to four
/// directions.
HullInput fitted(HullInput input) {
  constexpr std::size_t most = 7;
  const bool is_endless = !input.directions.empty();
  const std::size_t least_points = is_endless ? 3 : 4;
  const std::size_t most_points = is_endless ? least_points : most;
  while (input.points.size() < least_points) input.points.push_back(input.points.back());
  if (input.points.size() > most_points)
    input.points.erase(input.points.begin(), input.points.end() - static_cast<std::ptrdiff_t>(most_points));
  if (input.directions.size() > most - least_points) input.directions.resize(most - least_points);
  return input;
}

void write_moving(const std::filesystem::path& folder) {
  constexpr const char* kinds[] = {"swept", "swept without end", "shadow", "shadow without end"};
  Random random(2);
  for (const MovingFamily& family : moving_families) {
    const bool is_lattice = family.input == lattice_movement;
    if (!is_lattice && family.input != random_movement && family.input != wild_movement) continue;
    for (const MovingKind kind : moving_kinds) {
      const MovingInput input = family.input(random, kind);
      const oracle::MovingHull hull(input);
      const std::string name = std::string(kinds[static_cast<std::size_t>(kind)]) + " " + family.name;
      Seed boxes(input, 0, 0);
      Seed spheres(input, 0, 0);
      Seed derived(input, fuzz::open_contact, fuzz::sort_corners | fuzz::derive_bounds);
      for (int i = 0; i != 4; ++i) boxes.add(family.box(random, input));
      for (int i = 0; i != 6; ++i) spheres.add(family.sphere(random, input, hull));
      for (int i = 0; i != 36; ++i) derived.add_byte(random.below(256));
      if (is_lattice) {
        derived.write(folder, name + "-open");
      } else {
        boxes.write(folder, name + "-boxes");
        spheres.write(folder, name + "-spheres");
      }
    }
  }
}

void write_hulls(const std::filesystem::path& folder) {
  Random random(3);
  for (const HullFamily& family : hull_families) {
    for (const bool is_endless : {false, true}) {
      HullInput input = family.input(random);
      if (is_endless && input.directions.empty()) input.directions.push_back(random.vec3(-1, 1));
      if (!is_endless) input.directions.clear();
      input = fitted(input);
      const oracle::ConvexHull hull(input);
      Seed boxes(input, 0);
      Seed spheres(input, 0);
      for (int i = 0; i != 4; ++i) boxes.add(family.box(random, input));
      for (int i = 0; i != 6; ++i) spheres.add(family.sphere(random, input, hull));
      const std::string name = std::string(is_endless ? "hull without end " : "hull ") + family.name;
      boxes.write(folder, name + "-boxes");
      spheres.write(folder, name + "-spheres");
    }
  }
}

/// Shafts of moving boxes and hulls that must be refused, or that mean little.
void write_odd_others(const std::filesystem::path& folder) {
  constexpr Box unit{{0, 0, 0}, {1, 1, 1}};
  constexpr Box lamp{{3, -2, 5}, {3, -2, 5}};
  const auto write = [&](const auto& input, const std::string& name) {
    Seed seed(input, 0, fuzz::fill_word);
    seed.add(unit);
    seed.add(Box{{-inf, 0, 0}, {inf, 1, 1}});
    seed.write(folder, name);
  };
  write(MovingInput{MovingKind::swept, unit, {0, 0, 0}}, "swept-nowhere");
  write(MovingInput{MovingKind::swept, unit, {0, nan, 0}}, "swept-nan");
  write(MovingInput{MovingKind::swept_infinite, unit, {0, -0.0F, 0}}, "swept-without-end-nowhere");
  write(MovingInput{MovingKind::shadow, unit, {}, lamp, 1}, "shadow-of-reach-1");
  write(MovingInput{MovingKind::shadow, unit, {}, lamp, 0.5F}, "shadow-of-reach-below-1");
  write(MovingInput{MovingKind::shadow, unit, {}, lamp, inf}, "shadow-of-infinite-reach");
  write(MovingInput{MovingKind::shadow_without_end, unit, {}, unit}, "shadow-of-what-touches");
  write(MovingInput{MovingKind::shadow_without_end, unit, {}, lamp, 1, {{{0, 0, 0}, 1}}}, "shadow-with-a-bad-plane");
  Seed hull(HullInput{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, nan, 0}}, {}}, 0);
  hull.add(unit);
  hull.write(folder, "hull-nan");
  Seed nowhere(HullInput{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}}}, 0);
  nowhere.add(unit);
  nowhere.write(folder, "hull-without-end-nowhere");
}

void write_odd_values(const std::filesystem::path& folder) {
  constexpr Box unit{{0, 0, 0}, {1, 1, 1}};
  constexpr Box away{{3, -2, 5}, {4, -1, 6}};
  const ShaftInput plain{unit, away};
  const auto write = [&](const ShaftInput& input, const std::string& name, std::uint8_t options,
                         const std::vector<Box>& bounds) {
    Seed seed(input, options, fuzz::fill_word);
    for (const Box& box : bounds) seed.add(box);
    seed.write(folder, name);
  };
  write(plain, "infinite-bounds", 0,
        {{{-inf, -inf, -inf}, {inf, inf, inf}},
         {{inf, inf, inf}, {-inf, -inf, -inf}},
         {{-inf, 0, 0}, {0, 1, inf}},
         {{inf, 0, 0}, {inf, 1, 1}}});
  write(plain, "nan-bounds", 0,
        {{{nan, 0, 0}, {1, 1, 1}}, {{nan, nan, nan}, {nan, nan, nan}}, {{0, 0, 0}, {1, -nan, inf}}});
  write(plain, "inverted-bounds", 0, {{{1, 0, 0}, {0, 1, 1}}, {{5, 5, 5}, {-5, -5, -5}}});
  write(plain, "no-groups", 64, {unit, away});
  write({unit, unit}, "equal-boxes", 0, {unit, away});
  write({unit, {{2, 0, 0}, {3, 1, 1}}}, "purple-faces", 0,
        {unit, {{1, 1, 1}, {2, 2, 2}}, {{1.5F, -1, 0}, {1.5F, 0, 0}}});
  write({{{0, 0, nan}, {1, 1, 1}}, away}, "nan-shaft", 0, {unit});
  write({{{0, 0, 0}, {1, inf, 1}}, away}, "infinite-shaft", 0, {unit});
  write({{{0, 2, 0}, {1, 1, 1}}, away}, "inverted-shaft", 0, {unit});
  write({unit, away, {{{0, 0, 0}, 1}, {{nan, 0, 1}, 1}, {{1, 0, 0}, inf}}}, "bad-planes", 0, {unit});
}

/// Spheres that meet the shaft, and were culled by vectors without multiply-add.
void write_found(const std::filesystem::path& folder) {
  ShaftInput huge{};
  huge.a.lo[0] = huge.a.hi[0] = 0x1p+73F;
  huge.b.lo[0] = huge.b.hi[0] = -0x1p+73F;
  huge.b.lo[1] = huge.b.hi[1] = 0x1.9fdf8cp+68F;
  Seed seed(huge, 0, 0);
  for (int i = 0; i != 6; ++i) seed.add(Sphere{{0x1.ff1124p+72F, -0x1.3b2c48p+59F, 0}, 0x1p+60F});
  seed.write(folder, "found-huge-slopes");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
    std::fprintf(stderr, "usage: test_fuzz_seeds FOLDER   writes the seed corpus into a folder that exists\n");
    return 2;
  }
  write_families(argv[1]);
  write_odd_values(argv[1]);
  write_moving(argv[1]);
  write_hulls(argv[1]);
  write_odd_others(argv[1]);
  write_found(argv[1]);
  return 0;
}
