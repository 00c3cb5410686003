// SPDX-License-Identifier: MIT
#include "compiled/joining_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compiled/moving_faces.hpp"
#include "compiled/shaft_box.hpp"
#include "compiled/slab.hpp"
#include "formation/table.hpp"
#include "support/float_environment.hpp"

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

}  // namespace

void compile_joining_planes(const JoinedEdges& edges, const JoinedPlanes& planes, ShaftData& out) noexcept {
  float largest = 0;
  for (Face f = 0; f < face_count; ++f) {
    out.face[f] = shaft_face(out, f);
    largest = std::max(largest, std::fabs(out.face[f]));
  }
  double coordinate_bound[face_count];  // largest magnitude of the coordinates that matter: those in the shaft box or
                                        // at most its width away from it
  for (Face f = 0; f < 3; ++f) {
    const double lo = out.face[f];
    const double hi = out.face[f + 3];
    coordinate_bound[f] = coordinate_bound[f + 3] = std::max(std::fabs(lo), std::fabs(hi)) + (hi - lo);
  }
  for (std::size_t i = 0; i < max_joining_planes; ++i) {
    const auto [red, blue] = edges.edge[i];
    out.joining_normal0[i] = planes.red_normal[i];
    out.joining_normal1[i] = planes.blue_normal[i];
    out.joining_minus_offset[i] = -planes.offset[i];
    out.joining_near0[i] = near_stream[red];
    out.joining_near1[i] = near_stream[blue];
    out.joining_far0[i] = red;
    out.joining_far1[i] = blue;
  }
  bool regular = largest <= regular_limit;
  double margin = 0;
  for (std::size_t i = 0; i < edges.count; ++i) {
    const auto [red, blue] = edges.edge[i];
    const float red_normal = std::fabs(planes.red_normal[i]);
    const float blue_normal = std::fabs(planes.blue_normal[i]);
    margin = std::max(margin, red_normal * coordinate_bound[red] + blue_normal * coordinate_bound[blue] +
                                  std::fabs(planes.offset[i]));
    regular = regular & (std::min(red_normal, blue_normal) >= smallest_normal);
  }
  out.joining_count = edges.count;
  out.joining_margin =
      regular ? margin_of(4 * unit * slack * margin + denormals) : std::numeric_limits<float>::infinity();
}

void add_joining_planes(ShaftData& shaft) noexcept {
  in_float_environment([&] {
    const Faces6 a = std::to_array(shaft.a);
    if (shaft.kind != ShaftData::Kind::between) {
      const MovingFaces faces(shaft);
      std::array<double, face_count> step;
      Faces6 direction;  // has the colours of the faces, as a second box
      for (Face f = 0; f < face_count; ++f) {
        step[f] = std::fabs(faces.slope(f));
        direction[f] = faces.is_purple(f) ? 0.0F : faces.is_blue(f) == is_hi(f) ? 1.0F : -1.0F;
      }
      const JoinedEdges& edges = table729_edges(Faces6{}, direction);
      compile_joining_planes(edges, join(a, step, edges, true), shaft);
      return;
    }
    const Faces6 b = std::to_array(shaft.b);
    const JoinedEdges& edges = table729_edges(a, b);
    compile_joining_planes(edges, join(a, b, edges, true), shaft);
  });
}

}  // namespace shaftcull::kernel
