// SPDX-License-Identifier: MIT
/// What sees what: of all pairs of patches, which see each other for certain, which cannot, and which need a closer
/// look.
///
/// *Patches* are boxes: of a facet of a wall, of a point, of a cell of a volume that receives. Each may have a plane,
/// as facets do. *Occluders* are what stands between them. Of every pair one of four things is said:
///
/// * `facing_away`: one box lies wholly on or behind the plane of the other patch.
/// * `occluded`: one solid hides each box from the other. Every segment between them passes through its interior.
/// * `clear`: no occluder reaches into the shaft between the two boxes, in front of both planes.
/// * `undecided`: none of the three. Its *candidates* are the occluders that reach in: rays need no others.
///
/// One solid is a solid box; the box inside a solid hull that inscribed_box() finds, so a hull may hide more than is
/// told; or a larger box that some of these make together, as merged_boxes() finds it (both in solids.hpp). A polygon
/// has no interior: segments pass from the one side of its plane to the other, within its edges.
///
/// All are exact for the floats given: which pairs are undecided, and their candidates, follow from these definitions
/// alone. A pair that faces away or is occluded is never told to be clear. One that faces away and is occluded, too, is
/// told either: the same on every instruction set and for any number of threads.
///
/// An occluder reaches into the shaft if the box around it does, as cull() with open contact says (Contact in
/// shaft.hpp), and if not all of its corners lie on or behind one of the two planes. Those of a box, solid or not, are
/// its eight corners; those of a hull or a polygon are the ones that were given, not those of the box around it; those
/// of triangles are their vertices. Groups of neighbouring triangles are one occluder: it lies behind if all vertices
/// of the group do.
///
/// Patches are put in a tree, and groups of them compared first: what is true of two groups is true of all pairs in
/// them. So time grows with what is undecided, and memory stays below a bound however many pairs there are.
/// E. Haines and J. Wallace, "Shaft Culling for Efficient Ray-Traced Radiosity", 1991, had shafts between groups first.
///
/// Calls run in parallel on oneTBB, in the caller's task_arena. Callbacks are called one at a time, but for
/// `VisibilityOptions::resolve`. Answers come in an order that depends neither on the number of threads nor on
/// `VisibilityOptions::memory`; where one batch of them ends and the next one begins does. Floating-point modes and
/// flags are as many.hpp says. Everything const is safe to call from many threads.
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
#include "shaftcull/export.hpp"
#include "shaftcull/function_ref.hpp"
#include "shaftcull/shaft.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/triangles.hpp"

// Types of the library that are not of the interface.
namespace shaftcull::kernel {
class PatchTree;
struct OccluderData;
}  // namespace shaftcull::kernel

namespace SHAFTCULL_INTERFACE shaftcull {

/// What is said of a pair of patches.
enum class Sight : std::uint8_t {
  undecided,    ///< occluders reach between them, and no solid hides all
  clear,        ///< no occluder reaches between them
  occluded,     ///< one solid hides all
  facing_away,  ///< one is on or behind the plane of the other
};

/// Its name, as in files and in Python: "undecided", "clear", "occluded", "facing_away".
[[nodiscard]] SHAFTCULL_EXPORT const char* name(Sight sight) noexcept;

/// Patches, in a tree. It holds copies of what it is made of; copies of it share them. One that was moved from has no
/// patches.
class SHAFTCULL_EXPORT PatchSet {
 public:
  /// No patches.
  PatchSet() noexcept = default;
  /// `planes` is empty, or has one for each box. A patch faces where its normal points, and sees what is in front:
  /// normal·p > offset. Throws InvalidArgument if their number is another, or if there are 2³² − 1 patches or more;
  /// BadBound for a box that is not finite with lo ≤ hi, or a plane that is not finite or whose normal is zero, by its
  /// position. O(n log n); allocates some 100 bytes a patch.
  explicit PatchSet(const BoxView& boxes, std::span<const Plane> planes = {});
  explicit PatchSet(std::span<const Box> boxes, std::span<const Plane> planes = {});

  /// How many patches.
  [[nodiscard]] std::size_t size() const noexcept;
  /// Whether they have planes.
  [[nodiscard]] bool has_planes() const noexcept;
  /// The patches in the order of the tree: a PatchRun is a part of it. A permutation of 0 … size() − 1.
  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept;

