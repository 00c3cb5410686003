/// Exact answers for single bounds: what the kernels ask about the lanes that their float arithmetic cannot decide.
///
/// Every predicate starts again from the floats that the user gave, the boxes a and b of the shaft, never from
/// compiled coefficients, and returns the answer of real arithmetic. Coordinates of the bound that are infinite or
/// NaN put no constraint on it unless they are beyond a face of the shaft box.
#pragma once

#include "shaftcull/compiled.hpp"

namespace shaftcull::kernel {

/// Which pairs of faces can separate a box from the shaft. They agree on every box with lo ≤ hi.
enum class FacePairs : unsigned char {
  neighbours,  ///< faces that share an edge: the joining planes
  all,         ///< also opposite faces, as the slab form's largest lower and smallest upper bound on t do
};

/// Whether the box with the corners of `bound` (order of a BoxView's streams) is outside the shaft or any added plane.
[[nodiscard]] bool box_outside(const CompiledShaft& shaft, const float (&bound)[6], FacePairs pairs) noexcept;

/// Whether that box is inside the shaft and all added planes.
[[nodiscard]] bool box_inside(const CompiledShaft& shaft, const float (&bound)[6]) noexcept;

/// Whether the sphere (centre x, y, z, radius) is outside the shaft or any added plane: farther than its radius.
[[nodiscard]] bool sphere_outside(const CompiledShaft& shaft, const float (&sphere)[4]) noexcept;

/// Whether the sphere is inside the shaft and all added planes: every face at least its radius away.
[[nodiscard]] bool sphere_inside(const CompiledShaft& shaft, const float (&sphere)[4]) noexcept;

}  // namespace shaftcull::kernel
