/// One shaft against many bounds.
///
/// Answers are exact. For all finite floats, degenerate and huge ones included, and on every instruction set the same
/// bits: a box is outside, overlapping or inside as in real arithmetic for the floats given, and touching is not
/// outside; a corner is beyond an added plane by the real sign of n·p − d; a sphere is outside iff its centre is
/// farther than its radius from the shaft, and inside iff every face is at least that far away. A bound with a NaN is
/// never inside. Both forms agree, whatever floating-point mode the caller runs in. docs/exactness.md has the proof.
/// many.hpp, query.hpp and refine.hpp promise the same.
///
/// Floating-point modes and flags of the calling thread are as they were when a call returns: it rounds to nearest and
/// keeps denormals whatever the caller does, and raises no flag. Every call of the library takes at most 64 KiB of the
/// stack in an optimised build, so that small threads and fibers may make it.
#pragma once

#include <cstdint>
#include <span>

#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/streams.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Which form of the shaft decides *outside*. Answers are the same; speed is not.
enum class Form : std::uint8_t {
  fastest,  ///< slab, by measurement (see docs/measurements.md)
  slab,     ///< the shaft as a moving box
  planes,   ///< the paper's planes with near corners
};

/// Culls: sets bit i of `kept` (word i / 64, bit i % 64) iff bound i is *not* outside the shaft. Bits past
/// bounds.count in the last word are zero.
///
/// `kept` must have exactly words_for(bounds.count) words, else InvalidArgument; likewise if the shaft was never formed
/// or formed without the answer asked for, if a stream or span is null that is not empty, or if `form` is none of Form.
/// Nothing is written then. O(count); no allocation; safe to call from many threads.
void cull(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> kept, Form form = Form::fastest);
void cull(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> kept,
          Form form = Form::fastest);

/// Classifies: `kept` as in cull(), and bit i of `inside` set iff bound i is fully inside the shaft (and of
/// every added plane). The three answers are outside = not kept, inside, and overlap = kept and not inside.
/// Inside is always decided by planes. Sizes, errors and guarantees as cull(), for both spans, and InvalidArgument if
/// they share memory.
void classify(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> kept,
              std::span<std::uint64_t> inside, Form form = Form::fastest);
void classify(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> kept,
              std::span<std::uint64_t> inside, Form form = Form::fastest);

/// Sets bit i of `inside` as classify() does, without deciding which of the others are outside: the only question that
/// a shaft formed for inside alone answers. Sizes, errors and guarantees as cull().
void contain(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> inside);
void contain(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> inside);

/// The answer for a single bound.
enum class Answer : std::uint8_t { outside, overlap, inside };

[[nodiscard]] Answer classify(const CompiledShaft& shaft, const Box& box);
[[nodiscard]] Answer classify(const CompiledShaft& shaft, const Sphere& sphere);

}  // namespace shaftcull
