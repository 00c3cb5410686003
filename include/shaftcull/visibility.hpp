// SPDX-License-Identifier: MIT
/// What sees what: of all pairs of patches, which see each other for certain, which cannot, and which need a closer
/// look.
///
/// *Patches* are boxes: of a facet of a wall, of a point, of a cell of a volume that receives. Each may have a plane,
/// as facets do. *Blockers* are what stands between them. Of every pair one of four things is said:
///
/// * `facing_away`: one of the two lies wholly on or behind the plane of the other.
/// * `blocked`: a solid alone hides them. Every segment from the one box to the other passes through its interior.
/// * `clear`: nothing hides any part. No blocker reaches into the shaft between both boxes and in front of both planes.
/// * `undecided`: none of the three. Its *candidates* are the blockers that do reach in: rays need to be tested with
/// them
///   only.
///
/// All are exact for the floats given: which pairs are undecided, and their candidates, follow from these definitions
/// alone. A pair that is told to be clear does not face away. One that faces away and is blocked, too, is told either:
/// the same on every instruction set and for any number of threads.
///
/// A blocker reaches into the shaft if the box around it does, as cull() with open contact says (Contact in shaft.hpp),
/// and if not all of its corners lie on or behind one of the two planes. Those of a box, solid or not, are its eight
/// corners; those of a hull or a polygon are the ones that were given, not those of the box around it; those of
/// triangles are their vertices. Groups of neighbouring triangles are one blocker: it lies behind if all vertices of
/// the group do.
///
/// Patches are put in a tree, and groups of them compared first: what is true of two groups is true of all pairs in
/// them. So time grows with what is undecided, and memory stays below a bound however many pairs there are.
/// E. Haines and J. Wallace, "Shaft Culling for Efficient Ray-Traced Radiosity", 1991, had shafts between groups first.
///
/// Calls run in parallel on oneTBB, in the caller's task_arena. Callbacks are called one at a time, in an order that
/// does not depend on the number of threads, but for `VisibilityOptions::resolve`. Floating-point modes and flags are
/// as many.hpp says. Everything const is safe to call from many threads.
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

// The library's own: not of the interface.
namespace shaftcull::kernel {
class PatchTree;
struct BlockerData;
}  // namespace shaftcull::kernel

namespace SHAFTCULL_INTERFACE shaftcull {

/// What is said of a pair of patches.
enum class Sight : std::uint8_t {
  undecided,    ///< some blockers stand between them, none of which hides all
  clear,        ///< nothing stands between them
  blocked,      ///< one solid hides all
  facing_away,  ///< one is on or behind the plane of the other
};

/// Its name: "undecided", "clear", "blocked", "facing away".
[[nodiscard]] const char* name(Sight sight) noexcept;

/// Patches, in a tree. It holds copies of what it is made of; copies of it share them.
class PatchSet {
 public:
  /// No patches.
  PatchSet() noexcept;
  /// `planes` is empty, or has one for each box: the patch faces where its normal points, and sees what is in front,
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

  /// The library's own.
  [[nodiscard]] const kernel::PatchTree& tree() const noexcept { return *tree_; }

 private:
  explicit PatchSet(std::shared_ptr<const kernel::PatchTree> tree) noexcept : tree_(std::move(tree)) {}

  std::shared_ptr<const kernel::PatchTree> tree_;
};

/// What stands between patches. Blockers are numbered in the order in which they are added, from 0 on. A value: copies
/// are deep.
///
/// Members that add throw BadBound for a value that is not finite, or a box with lo > hi, by its position, and
/// InvalidArgument for what each of them says; then nothing was added. They return the number of the first blocker
/// that they added.
class Blockers {
 public:
  Blockers();
  Blockers(const Blockers& other);
  Blockers(Blockers&& other) noexcept;
  Blockers& operator=(Blockers other) noexcept;
  ~Blockers();

