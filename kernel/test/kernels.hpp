/// The dispatch table: what every instruction set's translation unit provides.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/isa.hpp"

namespace shaftcull::kernel {

/// Tests `count` bounds, any count, in separate streams (6 for boxes, 4 for spheres). Writes words_for(count)
/// words of kept bits and as many of inside bits, each unless it is null; bits past count are zero.
/// The shaft must answer what is asked; pending planes are completed on the fly.
using Test = void(const CompiledShaft& shaft, const float* const* stream, std::size_t count, std::uint64_t* kept,
                  std::uint64_t* inside) noexcept;

/// Writes the boxes around `count` spheres, a multiple of 64, into six streams: what many shafts' tests would each make anew.
using BoxSpheres = void(const float* const* sphere, std::size_t count, float* const* box) noexcept;

/// Forms the shafts of `count` pairs of boxes. Returns false, and writes nothing, if any box is not finite with lo ≤ hi.
using CompileBatch = bool(const float* const* a, const float* const* b, std::size_t count, CompiledShaft* out) noexcept;

struct Kernels {
  Test* boxes_slab;
  Test* boxes_planes;
  Test* spheres_slab;
  Test* spheres_planes;
  Test* boxed_spheres_slab;  ///< as spheres_slab, with the six streams of box_spheres() after the spheres' four
  BoxSpheres* box_spheres;
  CompileBatch* compile_batch;

  [[nodiscard]] Test* test(const BoxView& /*boxes*/, Form form) const noexcept {
    return form == Form::planes ? boxes_planes : boxes_slab;
  }
  [[nodiscard]] Test* test(const SphereView& /*spheres*/, Form form) const noexcept {
    return form == Form::planes ? spheres_planes : spheres_slab;
  }
};

/// The kernels of active_isa(); throws as it does.
[[nodiscard]] const Kernels& active_kernels();

/// Throws InvalidArgument unless the shaft was formed to answer `outside` and `inside`, where asked, for spheres or boxes.
/// `position` is the shaft's index among many, named in the message.
void require_answers(const CompiledShaft& shaft, bool outside, bool inside, bool spheres, std::size_t position);

}  // namespace shaftcull::kernel
