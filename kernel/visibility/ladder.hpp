// SPDX-License-Identifier: MIT
/// The ladder: groups of patches are compared before the patches in them.
///
/// A product is two groups, with the occluders that may stand between some of their patches. Their children are
/// compared: each child of the one with all of the other, each child of the other with all of the one, and then each
/// two that are left. Each time first what faces away, then what a solid blocks, then what nothing reaches into. What
/// is left is a product of its own, or a pair that is undecided.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "exact/polygon_cone.hpp"
#include "exact/tangent_planes.hpp"
#include "kernels/kernel_table.hpp"
#include "shaftcull/function_ref.hpp"
#include "shaftcull/visibility.hpp"
#include "visibility/known_cones.hpp"
#include "visibility/occluders.hpp"
#include "visibility/own_faces.hpp"
#include "visibility/patch_tree.hpp"
#include "visibility/sight_job.hpp"

namespace shaftcull::kernel {

/// A walk through products, of one thread. Memory is kept from one to the next.
class Ladder {
 public:
  /// What is done with a product that is left to others; it may take its lists.
  using Leave = FunctionRef<void(PairBlockTask&&)>;
  /// What is done when there are answers enough; it may take and clear them, or end the walk by an exception.
  using Full = FunctionRef<void()>;
  /// Where answers go to. full() is called whenever they take `most_bytes` or more.
  struct To {
    SightAnswers& answers;
    std::size_t most_bytes;
    const Full& full;
  };

  explicit Ladder(const SightJob& job);
  Ladder(const Ladder&) = delete;
  Ladder& operator=(const Ladder&) = delete;
  ~Ladder();

  /// Answers all pairs of a product.
  void answer(const PairBlockTask& task, const To& to);
  /// Compares groups while a product has more than `most_pairs` pairs. Smaller ones that are not answered by then are
  /// passed to leave(), in order: all answers before one are written when it is passed. leave() may change
  /// `most_pairs`.
  void split(const PairBlockTask& task, const std::uint64_t& most_pairs, const Leave& leave, const To& to);

 private:
  struct Side;
  struct Level;
  struct Selection;
  /// An occluder, or a triangle of one.
  struct PointsOf {
    std::uint32_t number = 0;
    bool is_part = false;
    bool operator==(const PointsOf&) const = default;
  };
  /// A group of patches and points. Bit i of `lanes` says that all points lie on or behind the plane of patch i of the
  /// group, or behind it reversed.
  struct PointsBehind {
    const PatchTree* tree = nullptr;
    std::uint32_t first = 0;  ///< position of the first patch of the group
    PointsOf of;
    bool is_reversed = false;
    std::uint64_t lanes = 0;
  };
  /// Of a row of pairs: lanes in which one patch lies on one side of the plane of the other, which is seen from both.
  struct Faced {
    std::uint64_t front_of_row = 0;
    std::uint64_t back_of_row = 0;
    std::uint64_t front_of_column = 0;
    std::uint64_t back_of_column = 0;
  };

  /// Occluders with more points, which are not triangles, are not looked at in lanes.
  static constexpr std::size_t most_points_in_lanes = 64;

