// SPDX-License-Identifier: MIT
/// Visibility: which pairs of patches see each other for certain, which cannot, and which need a closer look.
///
/// A *patch* is a convex polygon, given by its corners, such as a facet of a wall; or a box, such as a point or a cell
/// of a receiving volume. A polygon faces one side of its plane, or both sides (PatchSides). A polygon that faces both
/// sides faces any patch that lies on one side of its plane, or of all its planes, up to the tolerance; for a patch
/// that reaches to both sides, it counts as having no plane. A box may have a plane. *Occluders* stand between patches.
///
/// Each pair of patches gets one of four answers. In their definitions, the box of a polygon is the box around it:
///
/// * `facing_away`: all corners of one patch lie on or behind the plane of the other patch, or in that plane if the
///   other patch is seen from both sides.
/// * `occluded`: one solid hides each patch from the other. Every segment between the relative interiors of the patches
///   passes through the interior of the solid. So a wall that ends flush with floor and ceiling hides the patches
///   behind it. Segments that only touch a solid, at the rim of both patches, have measure zero: no light passes along
///   them (occluded.hpp).
/// * `clear`: no occluder reaches into the shaft between the two boxes, in front of both planes.
/// * `undecided`: none of these three. The *candidates* are the occluders that reach into the shaft: rays need to test
///   no others.
///
/// A *solid* is a solid box, a solid hull, or a larger box that several boxes form together, as merged_boxes() finds it
/// (solids.hpp). The boxes that inscribed_box() finds inside solid hulls (solids.hpp) are among the boxes that form
/// larger ones. A hull that has all corners of the box around it counts as that solid box. Other hulls without an
/// interior hide nothing. A polygon has no interior, but can hide patches: it hides two patches if every segment
/// between their relative interiors passes from one side of its plane to the other, within its edges.
///
/// A patch of a turned wall, whose corners are rounded, may lie a little behind the wall. So a polygon hides no patch
/// that lies in its plane, up to VisibilityOptions::tolerance. A hull hides two patches only if, for each of its faces,
/// one of the two patches lies exactly on or behind the plane of the face, and a corner of that patch is behind it by
/// more than the tolerance.
///
/// Answers are exact for the floats given: these definitions alone determine the undecided pairs and their candidates.
/// A pair that faces away or is occluded is never reported as `clear`. A pair that both faces away and is occluded gets
/// either answer, the same on every instruction set and for any number of threads. It may get the other of these two
/// answers if the two sets are exchanged.
///
/// An occluder reaches into the shaft if cull() keeps the box around it, by default with open contact
/// (VisibilityOptions::contact), and if, with either contact, neither plane has all corners of the occluder on it or
/// behind it. The corners of a box, solid or not, are its eight corners. The corners of a hull or a polygon are the
/// given points, not the corners of the box around it. The corners of triangles are their vertices. A group of
/// neighbouring triangles is one occluder: it lies behind a plane if all vertices of the group do. A patch with corners
/// that are slightly out of plane has several planes; an object lies behind the patch if it lies behind all of them.
/// "Behind" is up to VisibilityOptions::tolerance.
///
/// If a patch of the pair is not identical to the box around it, the shaft between the patches is narrower than the
/// shaft between their boxes. Then an occluder also does not reach into the shaft if all its corners lie on or behind
/// some plane (with closed contact: behind it) with these two properties: it goes through an edge of one patch and a
/// corner of the other; and of the corners of the two patches, none is behind it and one is in front. This test
/// distinguishes a turned wall from the box around it.
///
/// For a group of at most 64 triangles, one of its triangles must reach into the shaft by itself, too. This is so if
/// the box around the triangle reaches into the shaft and the triangle is in front of both planes. If one patch is not
/// identical to the box around it, there are two more conditions. The triangle must not lie wholly behind a plane of
/// the last paragraph. And the two patches must not lie on one side of the triangle's own plane up to the tolerance
/// (with closed contact: strictly), unless both lie wholly in that plane. So a closed room that is one object hides
/// nothing inside it.
///
/// Patches are stored in a tree, and groups of patches are compared first: an answer for two groups holds for all pairs
/// in them. So time grows with the number of undecided pairs, and memory stays below a limit for any number of pairs.
/// Shafts between groups are due to E. Haines and J. Wallace, "Shaft Culling for Efficient Ray-Traced Radiosity", 1991.
///
/// Calls run in parallel on oneTBB, in the caller's task_arena. Callbacks run one at a time, except
/// `VisibilityOptions::resolve`. The order of answers depends neither on the number of threads nor on
/// `VisibilityOptions::memory`; the boundaries between batches may depend on both. Floating-point modes and flags:
/// cull.hpp. Const members are safe to call from many threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/function_ref.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/triangles.hpp"

