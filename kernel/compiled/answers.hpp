/// Whether a shaft answers what it is asked.
#pragma once

#include <cstddef>

#include "compiled/shaft_data.hpp"

namespace shaftcull::kernel {

[[noreturn]] void refuse_shaft(const ShaftData& shaft, bool outside, bool inside, std::size_t position);

/// Throws InvalidArgument unless the shaft was formed to answer `outside` and `inside`, where asked, for spheres or
/// boxes. `position` is the shaft's index among many, for the message.
inline void require_answers(const ShaftData& shaft, bool outside, bool inside, bool spheres, std::size_t position) {
  if ((outside && !shaft.answers_outside) || (inside && !shaft.answers_inside) || (spheres && !shaft.answers_spheres))
      [[unlikely]] {
    refuse_shaft(shaft, outside, inside, position);
  }
}

}  // namespace shaftcull::kernel
