// SPDX-License-Identifier: MIT
/// What the bytes of a fuzzer's input mean: a shaft and bounds, with coordinates that may be any bits at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "oracle/convex_hull.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/shaft_input.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/paper.hpp"

namespace shaftcull::fuzz {

/// One input, read. Everything is legal input to read(): short inputs are padded with zeros.
///
/// | bytes   | meaning |
/// |---------|---------|
/// | 0       | formation (% 4), order (/ 4 % 4), bit 6: the library makes the groups, 7: open contact |
/// | 1       | planes added (% 4); bit 2: sort corners of all boxes; bit 3: bounds derived from the shaft |
/// |         | bit 4: fill a word; bits 5 … 7: what the shaft is made of, a Subject; 7 is as 0 |
/// | 2 … 49  | two boxes: lo x y z, hi x y z of a, then of b; little-endian floats |
/// | then    | 4 bytes, the reach of a shadow that ends; nothing for others |
/// | then    | 16 bytes for each added plane: normal x y z, offset |
/// | the rest| bounds, six coordinates each: floats, or if derived a byte each |
///
/// A body or an occluder is a; b.lo is the displacement, b the light. Points of a hull are the corners lo and hi of a
/// and b and the planes' normals; of one without end b.hi and the normals are directions. Of these, byte 0 has a
/// meaning for contact only. Groups are those of triangles, where all is the input of a visibility query.
///
/// A derived coordinate is a coordinate of the shaft moved by some ulps: it is what makes bounds touch. The bounds are
/// read as boxes, and the same coordinates four by four as spheres.
struct Case {
  enum class Subject : std::uint8_t {
    between_boxes,
    swept,
    swept_infinite,
    shadow,
    shadow_without_end,
    hull,
    hull_without_end,
  };
  /// What the shaft is made of, as the oracles take it.
  using Input = std::variant<ShaftInput, MovingInput, HullInput>;

  Subject subject = Subject::between_boxes;
  ShaftOptions options;
  Contact contact = Contact::closed;
  bool has_groups = true;
  Box a{};
  Box b{};
  float reach = 1;
  std::vector<Plane> planes;
  std::vector<Box> boxes;
  std::vector<Sphere> spheres;

  /// Most boxes, before a word is filled up with boxes far away. The same coordinates make half as many spheres again.
  static constexpr std::size_t most_boxes = 8;

  static Case read(std::span<const std::uint8_t> bytes);

  [[nodiscard]] bool is_moving() const { return subject != Subject::between_boxes && subject < Subject::hull; }
  [[nodiscard]] bool is_hull() const { return subject >= Subject::hull; }
  /// With those planes that may be added.
  [[nodiscard]] Input input() const;
  /// All of it as C++ source text.
  [[nodiscard]] std::string text() const;

 private:
  [[nodiscard]] Input input(const std::vector<Plane>& added) const;
};

/// Whether it may be added to a shaft.
[[nodiscard]] bool is_addable(const Plane& plane);

/// A bit of byte 0, to write inputs with.
inline constexpr std::uint8_t open_contact = 128;

/// Bits of byte 1, likewise.
inline constexpr std::uint8_t sort_corners = 4;
inline constexpr std::uint8_t derive_bounds = 8;
inline constexpr std::uint8_t fill_word = 16;
inline constexpr unsigned subject_shift = 5;

}  // namespace shaftcull::fuzz
