// SPDX-License-Identifier: MIT
/// A shaft with its joining planes, where they are needed.
#pragma once

#include "compiled/joining_planes.hpp"
#include "compiled/shaft_data.hpp"
#include "shaftcull/cull.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

// Inlined wherever they are called: a unit of an instruction set must not leave a copy that the linker may keep.

/// Whether a test for outside reads the joining planes of a shaft: in plane form, and for spheres unless the slab form
/// is the fused or the endless one.
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline bool outside_needs_planes(const ShaftData& shaft, bool spheres) noexcept {
  return shaft.form == Form::planes ||
         (spheres && shaft.slab_form != ShaftData::SlabForm::fused && shaft.slab_form != ShaftData::SlabForm::endless);
}

/// A shaft, or a copy of it with its planes if they are needed and pending.
class WithPlanes {
 public:
  SHAFTCULL_ALWAYS_INLINE WithPlanes(const ShaftData& shaft, bool needs_planes) noexcept : shaft_(&shaft) {
    if (!needs_planes || shaft.has_planes()) return;
    completed_ = shaft;
    add_joining_planes(completed_);
    shaft_ = &completed_;
  }
  WithPlanes(const WithPlanes&) = delete;
  WithPlanes& operator=(const WithPlanes&) = delete;

  SHAFTCULL_ALWAYS_INLINE [[nodiscard]] const ShaftData& shaft() const noexcept { return *shaft_; }

 private:
  const ShaftData* shaft_;
  ShaftData completed_;  // written only if the shaft came without planes that are needed
};

}  // namespace shaftcull::kernel