  Level& level(std::size_t depth);
  void enter(const PairBlockTask& task, const To& to);
  void descend(std::uint32_t a, std::uint32_t b, std::size_t depth);
  void walk(std::uint32_t a, std::uint32_t b, std::size_t depth);
  void leave_out_far(SightLists& lists, const Side& lanes, const Side& group);
  void leave_out_far(std::vector<std::uint32_t>& list, std::size_t all, const BoxClumps& clumps, std::uint64_t asked);
  std::uint64_t compare_with_group(Level& level, const Side& lanes, const Side& group, bool lanes_are_rows,
                                   std::uint64_t rows);
  [[nodiscard]] std::uint64_t facing_away(const Side& lanes, const Side& one, unsigned lane, std::uint64_t asked);
  [[nodiscard]] std::uint64_t in_one_plane(const Side& lanes, const Side& one, unsigned lane, std::uint64_t asked);
  [[nodiscard]] std::uint64_t on_or_behind_planes(const Side& lanes, const Side& one, unsigned lane,
                                                  std::uint64_t asked) const;
  std::uint64_t drop_behind(const Level& level, const Side& lanes, std::vector<std::uint64_t>& kept);
  std::uint64_t drop_behind_faced(const Level& level, const Side& lanes, const Side& group,
                                  std::vector<std::uint64_t>& kept);
  void drop_behind_faced(const Side& rows, unsigned row, const Side& columns, Selection& candidates);
  [[nodiscard]] std::uint64_t behind_faced(const Side& lanes, const PointsOf& of, std::span<const Vec3> points,
                                           std::uint64_t front, std::uint64_t back);
  [[nodiscard]] std::uint64_t behind_faced(const Side& rows, unsigned row, const Side& columns, const PointsOf& of,
                                           std::span<const Vec3> points, std::uint64_t asked);
  [[nodiscard]] std::uint64_t all_behind(const Side& lanes, const PointsOf& of, std::span<const Vec3> points,
                                         bool is_reversed);
  [[nodiscard]] std::span<const Vec3> points_or_corners(std::uint32_t occluder, PatchCorners& of_box) const noexcept;
  void go_into_itself(std::size_t depth, const Side& rows, unsigned row);
  void answer_row(std::size_t depth, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes);
  void answer_patches(Level& here, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes);
  void answer_boxes(Level& here, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes);
  void answer_corners(Level& here, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes);
  [[nodiscard]] std::uint64_t block(const Selection& solids, const Selection& polygons, std::uint64_t asked,
                                    bool are_boxes);
  [[nodiscard]] std::uint64_t occluded_by_solids(const std::uint32_t* solids, std::size_t count,
                                                 const std::uint64_t* may_block, std::uint64_t asked);
  [[nodiscard]] std::uint64_t occluded_by_hull(std::uint32_t hull, std::uint64_t may_block, std::uint64_t asked);
  [[nodiscard]] std::uint64_t occluded_by_hull(std::uint32_t hull, const Side& rows, unsigned row, const Side& columns,
                                               std::uint64_t asked);
  [[nodiscard]] std::uint64_t may_meet(const BoxRow& solid, std::span<const Vec3> fixed, const Side& columns,
                                       std::uint64_t asked) const;
  template <class Behind>
  [[nodiscard]] BehindCone behind_cone(EndPoints counting, std::uint64_t asked, const Behind& behind);
  [[nodiscard]] std::uint64_t corners_behind_cone(std::uint32_t solid, const Side& rows, unsigned row,
                                                  const Side& columns, std::uint64_t asked);
  [[nodiscard]] std::size_t hulls_in(const std::uint32_t* solids, std::size_t count) const noexcept;
  void select(const std::vector<std::uint32_t>& list, const std::vector<std::uint64_t>& of_rows,
              const std::vector<std::uint64_t>& of_columns, unsigned row, std::uint64_t lanes, bool packed,
              Selection& selection) const;
  [[nodiscard]] std::uint64_t block_corners(const Side& rows, unsigned row, const Side& columns, Selection& solids,
                                            Selection& polygons, std::uint64_t asked);
  [[nodiscard]] std::uint64_t keep_any_whole(Selection& candidates, std::uint64_t asked);
  [[nodiscard]] std::uint64_t part_reaches(const Side& rows, unsigned row, const Side& columns, std::size_t part,
                                           std::uint64_t asked);
  [[nodiscard]] std::uint64_t look_at_triangles(const Side& rows, unsigned row, const Side& columns,
                                                std::uint64_t lanes, Selection& candidates);
  [[nodiscard]] std::uint64_t look_at_all_triangles(const Side& rows, unsigned row, const Side& columns,
                                                    std::uint64_t lanes, Selection& candidates);
  [[nodiscard]] std::uint64_t drop_separate(const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes,
                                            Selection& candidates);
  [[nodiscard]] std::uint64_t reach_in_lanes(const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes,
                                             Selection& candidates);
  [[nodiscard]] bool reaches_between(unsigned lane, std::uint32_t occluder, std::size_t first, const PatchCorners& a,
                                     const PatchCorners& b);
  void write_undecided(const Level& here, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes);
  void form(const Side& fixed, unsigned lane, const Side& lanes, std::uint64_t asked);
  void form(const Side& fixed, unsigned lane, const float* const* boxes, const float* const* inward, unsigned count,
            std::uint64_t asked);
  void form_exchanged(const Side& fixed, unsigned lane, const Side& lanes, std::uint64_t asked);
  [[nodiscard]] std::uint64_t behind(const Side& lanes, std::uint32_t occluder, std::uint64_t asked);
  [[nodiscard]] std::uint64_t on_one_side_of(const BoxRow& around, std::uint64_t asked) const;
  [[nodiscard]] std::uint64_t occluded_by_polygons(const std::uint32_t* polygons, std::size_t count,
                                                   const std::uint64_t* may_block, std::uint64_t asked, bool are_boxes);
  template <class Behind>
  [[nodiscard]] BehindCone behind_polygon(std::uint32_t polygon, std::span<const Vec3> fixed, EndPoints counting,
                                          std::uint64_t asked, const Behind& behind);
  void decide_rows(const Side& rows, std::uint64_t which, const Side& columns, unsigned column, Sight sight);
  void decide(const Side& rows, unsigned row, const Side& columns, std::uint64_t which, Sight sight);
  [[nodiscard]] bool may_face_away() const noexcept;
  void write(const PatchRun& a, const PatchRun& b, Sight sight);
  void tell_if_full() const;

  const SightJob& job_;
  const To* to_ = nullptr;
  std::vector<std::unique_ptr<Level>> levels_;
  Siblings siblings_;
  PackedBoxes packed_;
  const float* packed_box_[6];
  const float* packed_inward_[6];
  float fixed_[6] = {};         // the box that all siblings_ begin at
  float fixed_inward_[6] = {};  // which of its faces are left out
  float exchanged_[6] = {};     // likewise of form_exchanged()
  TangentPlanes tangents_;
  KnownCones cones_;
  PolygonCone polygon_cone_;
  std::vector<ConePlane> polygon_planes_;
  ConeEnd fixed_end_;  // the box that all siblings_ begin at
  /// Of the parts of candidates at hand, one after the other: lanes that a part reaches into.
  std::vector<std::uint64_t> part_lanes_;
  std::vector<std::uint64_t> sure_lanes_;  ///< of candidates at hand: lanes that one certainly reaches into
  std::vector<std::size_t> parts_left_;    ///< triangles of an occluder at hand that may reach in
  OwnFacesCache own_faces_;
  Faced faced_;                                ///< of the row of patches at hand
  std::vector<PointsBetween> points_between_;  ///< of candidates at hand that lanes are asked about
  std::vector<PatchCorners> box_corners_;      ///< of those candidates that are boxes
  const std::unique_ptr<ReachSpace> reach_space_ = std::make_unique_for_overwrite<ReachSpace>();
  std::vector<PointsBehind> points_behind_;
  std::vector<std::uint64_t> clump_lanes_;  // of each clump, the lanes that come near it
  std::vector<std::uint64_t> near_;         // a bit an occluder, or a solid: whether one comes near its clump
  const Side* rows_ = nullptr;              // of the product at hand
  const std::uint64_t* most_pairs_ = nullptr;
  const Leave* leave_ = nullptr;
};

}  // namespace shaftcull::kernel
