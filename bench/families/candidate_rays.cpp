// SPDX-License-Identifier: MIT
#include "families/candidate_rays.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace shaftcull::bench {
namespace {

RayBox straight(const Box& box, bool solid) {
  RayBox result{1, 0, {}, {}, solid};
  for (std::size_t k = 0; k != 3; ++k) {
    result.centre[k] = 0.5F * (box.lo[k] + box.hi[k]);
    result.half[k] = 0.5F * (box.hi[k] - box.lo[k]);
  }
  return result;
}

RayBox turned(const TurnedBox& box) {
  const auto along = [&box](std::size_t corner, std::size_t k) {
    return static_cast<double>(box[corner][k]) - static_cast<double>(box[0][k]);
  };
  const double length = std::hypot(along(1, 0), along(1, 1));
  RayBox result{static_cast<float>(along(1, 0) / length), static_cast<float>(along(1, 1) / length), {}, {}, true};
  for (std::size_t k = 0; k != 3; ++k) {
    result.centre[k] = static_cast<float>(static_cast<double>(box[0][k]) + along(7, k) / 2);
  }
  result.half = {static_cast<float>(length / 2), static_cast<float>(std::hypot(along(2, 0), along(2, 1)) / 2),
                 static_cast<float>(along(4, 2) / 2)};
  return result;
}

}  // namespace

std::vector<RayBox> ray_boxes_of(const PatchScene& scene) {
  std::vector<RayBox> boxes;
  for (const Box& box : scene.boxes) boxes.push_back(straight(box, true));
  for (const TurnedBox& box : scene.turned) boxes.push_back(turned(box));
  for (std::size_t object = scene.first_mesh(); object + 1 < scene.objects.size(); ++object) {
    Box around{scene.triangles[scene.objects[object]].vertex[0], scene.triangles[scene.objects[object]].vertex[0]};
    for (std::size_t t = scene.objects[object]; t != scene.objects[object + 1]; ++t) {
      for (const Vec3& vertex : scene.triangles[t].vertex) {
        for (std::size_t k = 0; k != 3; ++k) {
          around.lo[k] = std::min(around.lo[k], vertex[k]);
          around.hi[k] = std::max(around.hi[k], vertex[k]);
        }
      }
    }
    boxes.push_back(straight(around, false));
  }
  return boxes;
}

#ifdef SHAFTCULL_BENCH_WITH_AVX2
extern TraceCandidates* const avx2_trace_candidates;
#endif
#ifdef SHAFTCULL_BENCH_WITH_AVX512
extern TraceCandidates* const avx512_trace_candidates;
#endif

TraceCandidates* trace_candidates([[maybe_unused]] Isa isa) noexcept {
#ifdef SHAFTCULL_BENCH_WITH_AVX512
  if (isa == Isa::avx512) return avx512_trace_candidates;
#endif
#ifdef SHAFTCULL_BENCH_WITH_AVX2
  if (isa == Isa::avx2) return avx2_trace_candidates;
#endif
  return nullptr;
}

}  // namespace shaftcull::bench
