// SPDX-License-Identifier: MIT
/// Scenes of surfaces cut into patches: what is asked which of them see each other.
///
/// Everything is made from a seed by additions, multiplications, divisions and square roots, one rounding each, so that
/// scenes are the same bits by every compiler.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::bench {

/// A piece of a surface: all corner + u · across + v · up with u and v in 0 … 1, of a triangle those with u + v ≤ 1.
struct Patch {
  Vec3 corner;
  Vec3 across;
  Vec3 up;
  bool triangle;
};

/// The eight corners of a box turned about the vertical: bit k of a corner's number says on which side of the box's own
/// axis k it is.
using TurnedBox = std::array<Vec3, 8>;

struct PatchScene {
  /// Object i is the triangles [objects[i], objects[i + 1]). First come `boxes`, one object each, then `turned`, then
  /// meshes of which nothing is known but their triangles.
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> objects{0};
  std::vector<Box> boxes;         ///< solid
  std::vector<TurnedBox> turned;  ///< solid

  std::vector<Patch> patches;
  std::vector<Box> patch_boxes;     ///< around each patch
  std::vector<Plane> patch_planes;  ///< of each patch: what it sees is in front, n · p > d, and its object is not
  std::vector<std::uint32_t> zone;  ///< the room of each patch, 0 where there are no rooms

  /// The first object that is neither of `boxes` nor of `turned`.
  [[nodiscard]] std::size_t first_mesh() const noexcept { return boxes.size() + turned.size(); }
};

/// How finely surfaces are cut: into pieces about so long, and each of these again into finer × finer.
struct PatchSize {
  float edge;
  unsigned finer = 1;

  /// Pieces of a side so long.
  [[nodiscard]] unsigned pieces(double length) const noexcept;
};

/// A direction in the plane: cosine and sine of an angle in 0 … 90 degrees, of which `share` in 0 … 1 is a measure.
struct Turn {
  explicit Turn(double share) noexcept;
  double cosine;
  double sine;
};

/// Collects objects and patches.
class PatchSceneMaker {
 public:
  explicit PatchSceneMaker(PatchSize size) : size_(size) {}

  /// A solid box without patches.
  void add_box(const Box& box);
  /// Patches on the face of a box, which may be a part of one that was added.
  void cut_face(const Box& box, std::size_t axis, bool high, std::uint32_t zone);
  void add_turned(const TurnedBox& box);
  /// Patches on the face of a turned box whose own axis x has this direction.
  void cut_face(const TurnedBox& box, const Turn& turn, std::size_t axis, bool high, std::uint32_t zone);
  /// A sphere of 20 × meshed² triangles. Its patches are the triangles of a coarser one around it.
  void add_sphere(const Vec3& centre, float radius, unsigned meshed, std::uint32_t zone);

  [[nodiscard]] PatchScene take();

 private:
  struct Quad {
    Vec3 from;
    Vec3 across;  ///< the corner next to `from` on the one side
    Vec3 up;      ///< and on the other
  };
  void cut(const Quad& quad, const Vec3& normal, std::span<const Vec3> behind, std::uint32_t zone);
  void add_patch(const std::array<Vec3, 3>& corners, const Vec3& fourth, bool triangle, const Plane& plane,
                 std::uint32_t zone);

  PatchSize size_;
  PatchScene scene_;
  std::vector<Triangle> of_boxes_;  // a dozen each
  std::vector<Triangle> of_turned_;
  std::vector<Triangle> of_meshes_;
  std::vector<std::uint32_t> mesh_ends_;
};

/// The corners of a box, as those of a turned one.
[[nodiscard]] TurnedBox corners_of(const Box& box);

/// The corners of a box of these half sizes whose middle is `at` in the plane, from `bottom` to `top`.
[[nodiscard]] TurnedBox turned_box(const std::array<double, 2>& at, const std::array<double, 2>& half, double bottom,
                                   double top, const Turn& turn);

}  // namespace shaftcull::bench