// Types of the library that are not part of the interface.
namespace shaftcull::kernel {
class PatchTree;
struct OccluderData;
}  // namespace shaftcull::kernel

namespace SHAFTCULL_INTERFACE shaftcull {

/// The answer for a pair of patches.
enum class Sight : std::uint8_t {
  undecided,    ///< none of the others: occluders reach between the patches
  clear,        ///< no occluder reaches between the patches
  occluded,     ///< one solid hides each patch from the other
  facing_away,  ///< one patch is on or behind the plane of the other, or in it, within the tolerance
};

/// Returns the name, as in files and in Python: "undecided", "clear", "occluded", "facing_away".
[[nodiscard]] SHAFTCULL_EXPORT std::string_view name(Sight sight) noexcept;

/// The sides from which a patch with corners is seen.
enum class PatchSides : std::uint8_t {
  front,  ///< from the side from which its corners run counter-clockwise
  both,   ///< from both sides; two patches in one plane are facing_away, within the tolerance
};

/// A set of patches, in a tree. A set holds copies of the boxes and planes; copies of the set share them. The first
/// visibility call with a set that has planes adds about 9 bytes per patch, or 30 if patches are seen from both sides.
/// The set keeps this memory. Calls in succession with the same tolerance, and the same largest coordinate of sets and
/// occluders, use it again. A set that was moved from has no patches.
class SHAFTCULL_EXPORT PatchSet {
 public:
  /// An empty set.
  PatchSet() noexcept = default;
  /// Builds a set of one patch per box. `planes` is empty, or has one plane per box. A patch faces where the normal of
  /// its plane points, and sees points in front of the plane: normal·p > offset. Throws InvalidArgument for any other
  /// number of planes, and for 2³² − 1 patches or more. Throws BadBound, with the position, for a box that is not
  /// finite or has lo > hi, and for a plane that is not finite or has a zero normal. O(n log n); allocates about 100
  /// bytes per patch.
  explicit PatchSet(const BoxView& boxes, std::span<const Plane> planes = {});
  explicit PatchSet(std::span<const Box> boxes, std::span<const Plane> planes = {});
  /// Builds a set of convex polygons, by their corners. Patch i has corners[first_corner[i] … first_corner[i + 1]),
  /// 3 to 8 of them, in order around it. It faces the side from which they run counter-clockwise, or both sides. A
  /// patch whose corners are slightly out of plane has the planes of the triangles that its first corner forms with its
  /// other edges; a patch without area has no plane. Convexity is not checked. Throws BadBound, with the position, for
  /// a corner that is not finite, and InvalidArgument for another number of corners, for positions that do not ascend
  /// from 0 to corners.size(), for 2³² − 1 patches or more, and if `sides` is not an enumerator. O(n log n); allocates
  /// about 150 bytes per patch of 4 corners, and 100 if every patch is the box around it and seen from one side.
  explicit PatchSet(std::span<const Vec3> corners, std::span<const std::size_t> first_corner,
                    PatchSides sides = PatchSides::front);

  /// The number of patches.
  [[nodiscard]] std::size_t size() const noexcept;
  /// Whether the patches have planes.
  [[nodiscard]] bool has_planes() const noexcept;
  /// The patches in tree order: a permutation of 0 … size() − 1. A PatchRun is a part of it.
  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept;
  /// The box around all patches; the empty box if there are none. O(1).
  [[nodiscard]] Box box() const noexcept;

