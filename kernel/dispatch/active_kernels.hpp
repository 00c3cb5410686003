// SPDX-License-Identifier: MIT
/// The kernels that calls run: those of the instruction set that is selected.
#pragma once

#include "kernels/kernel_table.hpp"

namespace shaftcull::kernel {

/// The kernels of active_isa(). A call asks once, so that it goes on with the set that it began with.
[[nodiscard]] const Kernels& active_kernels() noexcept;

}  // namespace shaftcull::kernel
