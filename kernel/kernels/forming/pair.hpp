/// The slab constraints of one shaft: its six faces in the lanes of one vector.
///
/// The arithmetic of slab.hpp, operation by operation, so that a shaft formed alone has the bits of one formed in a
/// batch.
#pragma once

#include "kernels/forming/slab.hpp"
#include "simd/eight.hpp"
#include "simd/portable_eight.hpp"

namespace shaftcull::kernel {

template <class L>
struct EightOf {
  using Type = PortableEight<L>;
};
template <class L>
requires requires { typename L::Eight; }
struct EightOf<L> {
  using Type = typename L::Eight;
};

/// Compiles the shaft between boxes `a` and `b`; joining planes are left pending. Returns false, and leaves `out` as it
/// was, if a box is not finite with lo ≤ hi.
template <class L>
bool compile_pair(const Box& a, const Box& b, CompiledShaft& out) noexcept {
  using Eight = typename EightOf<L>::Type;
  using Vector = typename Eight::Vector;

  // The last two lanes repeat faces, which changes no minimum or maximum.
  const Vector p = Eight::load_faces(&a);
  const Vector other = Eight::load_faces(&b);
  const Vector slope = Eight::subtract(other, p);
  const Vector slope_0 = Eight::first_in_all(slope);
  const Vector scale = Eight::divide(slope_0, slope);  // 1 for the leading face
  const Vector shift = Eight::subtract(Eight::first_in_all(p), Eight::multiply(p, scale));
  const auto largest = Eight::largest_of_three(Eight::maximum(Eight::magnitude(p), Eight::magnitude(other)),
                                               Eight::magnitude(shift), Eight::minus_magnitude(slope));
  const float reach = largest.of[0];
  const float top_shift = largest.of[1];
  const float least_slope = -largest.of[2];

  if (!(Eight::is_ordered(p) && Eight::is_ordered(other) && reach <= __FLT_MAX__)) [[unlikely]]
    return false;
  Eight::store(&out.a, p);  // eight floats onto six and what follows them, which comes next
  Eight::store(&out.b, Eight::with_last_two(other, Eight::pair_in_all(batch_mark.of[0], batch_mark.of[1])));

  const float length = __builtin_fabsf(Eight::first(slope));
  const float from = __builtin_fabsf(Eight::first(p));
  const float to = __builtin_fabsf(Eight::first(other));
  const float position = (from > to ? from : to) + top_shift;
  const bool fused_suits =
      reach <= fused_regular_limit && 1 / fused_regular_limit <= least_slope && position <= length * fused_limit;
  const float margin = position * fused_margin_per_position + length * fused_margin_per_way;
  const SlabOrder& order = slab_orders.by_negative[Eight::signs(scale) & 0x3f];
  Eight::store(out.slab_scale,
               Eight::permuted(Eight::with_last_two(scale, Eight::pair_in_all(margin, reach)), order.face));
  Eight::store(out.slab_shift, Eight::permuted(shift, order.face));
  __builtin_memcpy(out.slab_near, order.near_stream, 8);
  if (!(fused_suits && reach <= largest_plain_reach)) [[unlikely]]
    rewrite_slab<L>(out, fused_suits);
  return true;
}

}  // namespace shaftcull::kernel
