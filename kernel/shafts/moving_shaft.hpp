// SPDX-License-Identifier: MIT
/// Forms the shaft of a moving box slowly. kernels/forming/moving_box.hpp forms nearly all of them. Shafts with an end
/// have the same bits from either. Those without end have the endless slab form only from there.
#pragma once

#include <cstring>

#include "compiled/shaft_data.hpp"
#include "kernels/kernel_table.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// Eight lanes, one for each face; the last two are of no face. Loops over all of them become vectors.
using Lanes8 = float[8];

/// What moves, as ShaftData has it.
struct Movement {
  ShaftData::Kind kind;
  Lanes8 start = {};
  Lanes8 motion = {};
  float reach = 1;

  Movement(ShaftData::Kind of, const Box& from, const Vec3& first, const Vec3& second) noexcept : kind(of) {
    std::memcpy(start, &from, sizeof from);
    std::memcpy(motion, &first, sizeof first);
    std::memcpy(motion + 3, &second, sizeof second);
  }
};

/// Writes a shaft, without planes. What moves is finite, a direction is not 0, and a light is apart from its occluder.
/// A shaft without end must be one that the kernel refuses: it has no endless slab form.
void form(const Kernels& kernels, const Movement& movement, ShaftData& shaft) noexcept;

}  // namespace shaftcull::kernel