  /// Boxes around things that may hide something. They make no pair `blocked`. One blocker a box.
  std::size_t add_boxes(const BoxView& boxes);
  std::size_t add_boxes(std::span<const Box> boxes);
  /// Boxes that are solid: walls, cores of buildings. They make pairs `blocked`, also where several are one larger box
  /// together (merged_boxes() in solids.hpp). One blocker a box.
  std::size_t add_solids(const BoxView& boxes);
  std::size_t add_solids(std::span<const Box> boxes);
  /// The convex hull of some points, solid: a cupboard or a building that is turned. `corners` are those of all hulls,
  /// one behind the other, and hull i has those from first_corner[i] to before first_corner[i + 1]; 4 to 32 each. It
  /// makes pairs `blocked` by the largest box that is found inside it (inscribed_box() in solids.hpp). One blocker a
  /// hull.
  std::size_t add_solid_hulls(std::span<const Vec3> corners, std::span<const std::size_t> first_corner);
  /// Flat convex polygons, by their corners in order: walls without thickness. They make pairs `blocked`. As hulls,
  /// with 3 corners or more each. One blocker a polygon.
  std::size_t add_polygons(std::span<const Vec3> corners, std::span<const std::size_t> first_corner);
  /// Triangles, in groups. Group i has the triangles from first_triangle[i] to before first_triangle[i + 1]: whole
  /// objects are good groups. If there is no such list, the library makes groups of at most 32 neighbours. They make no
  /// pair `blocked`. One blocker a group.
  std::size_t add_triangles(const TriangleView& triangles, std::span<const std::size_t> first_triangle = {});

  /// How many blockers.
  [[nodiscard]] std::size_t size() const noexcept;
  /// The box around blocker i, which is below size().
  [[nodiscard]] Box box(std::size_t i) const noexcept;
  /// The triangles of blocker i, by their positions in the view that it was added from; empty if it has none.
  [[nodiscard]] std::span<const std::uint32_t> triangles(std::size_t i) const noexcept;

  /// The library's own.
  [[nodiscard]] const kernel::BlockerData& data() const noexcept { return *data_; }

 private:
  std::unique_ptr<kernel::BlockerData> data_;
};

/// Some patches side by side in PatchSet::order().
struct PatchRun {
  std::uint32_t first;  ///< position in the order
  std::uint32_t count;  ///< how many
  friend bool operator==(const PatchRun&, const PatchRun&) = default;
};

/// One answer for all pairs of a patch of one run and a patch of another.
struct SightProduct {
  PatchRun a;   ///< of the first set
  PatchRun b;   ///< of the second set
  Sight sight;  ///< never undecided
  friend bool operator==(const SightProduct&, const SightProduct&) = default;
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
  std::span<const std::uint32_t> candidates;     ///< numbers of blockers
};

/// Some answers. Memory is the library's, and valid during the call only.
struct SightBatch {
  std::span<const SightProduct> products;  ///< what is decided
  UndecidedPairs undecided;                ///< and what is not
};

/// How many pairs there are of each kind.
struct SightCounts {
  std::uint64_t undecided = 0;    ///< Sight::undecided
  std::uint64_t clear = 0;        ///< Sight::clear
  std::uint64_t blocked = 0;      ///< Sight::blocked
  std::uint64_t facing_away = 0;  ///< Sight::facing_away
  /// Of all kinds.
  [[nodiscard]] std::uint64_t total() const noexcept { return undecided + clear + blocked + facing_away; }
  friend bool operator==(const SightCounts&, const SightCounts&) = default;
};

/// How far a call has come.
struct VisibilityProgress {
  std::uint64_t done;   ///< pairs that were answered
  std::uint64_t total;  ///< of so many
};

/// How it is done.
struct VisibilityOptions {
  /// Whether what only touches a shaft reaches into it. Blocked is always open: what only touches hides nothing.
  Contact contact = Contact::open;
  /// Whether a solid makes a pair `blocked` if an end reaches into its interior; if it is flat, if an end touches
  /// it. No ray that starts inside a solid meets its front: set it to false where answers are to be those of rays.
  bool solids_around_ends = true;
  /// Whether undecided pairs come with candidates.
  bool candidates = true;
  /// Bytes that answers under way may take, and what they are found with. On top come the sets and blockers, some 2 MB
  /// a thread, and what a callback keeps.
  std::size_t memory = std::size_t{256} << 20;
  /// Gets undecided pairs and may give the final word on each, by rays for instance: verdict[i] is of pair i, and
  /// undecided to begin with. Called by many threads at once. What it answers is deterministic if it is.
  std::function<void(const UndecidedPairs& undecided, std::span<Sight> verdict)> resolve = {};
  /// Is told how far the call has come, some times a second; returns whether to go on. If it says no, the call ends as
  /// soon as it can and throws Cancelled.
  std::function<bool(const VisibilityProgress& progress)> progress = {};
};

/// What is thrown if a callback wants a call to end.
class Cancelled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~Cancelled() override;
  Cancelled(const Cancelled&) = default;
  Cancelled& operator=(const Cancelled&) = default;
};