  /// For the library itself: the type is not part of the interface.
  [[nodiscard]] const kernel::PatchTree& tree() const noexcept;

 private:
  explicit PatchSet(std::shared_ptr<const kernel::PatchTree> tree) noexcept : tree_(std::move(tree)) {}

  std::shared_ptr<const kernel::PatchTree> tree_;  ///< null: no patches
};

/// The occluders between patches, numbered from 0 in the order in which they are added. Each box, hull, polygon or
/// group of triangles is one occluder. A value: copies are deep, and an object that was moved from has no occluders.
///
/// Members that add occluders return the number of the first occluder added. They throw BadBound, with the position,
/// for a value that is not finite or a box with lo > hi, and InvalidArgument for a broken rule of the member. A call
/// that throws, std::bad_alloc included, adds nothing. Time and memory are proportional to the addition, amortised:
/// adding one occluder at a time costs no more. Memory is about 50 bytes per occluder, 24 more per solid, 12 per corner
/// of a hull, a polygon or a group, and 72 per triangle.
///
/// Larger boxes that solids form together are found by the first visibility call after solids were added. That takes
/// about O(n log n) for all solids, on one thread, and 32 bytes per box found. Later copies share these boxes.
class SHAFTCULL_EXPORT Occluders {
 public:
  Occluders();
  Occluders(const Occluders& other);
  Occluders(Occluders&& other) noexcept;
  Occluders& operator=(Occluders other) noexcept;
  ~Occluders();

  /// Adds boxes around things that may hide something. These boxes make no pair `occluded`.
  std::size_t add_boxes(const BoxView& boxes);
  std::size_t add_boxes(std::span<const Box> boxes);
  /// Adds solid boxes: walls, cores of buildings. Solids make pairs `occluded`, also if several of them form one larger
  /// box together (merged_boxes()).
  std::size_t add_solids(const BoxView& boxes);
  std::size_t add_solids(std::span<const Box> boxes);
  /// Adds solid convex hulls: a turned cupboard or building. `corners` holds the corners of all hulls, hull after hull.
  /// Hull i has corners[first_corner[i] … first_corner[i + 1]), 4 or more of them; these may include points that are
  /// not corners of the hull. The call finds the faces of the hull, and a box inside it by inscribed_box(); for more
  /// than 32 points, inside the hull of 32 of them. O(n²) for a hull of n points. Takes up to 250 more bytes per
  /// corner.
  std::size_t add_solid_hulls(std::span<const Vec3> corners, std::span<const std::size_t> first_corner);
  /// Adds flat convex polygons, by their corners in order: walls without thickness. Polygons make pairs `occluded`.
  /// Arguments are as for hulls, with 3 corners or more per polygon. Polygons are treated as in occluded(shaft,
  /// polygon) (occluded.hpp): if the corners are slightly out of plane, the polygon is the triangles that its first
  /// corner forms with its other edges. Convexity is not checked.
  std::size_t add_polygons(std::span<const Vec3> corners, std::span<const std::size_t> first_corner);
  /// Adds triangles, in groups. Group i has triangles [first_triangle[i] … first_triangle[i + 1]): whole objects are
  /// good groups. If `first_triangle` is empty, the library forms groups of at most 32 triangles that are near each
  /// other and face alike, O(n log n). Triangles make no pair `occluded`.
  std::size_t add_triangles(const TriangleView& triangles, std::span<const std::size_t> first_triangle = {});
  /// Adds solids that find_solids() (solids.hpp) found in triangles; add the triangles themselves with add_triangles().
  /// Found solids make pairs `occluded`, as hulls, polygons and solids do, but they are not occluders: they have no
  /// numbers, and do not keep a pair from being `clear`.
  void add_found(const FoundSolids& found);
  /// Adds a mesh: its triangles in groups, as add_triangles() forms them, and the solids found in them. Bodies that are
  /// upright boxes become solid boxes, in place of the triangles that lie on them (take_boxes()); these triangles are
  /// in no occluder. The groups come first, then the boxes. Writes the result of find_solids() to `found`, if it is not
  /// null. Errors and cost are those of find_solids() and add_triangles().
  std::size_t add_mesh(const TriangleView& triangles, const SolidSearch& search = {}, FoundSolids* found = nullptr);
  std::size_t add_mesh(const MeshView& mesh, const SolidSearch& search = {}, FoundSolids* found = nullptr);