  /// What the library reads. No use to others: the type is not of the interface.
  [[nodiscard]] const kernel::PatchTree& tree() const noexcept;

 private:
  explicit PatchSet(std::shared_ptr<const kernel::PatchTree> tree) noexcept : tree_(std::move(tree)) {}

  std::shared_ptr<const kernel::PatchTree> tree_;  ///< none of no patches
};

/// What stands between patches. Occluders are numbered in the order in which they are added, from 0 on. A value: copies
/// are deep, and one that was moved from has no occluders.
///
/// Members that add throw BadBound for a value that is not finite, or a box with lo > hi, by its position, and
/// InvalidArgument for what each of them says; then nothing was added, as where memory runs out. They return the number
/// of the first occluder that they added. Each takes time and memory in proportion to what it adds, amortised: adding
/// one at a time costs no more. It allocates some 50 bytes an occluder, 24 more for a solid, 12 a corner of a hull, a
/// polygon or a group, and 4 a triangle.
///
/// Solids that are one larger box together are found by the first call of visibility() and the like that gets occluders
/// after some were added: some O(n log n) of all solids, on one thread, and 32 bytes for each box that is found. Copies
/// made after that share them.
class SHAFTCULL_EXPORT Occluders {
 public:
  Occluders();
  Occluders(const Occluders& other);
  Occluders(Occluders&& other) noexcept;
  Occluders& operator=(Occluders other) noexcept;
  ~Occluders();

  /// Boxes around things that may hide something. They make no pair `occluded`. One occluder a box.
  std::size_t add_boxes(const BoxView& boxes);
  std::size_t add_boxes(std::span<const Box> boxes);
  /// Boxes that are solid: walls, cores of buildings. They make pairs `occluded`, also where several are one larger box
  /// together (merged_boxes() in solids.hpp). One occluder a box.
  std::size_t add_solids(const BoxView& boxes);
  std::size_t add_solids(std::span<const Box> boxes);
  /// The convex hull of some points, solid: a cupboard or a building that is turned. `corners` are those of all hulls,
  /// one behind the other, and hull i has those from first_corner[i] to before first_corner[i + 1]; 4 to 32 each. It
  /// makes pairs `occluded` by the largest box that is found inside it (inscribed_box() in solids.hpp), which is looked
  /// for at once. One occluder a hull.
  std::size_t add_solid_hulls(std::span<const Vec3> corners, std::span<const std::size_t> first_corner);
  /// Flat convex polygons, by their corners in order: walls without thickness. They make pairs `occluded`. As hulls,
  /// with 3 corners or more each. Each is taken as occluded(shaft, polygon) takes it (occluded.hpp): one whose corners
  /// are a little out of plane is the triangles that its first corner makes with its other edges. That it is convex is
  /// not checked. One occluder a polygon.
  std::size_t add_polygons(std::span<const Vec3> corners, std::span<const std::size_t> first_corner);
  /// Triangles, in groups. Group i has the triangles from first_triangle[i] to before first_triangle[i + 1]: whole
  /// objects are good groups. If there is no such list, the library makes groups of at most 32 neighbours, O(n log n).
  /// They make no pair `occluded`. One occluder a group.
  std::size_t add_triangles(const TriangleView& triangles, std::span<const std::size_t> first_triangle = {});

  /// How many occluders.
  [[nodiscard]] std::size_t size() const noexcept;
  /// The box around occluder i, which is below size().
  [[nodiscard]] Box box(std::size_t i) const noexcept;
  /// The triangles of occluder i, by their positions in the view that it was added from; empty if it has none.
  [[nodiscard]] std::span<const std::uint32_t> triangles(std::size_t i) const noexcept;

  /// What the library reads. No use to others: the type is not of the interface.
  [[nodiscard]] const kernel::OccluderData& data() const;

 private:
  [[nodiscard]] kernel::OccluderData& own();