/// How many pairs of a patch of `a` and a patch of `b` there are of each kind. Nothing is written for any pair.
/// Throws InvalidArgument for options that are no enumerator or for memory of less than 1 MB, std::bad_alloc,
/// Cancelled, and what callbacks throw.
[[nodiscard]] SightCounts count_visibility(const PatchSet& a, const PatchSet& b, const Blockers& blockers,
                                           const VisibilityOptions& options = {});
/// Of one set with itself: of each two patches once.
[[nodiscard]] SightCounts count_visibility(const PatchSet& patches, const Blockers& blockers,
                                           const VisibilityOptions& options = {});

/// Calls deliver(batch) again and again until every pair was in one batch, once: in one of its products, or undecided.
/// Returns how many there were of each kind, as they were delivered. Otherwise as count_visibility().
SightCounts visibility(const PatchSet& a, const PatchSet& b, const Blockers& blockers,
                       FunctionRef<void(const SightBatch&)> deliver, const VisibilityOptions& options = {});
SightCounts visibility(const PatchSet& patches, const Blockers& blockers, FunctionRef<void(const SightBatch&)> deliver,
                       const VisibilityOptions& options = {});

/// All answers, in memory.
struct Visibility {
  std::vector<SightProduct> products;        ///< what is decided
  std::vector<PatchPair> undecided;          ///< as UndecidedPairs has them, with their candidates
  std::vector<std::size_t> first_candidate;  ///< likewise
  std::vector<std::uint32_t> candidates;     ///< likewise
  SightCounts counts;                        ///< of each kind
};

/// Collects what visibility() delivers. It may take much memory: 20 bytes a product, and there are some 0.1 to 0.2 as
/// many as pairs.
[[nodiscard]] Visibility collect_visibility(const PatchSet& a, const PatchSet& b, const Blockers& blockers,
                                            const VisibilityOptions& options = {});
[[nodiscard]] Visibility collect_visibility(const PatchSet& patches, const Blockers& blockers,
                                            const VisibilityOptions& options = {});

/// Writes a bit for every pair: rows of words_for(b.size()) words, one for each patch of `a`. Bit j of row i says
/// whether patches i and j are of that kind. Of one set with itself both bits of a pair are written, and the diagonal
/// is 0. Throws InvalidArgument if `bits` has not exactly a.size() rows. Otherwise as count_visibility().
SightCounts visibility_bits(const PatchSet& a, const PatchSet& b, const Blockers& blockers, Sight sight,
                            std::span<std::uint64_t> bits, const VisibilityOptions& options = {});
SightCounts visibility_bits(const PatchSet& patches, const Blockers& blockers, Sight sight,
                            std::span<std::uint64_t> bits, const VisibilityOptions& options = {});

}  // namespace shaftcull