  /// The number of occluders.
  [[nodiscard]] std::size_t size() const noexcept;
  /// The box around occluder i, which is below size().
  [[nodiscard]] Box box(std::size_t i) const noexcept;
  /// The triangles of occluder i, by their positions in the view given to add_triangles() or add_mesh(); empty for
  /// other occluders.
  [[nodiscard]] std::span<const std::uint32_t> triangles(std::size_t i) const noexcept;

  /// For the library itself: the type is not part of the interface.
  [[nodiscard]] const kernel::OccluderData& data() const;

 private:
  [[nodiscard]] kernel::OccluderData& own();

  std::unique_ptr<kernel::OccluderData> data_;  ///< null after a move
};

/// Consecutive patches of PatchSet::order().
struct PatchRun {
  std::uint32_t first;  ///< position of the first patch in the order
  std::uint32_t count;  ///< number of patches
  friend bool operator==(const PatchRun&, const PatchRun&) = default;
};

/// One answer for all pairs of a patch of one run and a patch of another. For one set with itself, the runs never
/// overlap: run a ends before run b begins.
struct PairBlock {
  PatchRun a;   ///< run of the first set
  PatchRun b;   ///< run of the second set
  Sight sight;  ///< never undecided
  friend bool operator==(const PairBlock&, const PairBlock&) = default;
};

/// Two patches, by the user's indices. For one set with itself, patch a comes before patch b in the order of the set.
struct PatchPair {
  std::uint32_t a;  ///< index in the first set
  std::uint32_t b;  ///< index in the second set
  friend bool operator==(const PatchPair&, const PatchPair&) = default;
};

/// Undecided pairs. Pair i has candidates[first_candidate[i] … first_candidate[i + 1]), in ascending order. Both arrays
/// are empty if VisibilityOptions::candidates is false.
struct UndecidedPairs {
  std::span<const PatchPair> pairs;              ///< each pair once
  std::span<const std::size_t> first_candidate;  ///< where the candidates of each pair begin; then the end of the last
  std::span<const std::uint32_t> candidates;     ///< numbers of occluders
};

/// Some of the answers. The library owns the memory, which is valid during the callback only.
struct SightBatch {
  std::span<const PairBlock> blocks;  ///< decided pairs
  UndecidedPairs undecided;           ///< undecided pairs
};

/// The number of pairs per answer.
struct SightCounts {
  std::uint64_t undecided = 0;    ///< Sight::undecided
  std::uint64_t clear = 0;        ///< Sight::clear
  std::uint64_t occluded = 0;     ///< Sight::occluded
  std::uint64_t facing_away = 0;  ///< Sight::facing_away
  /// The number of pairs with one answer; `sight` is an enumerator.
  [[nodiscard]] std::uint64_t& of(Sight sight) noexcept {
    return sight == Sight::undecided  ? undecided
           : sight == Sight::clear    ? clear
           : sight == Sight::occluded ? occluded
                                      : facing_away;
  }
  [[nodiscard]] std::uint64_t of(Sight sight) const noexcept { return SightCounts(*this).of(sight); }
  /// Adds the counts of other pairs.
  SightCounts& operator+=(const SightCounts& more) noexcept {
    undecided += more.undecided;
    clear += more.clear;
    occluded += more.occluded;
    facing_away += more.facing_away;
    return *this;
  }
  /// The number of all pairs.
  [[nodiscard]] std::uint64_t total() const noexcept { return undecided + clear + occluded + facing_away; }
  friend bool operator==(const SightCounts&, const SightCounts&) = default;
};

/// The progress of a call.
struct VisibilityProgress {
  std::uint64_t done;   ///< pairs answered so far
  std::uint64_t total;  ///< all pairs of the call
};

/// Options of visibility calls.
struct VisibilityOptions {
  /// Whether an occluder that only touches a shaft reaches into it: it does with closed contact only. Whether a pair is
  /// `occluded` does not depend on the contact.
  Contact contact = Contact::open;
  /// Whether a solid may make a pair `occluded` although a patch of the pair reaches into the solid. Rays that start
  /// inside a solid do not meet its front, so set this to false if answers must agree with rays. A patch reaches into a
  /// solid box if the box around the patch does (for a flat solid: touches it). It reaches into a solid hull unless all
  /// corners of the patch lie on or in front of one face of the hull. If this is false, boxes that were found inside
  /// hulls and other bodies hide nothing, since they have no surface that rays meet.
  bool solids_around_ends = true;
  /// How far in front of a plane a point may be and still count as behind it, because coordinates are rounded: a point
  /// counts as behind if moving each of its coordinates by `tolerance` or less brings it behind the plane. In the units
  /// of the scene; finite, 0 or more. The tolerance holds for planes of patches, and for planes that separate occluders
  /// from the shaft between two polygons.
  ///
  /// Corners of one wall that is not axis-parallel lie in one plane only up to rounding. If corners are off by r, the
  /// plane of a patch of width w is off by about 2 r d / w at a distance d, so a tolerance of a few times that makes
  /// patches of one wall face away from each other. An axis-parallel wall needs no tolerance.
  float tolerance = 0;
  /// Whether undecided pairs come with candidates.
  bool candidates = true;
  /// All pairs are divided into `parts` parts, numbered from 0, and the call answers part `part` alone. So several
  /// processes can share the work, and finished parts can be stored. Each pair is in exactly one part. A part has three
  /// to five quarters of an equal share of the pairs, or 4,096 pairs more or less where shares are small. The division
  /// depends on the patches and on `parts` only. If a pair both faces away and is occluded, its answer may be
  /// `facing_away` with one value of `parts` and `occluded` with another.
  std::uint32_t part = 0;
  std::uint32_t parts = 1;  ///< 1 or more, and above `part`
  /// Limit in bytes for answers in progress and for pairs of groups that wait for answers. It does not include the
  /// sets, the occluders, and memory that callbacks keep; nor about 2.5 MB plus 200 bytes per occluder for each thread;
  /// nor, if patches have corners, 180 bytes per occluder once. A single pair and its candidates may exceed the limit.
  /// If the limit is small for the number of threads, pairs of groups are answered in smaller parts and, if even these
  /// do not fit, on one thread.
  std::size_t memory = std::size_t{256} << 20;
  /// Receives undecided pairs before delivery, and may give the final answer for each, for example with rays.
  /// verdict[i] is the answer for pair i, at first `undecided`. Many threads call `resolve` at once. Answers do not
  /// depend on the number of threads if the verdicts do not. An exception that `resolve` throws ends the call and
  /// reaches the caller, as does InvalidArgument for a verdict that is not an enumerator.
  std::function<void(const UndecidedPairs& undecided, std::span<Sight> verdict)> resolve = {};
  /// Receives the progress several times per second, and returns whether to continue. If it returns false, the call
  /// throws Cancelled. If it throws, the call throws the same exception. Calls of `resolve` in progress return first,
  /// so a long call delays the exception.
  std::function<bool(const VisibilityProgress& progress)> progress = {};
  std::uint64_t reserved[4] = {};  ///< for options of later versions
};

/// Thrown by a call that its `progress` callback ends.
class SHAFTCULL_EXPORT Cancelled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~Cancelled() override;
  Cancelled(const Cancelled&) = default;
  Cancelled& operator=(const Cancelled&) = default;
};

