// The culling of an engine for one frame: the camera's view, the shadow casters of the sun in
// four cascades, and of 64 lamps. With hulls and one tree, and with hand-written planes and
// blocks.
#include <cmath>
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <string>
#include <vector>

#include "by_hand.hpp"

namespace sc = shaftcull;

namespace {

constexpr sc::Vec3 sun{0.36F, 0.80F, 0.48F};  // towards it; of length 1
constexpr sc::Vec3 side{-0.8F, 0, 0.6F};      // across its light
constexpr sc::Vec3 up{-0.48F, 0.6F, -0.64F};  // across both

float dot(const sc::Vec3& a, const sc::Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// A camera at eye height that looks along z: 90 degrees wide and 60 high, from `near` to `far`.
struct Slice {
  std::array<float, 16> matrix;
  std::array<sc::Vec3, 8> corners;

  Slice(float near, float far) {
    const float depth = far / (far - near);
    constexpr float high = 1.73205081F;
    matrix = {1, 0, 0, -500, 0, high, 0, -2 * high, 0, 0, depth, -depth * near, 0, 0, 1, 0};
    for (std::size_t i = 0; i != 8; ++i) {
      const float z = (i & 4) == 0 ? near : far;
      const float x = (i & 1) == 0 ? -z : z;
      const float y = (i & 2) == 0 ? -z / high : z / high;
      corners[i] = {500 + x, 2 + y, z};
    }
  }
};

struct Scene {
  std::vector<sc::Box> boxes;
  std::vector<sc::Sphere> lamps;  // and how far each shines
  Slice view{0.5F, 400};
  std::vector<Slice> cascades{{0.5F, 12}, {12, 40}, {40, 120}, {120, 400}};

  Scene() {
    by_hand::Random random;
    while (boxes.size() != 50000) {
      const sc::Vec3 p{random(0, 1000), random(0, 1) * random(0, 8), random(0, 1000)};
      const float size = random(0, 1) * random(0, 4);
      boxes.push_back({p, {p[0] + size, p[1] + size * random(0.5F, 3), p[2] + size}});
    }
    while (lamps.size() != 64) {
      lamps.push_back({{random(300, 700), random(3, 6), random(-50, 350)}, 12});
    }
  }
};

struct Drawn {
  std::size_t in_view = 0;
  std::size_t by_sun = 0;
  std::size_t lamps = 0;
  std::size_t by_lamps = 0;
};

// [[hulls]]
// A view is a hull. Casters are the hull of the view and the light. All query one tree.
Drawn with_hulls(const Scene& scene, const sc::BoxTree& tree, bool exact_lamps) {
  Drawn drawn;
  std::vector<std::uint32_t> kept(tree.size());
  std::vector<std::uint32_t> lit(tree.size());
  const sc::ConvexHull view = sc::frustum(scene.view.matrix, sc::ClipDepth::zero_to_one);
  drawn.in_view = list(view, tree, std::span(kept));
  for (const Slice& cascade : scene.cascades) {
    const auto slice = sc::frustum(cascade.matrix, sc::ClipDepth::zero_to_one);
    drawn.by_sun += list(sc::casters_towards(slice, sun), tree, std::span(kept));
  }
  for (const sc::Sphere& lamp : scene.lamps) {
    if (!keeps(view, lamp)) continue;  // shines on nothing in view
    ++drawn.lamps;
    const sc::Vec3& c = lamp.centre;
    const sc::Box reach = sc::inflated({c, c}, lamp.radius);
    const std::size_t count = list(sc::compile(reach, reach), tree, std::span(lit));
    if (!exact_lamps) {
      drawn.by_lamps += count;
      continue;
    }
    const sc::ConvexHull casters = sc::casters(view, c);
    drawn.by_lamps +=
        list(casters, tree, std::span(kept), {.only = std::span(lit).first(count)});
  }
  return drawn;
}
// [[end]]

// The usual way: six planes for the view; for a cascade five planes of the box around it, as
// seen from the sun, without the plane towards the sun; for a lamp the ball that it reaches.
Drawn by_planes(const Scene& scene, const by_hand::Blocks& blocks,
                std::vector<std::uint32_t>& kept) {
  Drawn drawn;
  by_hand::InsidePlanes view;
  for (const sc::Plane& p : sc::view_planes(scene.view.matrix, sc::ClipDepth::zero_to_one)) {
    view.planes.push_back(p);
  }
  drawn.in_view = blocks.list(view, kept.data());
  for (const Slice& cascade : scene.cascades) {
    by_hand::InsidePlanes planes;
    for (const sc::Vec3& axis : {side, up, sun}) {
      float least = 1e30F;
      float most = -1e30F;
      for (const sc::Vec3& corner : cascade.corners) {
        least = std::min(least, dot(axis, corner));
        most = std::max(most, dot(axis, corner));
      }
      planes.planes.push_back({{-axis[0], -axis[1], -axis[2]}, -least});
      if (axis != sun) planes.planes.push_back({axis, most});
    }
    drawn.by_sun += blocks.list(planes, kept.data());
  }
  for (const sc::Sphere& lamp : scene.lamps) {
    bool shines = true;
    for (const sc::Plane& plane : view.planes) {
      const float length = std::sqrt(dot(plane.normal, plane.normal));
      shines = shines && dot(plane.normal, lamp.centre) - plane.offset <= lamp.radius * length;
    }
    if (!shines) continue;
    ++drawn.lamps;
    drawn.by_lamps += blocks.list(by_hand::InReach{lamp}, kept.data());
  }
  return drawn;
}

void print(const char* how, const Drawn& drawn) {
  std::printf("%s: %zu in view, %zu casters of the sun, %zu near %zu lamps\n", how,
              drawn.in_view, drawn.by_sun, drawn.by_lamps, drawn.lamps);
}

}  // namespace

int main(int argc, char** /*argv*/) {
  const Scene scene;
  const sc::BoxTree tree(scene.boxes);
  const by_hand::Blocks blocks(scene.boxes);
  std::vector<std::uint32_t> kept(2 * scene.boxes.size());
  print("planes", by_planes(scene, blocks, kept));
  print("hulls ", with_hulls(scene, tree, false));
  print("hulls, lamps exactly", with_hulls(scene, tree, true));
  if (argc == 1) return 0;
  const double by_hand = by_hand::microseconds([&] { by_planes(scene, blocks, kept); });
  std::printf("planes %.0f us, ", by_hand);
  for (const bool exact : {false, true}) {
    const double hulls = by_hand::microseconds([&] { with_hulls(scene, tree, exact); });
    std::printf("hulls%s %.0f us: %.2f x; ", exact ? ", lamps exactly," : "", hulls,
                hulls / by_hand);
  }
  std::printf("\n");
}
