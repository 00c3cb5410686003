// SPDX-License-Identifier: MIT
/// One shaft against one bound.
#include "arguments.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::CompiledShaft;

namespace {

/// Whether it is kept, or which of the three answers it gets.
template <class Bound>
shaftcull_answer answer_of(const CompiledShaft& shaft, const Bound& bound, bool inside) {
  if (inside) return static_cast<shaftcull_answer>(shaftcull::classify(shaft, bound));
  return shaftcull::keeps(shaft, bound) ? SHAFTCULL_OVERLAP : SHAFTCULL_OUTSIDE;
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_ask_box(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_box* box,
                                   uint32_t inside, shaftcull_answer* answer) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    shaftcull_answer& out = given(answer, "answer");
    out = answer_of(asked, as_box(box, "box"), as_bool(inside, "inside"));
  });
}

shaftcull_status shaftcull_ask_sphere(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_sphere* sphere,
                                      uint32_t inside, shaftcull_answer* answer) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    shaftcull_answer& out = given(answer, "answer");
    out = answer_of(asked, converted<shaftcull::Sphere>(given(sphere, "sphere")), as_bool(inside, "inside"));
  });
}

shaftcull_status shaftcull_ask_triangle(const shaftcull_shafts* shafts, uint64_t shaft,
                                        const shaftcull_triangle* triangle, shaftcull_triangle_test test,
                                        uint32_t* kept) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    uint32_t& out = given(kept, "kept");
    const auto one = converted<shaftcull::Triangle>(given(triangle, "triangle"));
    out = shaftcull::keeps(asked, one, as_triangle_test(test)) ? 1 : 0;
  });
}

shaftcull_status shaftcull_occluded_by_box(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_box* solid,
                                           uint32_t* occluded) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    uint32_t& out = given(occluded, "occluded");
    out = shaftcull::occluded(asked, as_box(solid, "solid")) ? 1 : 0;
  });
}

shaftcull_status shaftcull_occluded_by_polygon(const shaftcull_shafts* shafts, uint64_t shaft, const float* corners,
                                               uint64_t count, uint32_t* occluded) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    uint32_t& out = given(occluded, "occluded");
    out = shaftcull::occluded(asked, as_vectors(corners, count, "corners")) ? 1 : 0;
  });
}

}  // extern "C"
