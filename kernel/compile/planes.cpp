#include "compile/planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compile/slab.hpp"

namespace shaftcull::kernel {
namespace {

constexpr double unit = 0x1p-24;        // of a float
constexpr double slack = 1 + 0x1p-10;   // terms of second order
constexpr double denormals = 0x1p-140;  // what underflow may take away, and more
constexpr float smallest_normal = 0x1p-100F;

/// The smallest float not below `margin`; +∞ if that is so large that arithmetic with it could overflow.
float margin_of(double margin) noexcept {
  if (!(margin < 0x1p100)) return std::numeric_limits<float>::infinity();
  const auto rounded = static_cast<float>(margin);
  return rounded < margin ? std::nextafter(rounded, std::numeric_limits<float>::infinity()) : rounded;
}

float position(const Box& box, Face f) noexcept { return f < 3 ? box.lo[f] : box.hi[f - 3]; }

float largest_magnitude(const CompiledShaft& shaft) noexcept {
  float largest = 0;
  for (const float f : shaft.face) largest = std::max(largest, std::fabs(f));
  return largest;
}

}  // namespace

void compile_joining_planes(std::span<const JoiningPlane> planes, CompiledShaft& out) noexcept {
  for (Face f = 0; f < 6; ++f) {
    const float on_a = position(out.a, f);
    const float on_b = position(out.b, f);
    out.face[f] = f < 3 ? std::min(on_a, on_b) : std::max(on_a, on_b);
  }
  double reach[3];  // where it matters, coordinates are within the shaft box, or deeper inside the plane than it is wide
  for (unsigned k = 0; k < 3; ++k) {
    const double lo = out.face[k];
    const double hi = out.face[k + 3];
    reach[k] = std::max(std::fabs(lo), std::fabs(hi)) + (hi - lo);
  }
  bool regular = largest_magnitude(out) <= regular_limit;
  double margin = 0;
  std::uint8_t count = 0;
  for (const JoiningPlane& joining : planes) {
    const Face red = joining.red;
    const Face blue = joining.blue;
    const float red_normal = joining.plane.normal[red % 3];
    const float blue_normal = joining.plane.normal[blue % 3];
    out.joining_normal0[count] = red_normal;
    out.joining_normal1[count] = blue_normal;
    out.joining_minus_offset[count] = -joining.plane.offset;
    out.joining_near0[count] = near_stream[red];
    out.joining_near1[count] = near_stream[blue];
    out.joining_far0[count] = red;
    out.joining_far1[count] = blue;
    ++count;
    margin = std::max(margin, std::fabs(red_normal) * reach[red % 3] + std::fabs(blue_normal) * reach[blue % 3] +
                                  std::fabs(joining.plane.offset));
    regular = regular && std::min(std::fabs(red_normal), std::fabs(blue_normal)) >= smallest_normal;
  }
  out.joining_count = count;
  out.joining_margin = regular ? margin_of(4 * unit * slack * margin + denormals) : std::numeric_limits<float>::infinity();
}

}  // namespace shaftcull::kernel
