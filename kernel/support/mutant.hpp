// SPDX-License-Identifier: MIT
/// Faults that mutation tests (tests/mutation/) put into the kernels, to see that other tests notice.
#pragma once

namespace shaftcull::kernel {

#ifdef SHAFTCULL_MUTANT
// Defined by the mutation tests alone: a library that is built like this by accident does not link.
extern bool drops_exact_step;          // undecided lanes are answered "no": not outside, not inside
extern bool keeps_touching_faces;      // with open contact too, boxes are kept that touch a face that is only compared
extern float accept_margin_factor;     // on the margin of spheres that are accepted without the exact predicate
extern float bound_margin_factor;      // on the margin of spheres that are culled without the exact predicate
extern float radius_margin_factor;     // on what a sphere's radius adds to the margin of joining planes
extern float grid_slack_factor;        // on what snapping and rounding on a grid may be off by
extern float grid_limit_factor;        // on the interval length above which a bound on a grid is certainly not outside
extern float blocking_margin_factor;   // on the margin of boxes that block a shaft
extern float sibling_margin_factor;    // on the margin of sibling shafts
extern bool drops_touching_flats;      // groups, too, do not keep flat bounds that touch with open contact
extern float triangle_margin_factor;   // on the margin of separating axes of triangles
extern float measured_error_factor;    // on the rounding errors that exact predicates measure
extern float hull_margin_factor;       // on the margin of planes of a convex hull with an end
extern float open_hull_margin_factor;  // likewise of one without
extern float hull_radius_factor;       // on what a radius is off by, in tests of spheres against hulls
extern float entry_margin_factor;      // on what two entry times in doubles may be off by
#else
inline constexpr bool drops_exact_step = false;
inline constexpr bool keeps_touching_faces = false;
inline constexpr float accept_margin_factor = 1.0F;
inline constexpr float bound_margin_factor = 1.0F;
inline constexpr float radius_margin_factor = 1.0F;
inline constexpr float grid_slack_factor = 1.0F;
inline constexpr float grid_limit_factor = 1.0F;
inline constexpr float blocking_margin_factor = 1.0F;
inline constexpr float sibling_margin_factor = 1.0F;
inline constexpr bool drops_touching_flats = false;
inline constexpr float triangle_margin_factor = 1.0F;
inline constexpr float measured_error_factor = 1.0F;
inline constexpr float hull_margin_factor = 1.0F;
inline constexpr float open_hull_margin_factor = 1.0F;
inline constexpr float hull_radius_factor = 1.0F;
inline constexpr float entry_margin_factor = 1.0F;
#endif

}  // namespace shaftcull::kernel
