// SPDX-License-Identifier: MIT
#include "peers/embree.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

#include "shaftcull/isa.hpp"

namespace shaftcull::bench {
namespace {

/// Whether each patch of a pair is wholly in front of the other: then no ray needs to be looked at.
bool wholly_facing(const PatchScene& scene, const FacingPair& pair) {
  return all_in_front(scene.patch_planes[pair.a], scene.patches[pair.b]) &&
         all_in_front(scene.patch_planes[pair.b], scene.patches[pair.a]);
}

template <unsigned width>
struct Packet;
template <>
struct Packet<16> {
  using Rays = RTCRay16;
  static void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, Rays* rays) {
    rtcOccluded16(valid, scene, context, rays);
  }
};
template <>
struct Packet<8> {
  using Rays = RTCRay8;
  static void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, Rays* rays) {
    rtcOccluded8(valid, scene, context, rays);
  }
};
template <>
struct Packet<4> {
  using Rays = RTCRay4;
  static void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, Rays* rays) {
    rtcOccluded4(valid, scene, context, rays);
  }
};

/// One coordinate of the points of a patch.
template <unsigned width>
void place(const Patch& patch, std::size_t axis, const float* u, const float* v, float* points) {
  const float corner = patch.corner[axis];
  const float across = patch.across[axis];
  const float up = patch.up[axis];
  for (unsigned i = 0; i != width; ++i) points[i] = corner + u[i] * across + v[i] * up;
}

template <unsigned width>
RayCounts trace_pair(RTCScene embree, const PatchScene& scene, const FacingPair& pair, const ShadowRays& rays,
                     float least_height) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const Patch& a = scene.patches[pair.a];
  const Patch& b = scene.patches[pair.b];
  const ShadowRays::Points& of_a = a.triangle ? rays.on_triangle[0] : rays.on_rectangle[0];
  const ShadowRays::Points& of_b = b.triangle ? rays.on_triangle[1] : rays.on_rectangle[1];
  const bool all = least_height <= 0 && wholly_facing(scene, pair);
  const Plane& plane_a = scene.patch_planes[pair.a];
  const Plane& plane_b = scene.patch_planes[pair.b];
  RayCounts counts{0, 0};
  alignas(64) typename Packet<width>::Rays packet;
  alignas(64) float end[3][width];
  alignas(64) int valid[width];
  for (unsigned first = 0; first < rays.count; first += width) {
    float* const origins[3] = {packet.org_x, packet.org_y, packet.org_z};
    float* const directions[3] = {packet.dir_x, packet.dir_y, packet.dir_z};
    for (std::size_t k = 0; k != 3; ++k) {
      place<width>(a, k, &of_a[0][first], &of_a[1][first], origins[k]);
      place<width>(b, k, &of_b[0][first], &of_b[1][first], end[k]);
      for (unsigned i = 0; i != width; ++i) directions[k][i] = end[k][i] - origins[k][i];
    }
    for (unsigned i = 0; i != width; ++i) {
      packet.tnear[i] = ray_margin;
      packet.tfar[i] = 1 - ray_margin;
      packet.time[i] = 0;
      packet.mask[i] = ~0U;
      packet.id[i] = 0;
      packet.flags[i] = 0;
      valid[i] = -1;
    }
    unsigned traced = width;
    if (!all) {
      traced = 0;
      for (unsigned i = 0; i != width; ++i) {
        const float before_a = plane_a.normal[0] * end[0][i] + plane_a.normal[1] * end[1][i] +
                               plane_a.normal[2] * end[2][i] - plane_a.offset;
        const float before_b = plane_b.normal[0] * origins[0][i] + plane_b.normal[1] * origins[1][i] +
                               plane_b.normal[2] * origins[2][i] - plane_b.offset;
        const bool faces = before_a > least_height && before_b > least_height;
        valid[i] = faces ? -1 : 0;
        traced += faces ? 1 : 0;
      }
      if (traced == 0) continue;
    }
    Packet<width>::occluded(valid, embree, &context, &packet);
    unsigned clear = 0;
    for (unsigned i = 0; i != width; ++i) clear += valid[i] != 0 && packet.tfar[i] != -infinity ? 1 : 0;
    counts.traced = static_cast<std::uint16_t>(counts.traced + traced);
    counts.clear = static_cast<std::uint16_t>(counts.clear + clear);
  }
  return counts;
}

/// So that both use the same.
const char* instruction_set() {
  switch (active_isa()) {
    case Isa::avx512:
      return "isa=avx512";
    case Isa::avx2:
      return "isa=avx2";
    case Isa::sse4_2:
      return "isa=sse4.2";
    default:
      return nullptr;
  }
}

}  // namespace

struct EmbreeScene::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  unsigned packet = 4;

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

EmbreeScene::EmbreeScene(const PatchScene& scene) : handles_(std::make_unique<Handles>()), scene_(scene) {
  // Without a number of threads, which would hold for all of oneTBB in this process. Rays need none.
  handles_->device = rtcNewDevice(instruction_set());
  const RTCDevice device = handles_->device;
  if (device == nullptr) throw std::runtime_error("Embree cannot make a device");
  for (const auto& [property, width] :
       {std::pair{RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED, 8U}, {RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED, 16U}}) {
    if (rtcGetDeviceProperty(device, property) != 0) handles_->packet = width;
  }
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t count = scene.triangles.size();
  auto* const vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
  auto* const indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
  if (vertices == nullptr || indices == nullptr) throw std::bad_alloc();
  for (std::size_t i = 0; i != count; ++i) {
    for (std::size_t j = 0; j != 3; ++j) {
      std::copy_n(scene.triangles[i].vertex[j].begin(), 3, vertices + 9 * i + 3 * j);
      indices[3 * i + j] = static_cast<unsigned>(3 * i + j);
    }
  }
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  handles_->scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(handles_->scene, RTC_BUILD_QUALITY_HIGH);
  rtcAttachGeometry(handles_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(handles_->scene);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build its tree");
}

EmbreeScene::~EmbreeScene() = default;

unsigned EmbreeScene::packet() const noexcept { return handles_->packet; }

RayCounts EmbreeScene::trace(const FacingPair& pair, const ShadowRays& rays, float least_height) const {
  switch (std::min(handles_->packet, rays.count)) {
    case 16:
      return trace_pair<16>(handles_->scene, scene_, pair, rays, least_height);
    case 8:
      return trace_pair<8>(handles_->scene, scene_, pair, rays, least_height);
    default:
      return trace_pair<4>(handles_->scene, scene_, pair, rays, least_height);
  }
}

float EmbreeScene::grazing_height() const noexcept {
  float largest = 0;
  for (const Box& box : scene_.patch_boxes) {
    for (std::size_t k = 0; k != 3; ++k) largest = std::max({largest, -box.lo[k], box.hi[k]});
  }
  constexpr float roundings = 4;  // of the largest coordinate: of the ray's end, of triangles and of their planes
  return roundings * largest * std::numeric_limits<float>::epsilon() / ray_margin;
}

}  // namespace shaftcull::bench
