// SPDX-License-Identifier: MIT
/// Jobs of random shafts and bounds, in files of a folder of their own.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "batch/job.hpp"
#include "batch/npy.hpp"

namespace shaftcull::test {

inline constexpr std::size_t shafts = 230;
inline constexpr std::size_t bounds = 1500;

/// Whole numbers, so that much touches and much is reached at the same time.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}
  float up_to(unsigned most) { return static_cast<float>(random_() % (most + 1)); }
  void add_box(std::vector<float>& to, unsigned space, unsigned size) {
    std::array<float, 6> box{};
    for (std::size_t axis = 0; axis != 3; ++axis) {
      box[axis] = up_to(space);
      box[axis + 3] = box[axis] + up_to(size);
    }
    to.insert(to.end(), box.begin(), box.end());
  }

 private:
  std::mt19937_64 random_;
};

inline std::vector<float> random_bounds(batch::BoundKind kind) {
  Numbers numbers(1);
  std::vector<float> floats;
  for (std::size_t i = 0; i != bounds; ++i) {
    if (kind == batch::BoundKind::box) {
      numbers.add_box(floats, 60, i % 50 == 0 ? 30 : 3);
      continue;
    }
    const std::size_t corners = kind == batch::BoundKind::triangle ? 3 : 1;
    const std::array<float, 3> at{numbers.up_to(60), numbers.up_to(60), numbers.up_to(60)};
    for (std::size_t c = 0; c != corners; ++c) {
      for (std::size_t axis = 0; axis != 3; ++axis) floats.push_back(at[axis] + (c == 0 ? 0 : numbers.up_to(4)));
    }
    if (kind == batch::BoundKind::sphere) floats.push_back(numbers.up_to(3));
  }
  return floats;
}

/// Rows of 12 or of 9 floats. Lights and occluders are apart.
inline std::vector<float> random_shafts(batch::ShaftKind kind) {
  Numbers numbers(2);
  std::vector<float> floats;
  for (std::size_t i = 0; i != shafts; ++i) {
    numbers.add_box(floats, 30, 3);
    if (kind == batch::ShaftKind::between || kind == batch::ShaftKind::shadow) {
      const std::size_t at = floats.size();
      numbers.add_box(floats, 30, 3);
      for (const std::size_t x : {at, at + 3}) floats[x] += kind == batch::ShaftKind::shadow ? 34 : 0;
    } else {
      const std::array<float, 3> vector{1 + numbers.up_to(20), numbers.up_to(20) - 10, numbers.up_to(20) - 10};
      floats.insert(floats.end(), vector.begin(), vector.end());
    }
  }
  return floats;
}

inline const batch::Surroundings undisturbed{[](const std::function<void()>& work) { work(); }, [] { return 0; }};

inline batch::JobReport run(const batch::Job& job, const batch::Surroundings& surroundings = undisturbed) {
  const auto ranks = batch::one_rank();
  return batch::run_job(job, *ranks, surroundings);
}

class BatchJob : public testing::Test {
 protected:
  BatchJob() {
    job.bounds = folder.path("bounds.npy");
    job.shafts = folder.path("shafts.npy");
    job.out = folder.path("out.h5");
    job.block = 40;
    job.progress = batch::ProgressForm::none;
    write_floats(job.bounds, 6, random_bounds(batch::BoundKind::box));
    write_floats(job.shafts, 12, random_shafts(batch::ShaftKind::between));
  }

  BatchFolder folder;
  batch::Job job;
};

}  // namespace shaftcull::test
