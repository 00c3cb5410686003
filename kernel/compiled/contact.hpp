// SPDX-License-Identifier: MIT
/// Open contact as a shaft has it, and the same shaft with closed contact.
#pragma once

#include "compiled/moving_faces.hpp"
#include "compiled/shaft_data.hpp"

namespace shaftcull::kernel {

/// Chooses the contact of a shaft that was formed.
inline void apply_contact(ShaftData& shaft, Contact contact) noexcept {
  shaft.contact = contact;
  if (shaft.is_hull()) {
    using enum ShaftData::SlabForm;
    shaft.slab_form = contact == Contact::open ? open_hull : hull;
    return;
  }
  shaft.still_faces = 0;
  if (contact == Contact::closed) return;
  const MovingFaces faces(shaft);
  for (unsigned f = 0; f < 6; ++f) {
    if (faces.is_purple(f)) shaft.still_faces = static_cast<std::uint8_t>(shaft.still_faces | 1U << f);
  }
}

/// A shaft with closed contact, or a copy of it that has. The nodes of a tree are always tested so: a flat bound in a
/// face of its node may meet a flat shaft that only touches the node.
class WithClosedContact {
 public:
  explicit WithClosedContact(const ShaftData& shaft) noexcept : shaft_(&shaft) {
    if (shaft.contact == Contact::closed) [[likely]]
      return;
    closed_ = shaft;
    apply_contact(closed_, Contact::closed);
    shaft_ = &closed_;
  }
  WithClosedContact(const WithClosedContact&) = delete;
  WithClosedContact& operator=(const WithClosedContact&) = delete;

  [[nodiscard]] const ShaftData& shaft() const noexcept { return *shaft_; }

 private:
  const ShaftData* shaft_;
  ShaftData closed_;  // written only if the shaft came with open contact
};

}  // namespace shaftcull::kernel
