// SPDX-License-Identifier: MIT
#include "tree/tree_query.hpp"

#include "tree/first_contact_walk.hpp"

namespace shaftcull::kernel {
template <class Bound>
void BoundsQuery<Bound>::walk_leaves(std::size_t s, LeafVisitor& visitor, const VisitorTraits& traits) const {
  in_float_environment(
      [&] { Walk<Bound>(parts_, kernels(), shaft(s), question(), exclusion(s), visitor, traits).run(); });
}

template <class Bound>
FirstContact BoundsQuery<Bound>::first_contact(std::size_t s) const noexcept {
  return in_float_environment([&] {
    const bool skips = options().skip_overlapping();
    return FirstContactWalk<Bound>(parts_, kernels(), shaft(s), exclusion(s), skips).run().contact();
  });
}

template class BoundsQuery<Box>;
template class BoundsQuery<Sphere>;

}  // namespace shaftcull::kernel
