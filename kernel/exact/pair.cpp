// SPDX-License-Identifier: MIT
#include "exact/pair.hpp"

#include "exact/predicates.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {
namespace {

/// What exact predicates read of a shaft: the rest is not written.
void describe_pair(const float (&a)[6], const float (&b)[6], Contact contact, ShaftData& shaft) noexcept {
  for (unsigned f = 0; f != 6; ++f) {
    shaft.a[f] = a[f];
    shaft.b[f] = b[f];
  }
  shaft.slab_form = ShaftData::SlabForm::exact;
  shaft.kind = ShaftData::Kind::between;
  shaft.contact = contact;
  shaft.added_count = 0;
}

}  // namespace

bool is_outside_between(const float (&a)[6], const float (&b)[6], Contact contact, const float (&bound)[6]) noexcept {
  ShaftData shaft;
  describe_pair(a, b, contact, shaft);
  return box_outside(shaft, bound);
}

}  // namespace shaftcull::kernel
