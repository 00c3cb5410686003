// SPDX-License-Identifier: MIT
#include "visibility/embree_groups.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>

#include "parallel/parallel.hpp"
#include "support/fail.hpp"

namespace shaftcull::kernel {
namespace {

constexpr unsigned packet_width = 16;

/// The part of a ray's way that is in the box around a group: from `first` to `first + length`, of 0 to 1.
struct RayPart {
  double first;
  double length;
};

/// What let_through() finds behind Embree's own part. Embree's rays are these parts; their numbers are those here.
struct Context {
  RTCIntersectContext embree;
  RayPart part[packet_width];
  double margin;
};

/// Rejects what rays meet where one of their ends is within the margin of the triangle's plane.
void let_through(const RTCFilterFunctionNArguments* met) {
  const auto& context = *reinterpret_cast<const Context*>(met->context);
  for (unsigned i = 0; i != met->N; ++i) {
    if (met->valid[i] == 0) continue;
    const RayPart& part = context.part[RTCRayN_id(met->ray, met->N, i)];
    const double normal[3] = {RTCHitN_Ng_x(met->hit, met->N, i), RTCHitN_Ng_y(met->hit, met->N, i),
                              RTCHitN_Ng_z(met->hit, met->N, i)};
    const double way[3] = {RTCRayN_dir_x(met->ray, met->N, i), RTCRayN_dir_y(met->ray, met->N, i),
                           RTCRayN_dir_z(met->ray, met->N, i)};
    double square = 0;
    double rise = 0;  // of the part, times the normal's length
    for (std::size_t k = 0; k != 3; ++k) {
      square += normal[k] * normal[k];
      rise += normal[k] * way[k];
    }
    const double at = part.first + RTCRayN_tfar(met->ray, met->N, i) * part.length;
    const double nearer = std::min(at, 1 - at) * std::fabs(rise) / part.length;
    if (!(nearer > context.margin * std::sqrt(square))) met->valid[i] = 0;
  }
}

/// What Embree refuses is memory, since its input is right.
void require_memory(bool there_is_enough) {
  if (!there_is_enough) fail(std::bad_alloc());
}

/// Puts the parts of rays that are in a box into Embree's packet: Embree overflows where rays are 10¹⁸ times as long as
/// what they meet. Returns which rays have such a part.
unsigned put_rays(const RayPacket& packet, unsigned offset, const Box& box, float scale, RTCRay16& rays,
                  RayPart (&part)[packet_width]) noexcept {
  double from[3][packet_width];
  double way[3][packet_width];
  double first[packet_width] = {};
  double last[packet_width];
  std::fill_n(last, packet_width, 1.0);
  for (std::size_t k = 0; k != 3; ++k) {
    for (unsigned i = 0; i != packet_width; ++i) {
      from[k][i] = double{packet.origin[k]} + packet.from[k][offset + i];
      way[k][i] = packet.way[k][offset + i];
      // Of a ray along the plane of a face, both are infinite, or one is NaN, which is passed over.
      const double to_lo = (box.lo[k] - from[k][i]) / way[k][i];
      const double to_hi = (box.hi[k] - from[k][i]) / way[k][i];
      first[i] = std::max(first[i], std::min(to_lo, to_hi));
      last[i] = std::min(last[i], std::max(to_lo, to_hi));
    }
  }
  float* const org[3] = {rays.org_x, rays.org_y, rays.org_z};
  float* const dir[3] = {rays.dir_x, rays.dir_y, rays.dir_z};
  for (std::size_t k = 0; k != 3; ++k) {
    for (unsigned i = 0; i != packet_width; ++i) {
      org[k][i] = static_cast<float>((from[k][i] + first[i] * way[k][i]) * scale);
      dir[k][i] = static_cast<float>((last[i] - first[i]) * way[k][i] * scale);
    }
  }
  unsigned reaching = 0;
  for (unsigned i = 0; i != packet_width; ++i) {
    part[i] = {first[i], last[i] - first[i]};
    reaching |= first[i] < last[i] ? 1U << i : 0U;
    rays.tnear[i] = 0;
    rays.tfar[i] = 1;
    rays.time[i] = 0;
    rays.mask[i] = ~0U;
    rays.id[i] = i;
    rays.flags[i] = 0;
  }
  return reaching;
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
  float largest = 0;  // coordinate
  float extent = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    largest = std::max({largest, std::fabs(box.face[k]), std::fabs(box.face[k + 3])});
    extent = std::max(extent, box.face[k + 3] - box.face[k]);
  }
  // So that a flat group has parts of rays in it, too.
  const float around = std::max(extent / 64, 4 * std::numeric_limits<float>::epsilon() * largest);
  for (std::size_t k = 0; k != 3; ++k) {
    group.box.lo[k] = box.face[k] - around;
    group.box.hi[k] = box.face[k + 3] + around;
  }
  group.scale = std::ldexp(1.0F, std::clamp(-std::ilogb(largest) - 1, -126, 126));

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
    for (std::size_t k = 0; k != 3; ++k) vertices[3 * i + k] = vertex[k] * group.scale;
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
  context.margin = double{margin} * of.scale;
  std::uint64_t met = 0;
  for (unsigned first = 0; first < packet.count; first += packet_width) {
    const auto some = static_cast<unsigned>(asked >> first & ((1U << packet_width) - 1));
    if (some == 0) continue;
    alignas(64) RTCRay16 rays;
    unsigned reaching = some & put_rays(packet, first, of.box, of.scale, rays, context.part);
    if (reaching == 0) continue;
    alignas(64) int valid[packet_width];
    for (unsigned i = 0; i != packet_width; ++i) valid[i] = (reaching >> i & 1U) != 0 ? -1 : 0;
    rtcOccluded16(valid, of.scene.get(), &context.embree, &rays);
    for (; reaching != 0; reaching &= reaching - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(reaching));
      if (rays.tfar[i] < 0) met |= std::uint64_t{1} << (first + i);
    }
  }
  return met;
}

}  // namespace shaftcull::kernel
