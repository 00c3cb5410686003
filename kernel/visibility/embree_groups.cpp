// SPDX-License-Identifier: MIT
#include "visibility/embree_groups.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <new>

#include "parallel/parallel.hpp"
#include "support/fail.hpp"

namespace shaftcull::kernel {
namespace {

constexpr unsigned packet_width = 16;

/// What let_through() finds behind Embree's own part.
struct Context {
  RTCIntersectContext embree;
  float margin;
};

/// Rejects what rays meet where one of their ends is within the margin of the triangle's plane.
void let_through(const RTCFilterFunctionNArguments* met) {
  const double margin = reinterpret_cast<const Context*>(met->context)->margin;
  for (unsigned i = 0; i != met->N; ++i) {
    if (met->valid[i] == 0) continue;
    const double normal[3] = {RTCHitN_Ng_x(met->hit, met->N, i), RTCHitN_Ng_y(met->hit, met->N, i),
                              RTCHitN_Ng_z(met->hit, met->N, i)};
    const double way[3] = {RTCRayN_dir_x(met->ray, met->N, i), RTCRayN_dir_y(met->ray, met->N, i),
                           RTCRayN_dir_z(met->ray, met->N, i)};
    double square = 0;
    double rise = 0;
    for (std::size_t k = 0; k != 3; ++k) {
      square += normal[k] * normal[k];
      rise += normal[k] * way[k];
    }
    const double at = RTCRayN_tfar(met->ray, met->N, i);
    const double nearer = std::min(at, 1 - at) * std::fabs(rise);  // times the normal's length
    if (!(nearer > margin * std::sqrt(square))) met->valid[i] = 0;
  }
}

/// What Embree refuses is memory, for its input is right.
void require_memory(bool there_is_enough) {
  if (!there_is_enough) fail(std::bad_alloc());
}

void put_rays(const RayPacket& packet, unsigned first, const Vec3& middle, float scale, RTCRay16& rays) noexcept {
  float* const from[3] = {rays.org_x, rays.org_y, rays.org_z};
  float* const way[3] = {rays.dir_x, rays.dir_y, rays.dir_z};
  for (std::size_t k = 0; k != 3; ++k) {
    const float origin = packet.origin[k] - middle[k];
    for (unsigned i = 0; i != packet_width; ++i) {
      from[k][i] = (packet.from[k][first + i] + origin) * scale;
      way[k][i] = packet.way[k][first + i] * scale;
    }
  }
  std::fill_n(rays.tnear, packet_width, 0.0F);
  std::fill_n(rays.tfar, packet_width, 1.0F);
  std::fill_n(rays.time, packet_width, 0.0F);
  std::fill_n(rays.mask, packet_width, ~0U);
  std::fill_n(rays.id, packet_width, 0U);
  std::fill_n(rays.flags, packet_width, 0U);
}

}  // namespace

void EmbreeGroups::Release::operator()(RTCDeviceTy* device) const noexcept { rtcReleaseDevice(device); }
void EmbreeGroups::Release::operator()(RTCSceneTy* scene) const noexcept { rtcReleaseScene(scene); }

std::uint32_t EmbreeGroups::add(std::span<TriangleVertices> triangles) {
  // Without a number of threads, which would hold for all of oneTBB in this process.
  if (device_ == nullptr) device_.reset(rtcNewDevice(nullptr));
  require_memory(device_ != nullptr);
  const BoxRow box = box_around(triangles);
  Group& group = groups_.emplace_back();
  float half = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    group.middle[k] = box.face[k] / 2 + box.face[k + 3] / 2;
    half = std::max({half, group.middle[k] - box.face[k], box.face[k + 3] - group.middle[k]});
  }
  group.scale = std::ldexp(1.0F, std::clamp(-std::ilogb(half) - 1, -126, 126));

  group.scene.reset(rtcNewScene(device_.get()));
  require_memory(group.scene != nullptr);
  RTCSceneTy* const scene = group.scene.get();
  RTCGeometryTy* const geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  require_memory(geometry != nullptr);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);  // which the scene keeps
  const std::size_t count = triangles.size();
  auto* const vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), 3 * count));
  auto* const indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
  require_memory(vertices != nullptr && indices != nullptr);
  for (std::size_t i = 0; i != 3 * count; ++i) {
    const Vec3& vertex = triangles[i / 3][i % 3];
    for (std::size_t k = 0; k != 3; ++k) vertices[3 * i + k] = (vertex[k] - group.middle[k]) * group.scale;
    indices[i] = static_cast<unsigned>(i);
  }
  rtcCommitGeometry(geometry);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  // Robust: no ray slips through between two triangles that share an edge.
  rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  run_apart([&] { rtcCommitScene(scene); });
  require_memory(rtcGetDeviceError(device_.get()) == RTC_ERROR_NONE);
  return static_cast<std::uint32_t>(groups_.size() - 1);
}

std::uint64_t EmbreeGroups::meet(const RayKernels& /*unused*/, const RayPacket& packet, std::uint32_t group,
                                 float margin, std::uint64_t asked) const {
  const Group& of = groups_[group];
  Context context{};
  rtcInitIntersectContext(&context.embree);
  context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  context.embree.filter = let_through;
  context.margin = margin * of.scale;
  std::uint64_t met = 0;
  for (unsigned first = 0; first < packet.count; first += packet_width) {
    const auto some = static_cast<unsigned>(asked >> first & ((1U << packet_width) - 1));
    if (some == 0) continue;
    alignas(64) RTCRay16 rays;
    alignas(64) int valid[packet_width];
    put_rays(packet, first, of.middle, of.scale, rays);
    for (unsigned i = 0; i != packet_width; ++i) valid[i] = (some >> i & 1U) != 0 ? -1 : 0;
    rtcOccluded16(valid, of.scene.get(), &context.embree, &rays);
    for (unsigned left = some; left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(left));
      if (rays.tfar[i] < 0) met |= std::uint64_t{1} << (first + i);
    }
  }
  return met;
}

}  // namespace shaftcull::kernel
