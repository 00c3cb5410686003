/// Writes the seed corpus: `test_fuzz_seeds FOLDER` makes one file for each kind of input that fuzzing should start
/// from.
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "fuzz/case.hpp"
#include "oracle/cases/families.hpp"

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
    for (std::size_t i = 0; i != planes; ++i) {
      for (const float n : input.added[i].normal) add(n);
      add(input.added[i].offset);
    }
  }
  void add(float x) {
    std::uint8_t raw[sizeof x];
    std::memcpy(raw, &x, sizeof x);
    bytes_.insert(bytes_.end(), std::begin(raw), std::end(raw));
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
  write(plain, "outside-only", 32, {unit, away});
  write(plain, "inside-only", 16, {unit, away});
  write(plain, "no-spheres", 64, {unit, away});
  write(plain, "no-answers", 48, {unit});
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
  write_found(argv[1]);
  return 0;
}
