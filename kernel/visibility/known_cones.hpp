// SPDX-License-Identifier: MIT
/// Cones behind solids, as seen from patches and groups. The same ones are asked for again and again, so their planes
/// are kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/hull_cone.hpp"
#include "kernels/siblings/siblings.hpp"
#include "visibility/sight_job.hpp"

namespace shaftcull::kernel {

/// An end of segments: the corners of a patch, or the box around a patch or around a group.
struct ConeEnd {
  enum class Kind : unsigned char { patch, box_of_patch, box_of_group };

  const PatchTree* tree = nullptr;
  std::uint32_t at = 0;  ///< position of the patch or group
  Kind kind = Kind::patch;
  EndPoints counting = EndPoints::all;

  friend bool operator==(const ConeEnd&, const ConeEnd&) = default;
};

/// Cones of one job, for one thread.
class KnownCones {
 public:
  explicit KnownCones(const SightJob& job) noexcept : job_(job) {}

  /// Turns to what a solid of the job hides from an end with these points, which stay the caller's for the calls below.
  /// The solid has an interior.
  void turn_to(const ConeEnd& end, std::span<const Vec3> points, std::uint32_t solid);

  /// The planes of that cone: of the solid's faces, and through its edges. They are valid until the next call.
  [[nodiscard]] std::span<const ConePlane> faces();
  [[nodiscard]] std::span<const ConePlane> edges();
  /// Whether the solid hides this end from another one, exactly.
  [[nodiscard]] bool hides(std::span<const Vec3> other);

 private:
  static constexpr std::size_t most_cones = std::size_t{1} << 12;
  static constexpr std::size_t most_planes = std::size_t{1} << 15;

  /// Planes side by side. They are not formed yet if `first` is `none`.
  struct Planes {
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    std::uint32_t first = none;
    std::uint32_t count = 0;
  };
  struct Known {
    ConeEnd end;
    std::uint32_t solid = 0;
    Planes faces;
    Planes edges;
  };

  void form_faces();
  void form_edges();
  [[nodiscard]] Planes kept(std::size_t first_plane);
  [[nodiscard]] std::span<const ConePlane> planes(const Planes& of) const noexcept {
    return std::span(planes_).subspan(of.first, of.count);
  }

  const SightJob& job_;
  std::vector<Known> known_;
  std::vector<ConePlane> planes_;
  Known* here_ = nullptr;
  std::span<const Vec3> points_;
  HullCone cone_;  ///< of here_, as far as it is formed
  enum class Formed : unsigned char { nothing, faces, all } formed_ = Formed::nothing;
  HullMesh box_mesh_;
};

}  // namespace shaftcull::kernel
