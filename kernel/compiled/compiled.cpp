// SPDX-License-Identifier: MIT
#include "shaftcull/compiled.hpp"

#include <limits>

#include "compiled/joining_planes.hpp"
#include "compiled/shaft_data.hpp"

namespace shaftcull {
namespace {

/// The box with faces `face` of a shaft, which has them if it was formed.
Box box_of(const kernel::ShaftData& shaft, const float (&face)[6]) noexcept {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if (!shaft.is_formed()) return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  return {{face[0], face[1], face[2]}, {face[3], face[4], face[5]}};
}

}  // namespace

bool CompiledShaft::formed() const noexcept { return kernel::data_of(*this).is_formed(); }

bool CompiledShaft::has_planes() const noexcept {
  const kernel::ShaftData& data = kernel::data_of(*this);
  return data.is_formed() && data.has_planes();
}

Contact CompiledShaft::contact() const noexcept {
  const kernel::ShaftData& data = kernel::data_of(*this);
  return data.is_formed() ? data.contact : Contact::closed;
}

Form CompiledShaft::form() const noexcept {
  const kernel::ShaftData& data = kernel::data_of(*this);
  return data.is_formed() ? data.form : Form::slab;
}

Box CompiledShaft::a() const noexcept {
  const kernel::ShaftData& data = kernel::data_of(*this);
  return box_of(data, data.a);
}

Box CompiledShaft::b() const noexcept {
  const kernel::ShaftData& data = kernel::data_of(*this);
  return box_of(data, data.b);
}

void complete(CompiledShaft& shaft) noexcept {
  kernel::ShaftData& data = kernel::data_of(shaft);
  if (data.is_formed() && !data.has_planes()) kernel::add_joining_planes(data);
}

}  // namespace shaftcull
