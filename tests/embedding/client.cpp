// SPDX-License-Identifier: MIT
// A small user of the library. It checks answers against numbers on record, which do not depend on flags: its own
// arithmetic is on integers, and its floats are small whole numbers or are made of bits.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>
#include <vector>

#include <shaftcull/shaftcull.hpp>

namespace {

constexpr std::uint64_t answers_on_record = 0x1c46b1931f68850d;

class Random {
 public:
  std::uint32_t below(std::uint32_t limit) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::uint32_t>(((state_ >> 32U) * limit) >> 32U);
  }

 private:
  std::uint64_t state_ = 7;
};

/// Small whole numbers: many bounds touch faces and planes, which only exact arithmetic tells from crossing them.
float whole(std::uint32_t number) { return static_cast<float>(number); }

/// Denormal numbers, which are all 0 where they are flushed to zero.
float tiny(std::uint32_t number) {
  const std::uint32_t bits = number << 8U;
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

shaftcull::Box random_box(Random& random, std::uint32_t most_extent, float (*number)(std::uint32_t)) {
  shaftcull::Box box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t lo = random.below(64);
    box.lo[axis] = number(lo);
    box.hi[axis] = number(lo + random.below(most_extent));
  }
  return box;
}

/// Condenses all answers into one number.
class Digest {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 1099511628211U; }
  void add(std::span<const std::uint64_t> words) {
    for (const std::uint64_t word : words) add(word);
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037U;
};

std::uint64_t answers(float (*number)(std::uint32_t)) {
  Random random;
  constexpr std::size_t bounds = 1000;
  std::vector<shaftcull::Box> boxes;
  std::vector<shaftcull::Sphere> spheres;
  for (std::size_t i = 0; i < bounds; ++i) {
    boxes.push_back(random_box(random, 6, number));
    spheres.push_back({random_box(random, 1, number).lo, number(random.below(9))});
  }
  std::vector<shaftcull::CompiledShaft> shafts;
  for (std::size_t i = 0; i < 20; ++i) {
    const shaftcull::Box a = random_box(random, 9, number);
    const shaftcull::Box b = random_box(random, 9, number);
    const shaftcull::Plane plane{{1, 1, 0}, number(64)};
    shafts.push_back(compile(a, b, std::span(&plane, i % 4 == 0 ? 1 : 0)));
  }
  const shaftcull::BoxStream box_stream{std::span<const shaftcull::Box>(boxes)};
  const shaftcull::SphereStream sphere_stream{std::span<const shaftcull::Sphere>(spheres)};
  const shaftcull::BoxTree tree{std::span<const shaftcull::Box>(boxes)};

  Digest digest;
  std::vector<std::uint64_t> kept(shaftcull::bit_words(bounds));
  std::vector<std::uint64_t> inside(kept.size());
  for (const shaftcull::Form form : {shaftcull::Form::slab, shaftcull::Form::planes}) {
    for (shaftcull::CompiledShaft shaft : shafts) {
      set_form(shaft, form);
      classify(shaft, box_stream.view(), kept, inside);
      digest.add(kept);
      digest.add(inside);
      classify(shaft, sphere_stream.view(), kept, inside);
      digest.add(kept);
      digest.add(inside);
    }
  }
  // In parallel, where the library was built with oneTBB.
  std::vector<std::uint64_t> rows(shafts.size() * kept.size());
  cull_many(shafts, box_stream.view(), rows);
  digest.add(rows);
  cull_many(shafts, sphere_stream.view(), rows);
  digest.add(rows);
  std::vector<std::uint64_t> counts(shafts.size());
  count_many(shafts, tree, counts);
  digest.add(counts);
  return digest.value();
}

#ifdef __cpp_exceptions
bool refuses_a_bad_box() {
  try {
    static_cast<void>(shaftcull::compile({{1, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {1, 1, 1}}));
    return false;
  } catch (const shaftcull::InvalidArgument&) {
    return true;
  }
}
#else
bool refuses_a_bad_box() { return true; }  // would end the program
#endif

}  // namespace

int main() {
  std::uint64_t result = 0;
  for (const shaftcull::Isa isa : shaftcull::available_isas()) {
    shaftcull::select_isa(isa);
    Digest digest;
    digest.add(answers(whole));
    digest.add(answers(tiny));
    result = digest.value();
    const std::string_view name = shaftcull::name(isa);
    std::printf("%.*s: %s\n", static_cast<int>(name.size()), name.data(),
                result == answers_on_record ? "as on record" : "DIFFERENT ANSWERS");
    if (result != answers_on_record) {
      std::printf("0x%llx instead of 0x%llx\n", static_cast<unsigned long long>(result),
                  static_cast<unsigned long long>(answers_on_record));
      return 1;
    }
  }
  if (!refuses_a_bad_box()) {
    std::printf("a shaft from a bad box was not refused\n");
    return 1;
  }
  return 0;
}