/// Returns how many pairs of a patch of `a` and a patch of `b` have each answer. Nothing is written for any pair.
///
/// With VisibilityOptions::part, only the pairs of that part are counted. O(pairs · occluders) at worst. Two groups
/// that are answered as a whole cost one answer, so a few nanoseconds per pair are usual. VisibilityOptions::memory
/// describes the allocation. Verdicts of `resolve` are counted. Throws InvalidArgument for an option that is not an
/// enumerator, for memory of less than 1 MB, and for a `part` that is not below `parts`; std::bad_alloc; Cancelled; and
/// exceptions of callbacks.
[[nodiscard]] SHAFTCULL_EXPORT SightCounts count_visibility(const PatchSet& a, const PatchSet& b,
                                                            const Occluders& occluders,
                                                            const VisibilityOptions& options = {});
/// The same for one set with itself: every two patches are one pair.
[[nodiscard]] SHAFTCULL_EXPORT SightCounts count_visibility(const PatchSet& patches, const Occluders& occluders,
                                                            const VisibilityOptions& options = {});

/// Delivers every pair exactly once, in calls of deliver(batch): in a pair block of `blocks`, or as an undecided
/// pair. Returns the number of pairs delivered with each answer. `resolve` runs before: a pair that it decides is
/// delivered as a pair block of one pair. If `resolve` or deliver() throws, nothing more is delivered. Costs, memory
/// and errors are those of count_visibility(). In addition, the call writes 20 bytes per pair block, 16 per undecided
/// pair and 4 per candidate, and throws InvalidArgument for an empty `deliver`.
SHAFTCULL_EXPORT SightCounts visibility(const PatchSet& a, const PatchSet& b, const Occluders& occluders,
                                        FunctionRef<void(const SightBatch&)> deliver,
                                        const VisibilityOptions& options = {});