  std::unique_ptr<kernel::OccluderData> data_;  ///< none in one that was moved from
};

/// Some patches side by side in PatchSet::order().
struct PatchRun {
  std::uint32_t first;  ///< position in the order
  std::uint32_t count;  ///< how many
  friend bool operator==(const PatchRun&, const PatchRun&) = default;
};

/// One answer for all pairs of a patch of one run and a patch of another. The two runs of a product of one set with
/// itself never overlap: the first ends before the second begins.
struct PairBlock {
  PatchRun a;   ///< of the first set
  PatchRun b;   ///< of the second set
  Sight sight;  ///< never undecided
  friend bool operator==(const PairBlock&, const PairBlock&) = default;
};

/// Two patches, by the user's indices: the first of set a, the second of set b. Of one set with itself, the one that is
/// first in its order comes first.
struct PatchPair {
  std::uint32_t a;  ///< of the first set
  std::uint32_t b;  ///< of the second set
  friend bool operator==(const PatchPair&, const PatchPair&) = default;
};

/// Pairs that are undecided. Candidates of pair i are candidates[first_candidate[i]] to before first_candidate[i + 1],
/// in ascending order; both are empty if they were not asked for.
struct UndecidedPairs {
  std::span<const PatchPair> pairs;              ///< each once
  std::span<const std::size_t> first_candidate;  ///< where those of each pair begin, and where the last ones end
  std::span<const std::uint32_t> candidates;     ///< numbers of occluders
};

/// Some answers. Memory is the library's, and valid during the call only.
struct SightBatch {
  std::span<const PairBlock> products;  ///< what is decided
  UndecidedPairs undecided;             ///< and what is not
};

/// How many pairs there are of each kind.
struct SightCounts {
  std::uint64_t undecided = 0;    ///< Sight::undecided
  std::uint64_t clear = 0;        ///< Sight::clear
  std::uint64_t occluded = 0;     ///< Sight::occluded
  std::uint64_t facing_away = 0;  ///< Sight::facing_away
  /// Those of one kind, which is an enumerator.
  [[nodiscard]] std::uint64_t& of(Sight sight) noexcept {
    return sight == Sight::undecided  ? undecided
           : sight == Sight::clear    ? clear
           : sight == Sight::occluded ? occluded
                                      : facing_away;
  }
  [[nodiscard]] std::uint64_t of(Sight sight) const noexcept { return SightCounts(*this).of(sight); }
  /// Of all kinds.
  [[nodiscard]] std::uint64_t total() const noexcept { return undecided + clear + occluded + facing_away; }
  friend bool operator==(const SightCounts&, const SightCounts&) = default;
};

/// How far a call has come.
struct VisibilityProgress {
  std::uint64_t done;   ///< pairs that were answered
  std::uint64_t total;  ///< of so many
};

/// How it is done.
struct VisibilityOptions {
  /// Whether an occluder that only touches a shaft reaches into it: with closed contact it does. A solid that only
  /// touches blocks nothing, whatever the contact.
  Contact contact = Contact::open;
  /// Whether a solid may make a pair `occluded` though a box of the pair reaches into it (a flat solid: touches it).
  /// Rays that start inside a solid do not meet its front. Set it to false where answers must be those of rays.
  bool solids_around_ends = true;
  /// Whether undecided pairs come with candidates.
  bool candidates = true;
  /// Bytes that answers under way may take, and the products of groups that wait for theirs. On top come the sets and
  /// occluders, for each thread some 2 MB and 200 bytes an occluder, and what a callback keeps. One pair and its
  /// candidates are kept however long they are. With little memory for many threads, products are answered in smaller
  /// parts, and where even those have no room, on one thread.
  std::size_t memory = std::size_t{256} << 20;
  /// Gets undecided pairs before they are delivered, and may give the final word on each, by rays for instance.
  /// verdict[i] is that of pair i, `undecided` to begin with. Many threads call it at once. Answers do not depend on
  /// the number of threads if its verdicts do not. An exception that it throws ends the call and reaches the caller, as
  /// does InvalidArgument for a verdict that is no enumerator.
  std::function<void(const UndecidedPairs& undecided, std::span<Sight> verdict)> resolve = {};
  /// Is told how far the call has come, some times a second; returns whether to go on. If it says no, the call throws
  /// Cancelled once calls of `resolve` that have begun have returned: a long one delays that. So does an exception that
  /// it throws.
  std::function<bool(const VisibilityProgress& progress)> progress = {};
};

/// What is thrown if a callback wants a call to end.
class SHAFTCULL_EXPORT Cancelled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~Cancelled() override;
  Cancelled(const Cancelled&) = default;
  Cancelled& operator=(const Cancelled&) = default;
};

