/// What the bytes of a fuzzer's input mean: a shaft and bounds, with coordinates that may be any bits at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/shaft.hpp"

namespace shaftcull::fuzz {

/// One input, read. Everything is legal input to read(): short inputs are padded with zeros.
///
/// | bytes   | meaning |
/// |---------|---------|
/// | 0       | formation (% 4), order (/ 4 % 4), bits 4: not outside, 5: not inside, 6: no spheres, 7: open contact |
/// | 1       | planes added (% 4); bit 2: sort corners of all boxes; bit 3: bounds derived from the shaft; bit 4: fill
/// a word | | 2 … 49  | the shaft's two boxes: lo x y z, hi x y z of a, then of b; little-endian floats | | then    |
/// 16 bytes for each added plane: normal x y z, offset | | the rest| bounds, six coordinates each: floats, or if
/// derived a byte each |
///
/// A derived coordinate is a coordinate of the shaft moved by some ulps: it is what makes bounds touch. The bounds are
/// read as boxes, and the same coordinates four by four as spheres.
struct Case {
  ShaftOptions options;
  Box a{};
  Box b{};
  std::vector<Plane> planes;
  std::vector<Box> boxes;
  std::vector<Sphere> spheres;

  /// Most boxes, before a word is filled up with boxes far away. The same coordinates make half as many spheres again.
  static constexpr std::size_t most_boxes = 8;

  static Case read(std::span<const std::uint8_t> bytes);
};

/// A bit of byte 0, to write inputs with.
inline constexpr std::uint8_t open_contact = 128;

/// Bits of byte 1, likewise.
inline constexpr std::uint8_t sort_corners = 4;
inline constexpr std::uint8_t derive_bounds = 8;
inline constexpr std::uint8_t fill_word = 16;

}  // namespace shaftcull::fuzz
