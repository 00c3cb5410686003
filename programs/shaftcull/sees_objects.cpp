// SPDX-License-Identifier: MIT
#include "sees_objects.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "shaftcull/error.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

/// Where the row of two objects is, a <= b.
std::size_t row_of(std::size_t a, std::size_t b) { return b * (b + 1) / 2 + a; }

}  // namespace

ObjectSights::ObjectSights(const SeesScene& scene, std::span<const std::uint32_t> order, std::uint32_t rays)
    : scene_(scene), order_(order), rays_(rays) {
  const std::size_t objects = scene.mesh.names.size();
  if (objects > most_objects_in_pairs) {
    throw InvalidArgument(
        fmt::format("--objects: there are {} objects, but the table has at most {}; --by-material may make fewer",
                    grouped(objects), grouped(most_objects_in_pairs)));
  }
  patches_of_.resize(objects);
  sums_.resize(numbers * objects * (objects + 1) / 2);
}

std::uint64_t* ObjectSights::row(std::uint32_t a, std::uint32_t b) noexcept {
  return &sums_[numbers * row_of(std::min(a, b), std::max(a, b))];
}

std::uint32_t ObjectSights::object_of(std::uint32_t patch) const {
  return scene_.mesh.triangles[scene_.patches[patch].triangle].object;
}

std::vector<std::array<std::uint32_t, 2>> ObjectSights::objects_of(const PatchRun& run) {
  std::vector<std::array<std::uint32_t, 2>> counts;
  for (const std::uint32_t patch : order_.subspan(run.first, run.count)) {
    const std::uint32_t object = object_of(patch);
    if (patches_of_[object]++ == 0) counts.push_back({object, 0});
  }
  for (auto& [object, count] : counts) count = std::exchange(patches_of_[object], 0);
  return counts;
}

void ObjectSights::take(const SightBatch& batch, std::span<const std::uint32_t> seen) {
  for (const PairBlock& block : batch.blocks) {
    const auto sight = static_cast<std::size_t>(block.sight);
    const auto of_a = objects_of(block.a);
    if (block.a.first == block.b.first && block.a.count == block.b.count) {
      for (std::size_t i = 0; i < of_a.size(); ++i) {
        const auto [object, count] = of_a[i];
        row(object, object)[sight] += std::uint64_t{count} * (count - 1) / 2;
        for (std::size_t j = 0; j < i; ++j) row(object, of_a[j][0])[sight] += std::uint64_t{count} * of_a[j][1];
      }
      continue;
    }
    const auto of_b = objects_of(block.b);
    for (const auto& [a, count_a] : of_a) {
      for (const auto& [b, count_b] : of_b) row(a, b)[sight] += std::uint64_t{count_a} * count_b;
    }
  }
  for (std::size_t i = 0; i < batch.undecided.pairs.size(); ++i) {
    std::uint64_t* const sums = row(object_of(batch.undecided.pairs[i].a), object_of(batch.undecided.pairs[i].b));
    ++sums[static_cast<std::size_t>(Sight::undecided)];
    if (!seen.empty()) sums[numbers - 1] += seen[i];
  }
}

std::vector<ObjectPair> ObjectSights::pairs() const {
  std::vector<ObjectPair> pairs;
  const std::vector<std::string>& names = scene_.mesh.names;
  for (std::size_t a = 0; a < names.size(); ++a) {
    for (std::size_t b = a; b < names.size(); ++b) {
      const std::uint64_t* const sums = &sums_[numbers * row_of(a, b)];
      SightCounts sights{};
      for (const Sight sight : {Sight::undecided, Sight::clear, Sight::occluded, Sight::facing_away}) {
        sights.of(sight) = sums[static_cast<std::size_t>(sight)];
      }
      if (sights.total() == 0) continue;
      const double rays = static_cast<double>(rays_) * static_cast<double>(sights.undecided);
      pairs.push_back({names[a], names[b], sights, rays == 0 ? 0 : static_cast<double>(sums[numbers - 1]) / rays});
    }
  }
  return pairs;
}

}  // namespace shaftcull::cli