/// How many pairs of a patch of `a` and a patch of `b` there are of each kind. Nothing is written for any pair.
///
/// O(pairs · occluders) at worst. Groups that are answered as a whole cost one answer, so some nanoseconds a pair are
/// usual. Allocates what VisibilityOptions::memory says. If there is a `resolve`, its verdicts are counted. Throws
/// InvalidArgument for options that are no enumerator or for memory of less than 1 MB, std::bad_alloc, Cancelled, and
/// what callbacks throw.
[[nodiscard]] SHAFTCULL_EXPORT SightCounts count_visibility(const PatchSet& a, const PatchSet& b,
                                                            const Occluders& occluders,
                                                            const VisibilityOptions& options = {});
/// Of one set with itself: of each two patches once.
[[nodiscard]] SHAFTCULL_EXPORT SightCounts count_visibility(const PatchSet& patches, const Occluders& occluders,
                                                            const VisibilityOptions& options = {});

/// Calls deliver(batch) again and again until every pair was in one batch, once: in one of its products, or undecided.
/// Returns how many there were of each kind, as they were delivered. `resolve` runs before: a pair with a verdict of
/// its own is delivered in a product of one pair. If `resolve` or deliver() throws, what was delivered stays so, and
/// nothing more is. Costs, memory and errors are those of count_visibility(), and 20 bytes are written a product, 16
/// and 4 for each candidate an undecided pair. Throws InvalidArgument for an empty deliver, too.
SHAFTCULL_EXPORT SightCounts visibility(const PatchSet& a, const PatchSet& b, const Occluders& occluders,
                                        FunctionRef<void(const SightBatch&)> deliver,
                                        const VisibilityOptions& options = {});
SHAFTCULL_EXPORT SightCounts visibility(const PatchSet& patches, const Occluders& occluders,
                                        FunctionRef<void(const SightBatch&)> deliver,
                                        const VisibilityOptions& options = {});

/// All answers, in memory.
struct Visibility {
  std::vector<PairBlock> products;           ///< what is decided
  std::vector<PatchPair> undecided;          ///< as UndecidedPairs has them, with their candidates
  std::vector<std::size_t> first_candidate;  ///< likewise
  std::vector<std::uint32_t> candidates;     ///< likewise
  SightCounts counts;                        ///< of each kind
};

/// Collects what visibility() delivers. Memory is not bounded: 20 bytes a product, of which there may be a tenth to a
/// fifth as many as pairs; 16 bytes an undecided pair and 4 a candidate; while a vector grows, up to three times that.
/// Use visibility() where that is too much. Costs and errors are those of visibility().
[[nodiscard]] SHAFTCULL_EXPORT Visibility collect_visibility(const PatchSet& a, const PatchSet& b,
                                                             const Occluders& occluders,
                                                             const VisibilityOptions& options = {});
[[nodiscard]] SHAFTCULL_EXPORT Visibility collect_visibility(const PatchSet& patches, const Occluders& occluders,
                                                             const VisibilityOptions& options = {});

/// Writes a bit for every pair: rows of bit_words(b.size()) words, one for each patch of `a`. Bit j of row i says
/// whether patches i and j are of that kind. Of one set with itself both bits of a pair are written, and the diagonal
/// is 0. If there is a `resolve`, its verdicts are written. If the call throws for something else than its arguments,
/// bits hold anything. Throws InvalidArgument if `bits` has not exactly a.size() rows, or if `sight` is no enumerator.
/// Otherwise as visibility(); costs O(pairs of the kind) more.
SHAFTCULL_EXPORT SightCounts visibility_bits(const PatchSet& a, const PatchSet& b, const Occluders& occluders,
                                             Sight sight, std::span<std::uint64_t> bits,
                                             const VisibilityOptions& options = {});
SHAFTCULL_EXPORT SightCounts visibility_bits(const PatchSet& patches, const Occluders& occluders, Sight sight,
                                             std::span<std::uint64_t> bits, const VisibilityOptions& options = {});

}  // namespace shaftcull