SHAFTCULL_EXPORT SightCounts visibility(const PatchSet& patches, const Occluders& occluders,
                                        FunctionRef<void(const SightBatch&)> deliver,
                                        const VisibilityOptions& options = {});

/// All answers, in memory.
struct Visibility {
  std::vector<PairBlock> blocks;             ///< decided pairs
  std::vector<PatchPair> undecided;          ///< undecided pairs, as in UndecidedPairs
  std::vector<std::size_t> first_candidate;  ///< as in UndecidedPairs
  std::vector<std::uint32_t> candidates;     ///< as in UndecidedPairs
  SightCounts counts;                        ///< number of pairs per answer
};

/// Returns all answers that visibility() delivers. Memory is not limited: 20 bytes per pair block, of which there may
/// be a tenth to a fifth as many as pairs; 16 bytes per undecided pair and 4 per candidate; up to three times that
/// while a vector grows. Use visibility() where that is too much. Costs and errors are those of visibility().
[[nodiscard]] SHAFTCULL_EXPORT Visibility collect_visibility(const PatchSet& a, const PatchSet& b,
                                                             const Occluders& occluders,
                                                             const VisibilityOptions& options = {});
[[nodiscard]] SHAFTCULL_EXPORT Visibility collect_visibility(const PatchSet& patches, const Occluders& occluders,
                                                             const VisibilityOptions& options = {});

/// Writes one bit per pair: whether the answer is `sight`. `bits` has one row of bit_words(b.size()) words for each
/// patch of `a`; bit j of row i is the bit of patches i and j. With VisibilityOptions::part, the bits of all pairs in
/// other parts are 0. For one set with itself, both bits of a pair are written, and the diagonal is 0. Verdicts of
/// `resolve` are included. Throws InvalidArgument if `bits` does not have exactly a.size() rows, or if `sight` is not
/// an enumerator. If the call throws for another reason than its arguments, the bits are unspecified. Otherwise as
/// visibility(); costs O(pairs with this answer) more.
SHAFTCULL_EXPORT SightCounts visibility_bits(const PatchSet& a, const PatchSet& b, const Occluders& occluders,
                                             Sight sight, std::span<std::uint64_t> bits,
                                             const VisibilityOptions& options = {});
SHAFTCULL_EXPORT SightCounts visibility_bits(const PatchSet& patches, const Occluders& occluders, Sight sight,
                                             std::span<std::uint64_t> bits, const VisibilityOptions& options = {});

}  // namespace shaftcull
