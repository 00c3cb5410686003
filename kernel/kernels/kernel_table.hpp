// SPDX-License-Identifier: MIT
/// The dispatch table: what every instruction set's translation unit provides.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compiled/shaft_data.hpp"
#include "kernels/rays/ray_packet.hpp"
#include "kernels/siblings/siblings.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/isa.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

/// Tests `count` bounds, any count, in separate streams (6 for boxes, 4 for spheres). Writes bit_words(count)
/// words of kept bits and as many of inside bits, each unless it is null; bits past count are zero.
/// The shaft must answer what is asked; pending planes are completed on the fly.
using Test = void(const ShaftData& shaft, const float* const* stream, std::size_t count, std::uint64_t* kept,
                  std::uint64_t* inside) noexcept;

/// Whether the shaft keeps a single bound: six floats of a box or four of a sphere, side by side. The shaft must answer
/// outside.
using KeepsOne = bool(const ShaftData& shaft, const float* bound) noexcept;

/// What the shaft says of a single bound, as above. The shaft must answer everything; pending planes are
/// completed on the fly, if the bound is not outside.
using ClassifyOne = Answer(const ShaftData& shaft, const float* bound) noexcept;

/// Writes the boxes around `count` spheres into six streams, in whole words: what many shafts' tests would each make
/// anew. A last word that they do not fill is filled up by boxes that are outside of everything.
using BoxesAroundSpheres = void(const float* const* sphere, std::size_t count, float* const* box) noexcept;

/// Forms the shafts of `count` pairs of boxes that are known to be finite with lo ≤ hi.
using CompileFinite = void(const float* const* a, const float* const* b, std::size_t count, ShaftData* out) noexcept;

/// Whether all of `count` boxes are finite with lo ≤ hi.
using AllFinite = bool(const float* const* box, std::size_t count) noexcept;

/// Whether all of `count` planes are finite with normals that are not zero.
using AllPlanesUsable = bool(const Plane* planes, std::size_t count) noexcept;

/// Adds planes[i][0 … planes_each) to shaft out[i] between boxes a[·][i] and b[·][i], after those that it has; all have
/// equally many, and space for these.
using AddPlanes = void(const float* const* a, const float* const* b, const Plane* const* planes,
                       std::size_t planes_each, std::size_t count, ShaftData* out) noexcept;

/// Forms the shaft of one pair of boxes. Returns false, and writes nothing, if a box is not finite with lo ≤ hi.
using CompilePair = bool(const Box& a, const Box& b, ShaftData& out) noexcept;

/// Forms the shaft of a body, six faces, that moves by or along a vector of three floats; or of an occluder and the
/// light that it moves away from, six faces each. Returns false if the general way must form it, or refuses it.
using CompileMoving = bool(const void* body, const float* vector, ShaftData& out) noexcept;
using CompileShadow = bool(const void* light, const void* occluder, ShaftData& out) noexcept;

/// Tests `words` whole words of bounds, word i being those from stream[·][64 · word[i]] on. Writes their kept bits, and
/// unless `inside` is null the inside bits of those words that keep `least_kept` bounds or more, zero for the
/// others. The shaft must have its planes if `inside` is not null or the form or kind of bounds needs them.
using TestListedWords = void(const ShaftData& shaft, const float* const* stream, const std::uint32_t* word,
                             std::size_t words, std::uint64_t* kept, std::uint64_t* inside,
                             unsigned least_kept) noexcept;

/// Boxes that block a shaft: those that every segment between its two boxes passes through (shaftcull/occluded.hpp).
/// Added planes are left out. The shaft must have been formed.
struct OcclusionKernels {
  /// Writes as kept bits those of boxes that block the shaft. `inside` is null.
  Test* boxes;
  /// Likewise for words of a list; `least_kept` says nothing.
  TestListedWords* listed_boxes;
  /// Likewise for boxes around boxes: zero only where no box in them can block the shaft.
  TestListedWords* listed_nodes;
};

/// Writes from[i] for every set bit i, ascending, to `out`, and returns how many. Reads all 64 of `from`, and may
/// overwrite all 64 of `out`.
using CompressIndices = std::size_t(const std::uint32_t* from, std::uint64_t bits, std::uint32_t* out) noexcept;

/// Bit i says whether layers[i] & mask is not 0, for a word of 64 bounds' layers.
using KeepLayers = std::uint64_t(const std::uint32_t* layers, std::uint32_t mask) noexcept;

/// Writes the box around each of `words` words of bounds, at most 64, to node[0 … 5]. Returns which of them hold a
/// bound that is empty (for spheres: with a negative radius). NaN must not occur.
using NodeBounds = std::uint64_t(const float* const* stream, std::size_t words, float* const* node) noexcept;

/// Of 64 nodes, the one that a box suits best: where bias + 65 m' − 64 m is least, m being the square of the sum of the
/// node's widths, and m' that of the node with the box. So the growth counts for each of 64 bounds, and the measure for
/// the place that the bound takes. 64 if it is finite for none. Writes the least. Six streams, six corners.
using BestNode = unsigned(const float* const* node, const float* corner, const float* bias, float* least_cost) noexcept;

/// Between which keys, coordinates on an axis, the one of a rank most likely is.
struct SampleBracket {
  unsigned axis;
  float from;
  float to;
};

/// How many keys are before a bracket, and how many in it.
struct BracketCounts {
  std::size_t below;
  std::size_t between;
};

/// How many keys are less than a pivot, and how many are equal to it.
struct KeyCounts {
  std::size_t less;
  std::size_t equal;
};

/// Streams of the entries of a tree: a bound's centre, x, y and z, which is finite, and its index, as the bits of a
/// float.
inline constexpr std::size_t entry_streams = 4;

/// Halving entries of a tree. Entries are halved on the axis on which centres (of many, a sample) are spread out most.
/// Those with smaller keys come first, but for ties at the cut, which come in order and before larger ones; otherwise
/// entries keep their order. The halves are the same on every instruction set.
struct SplitKernels {
  /// Halves `count` entries. `first_half`, more than none and fewer than all, stay in `from`; the others move to `to`,
  /// from place `first_half` on. The other half of each holds unspecified values after that. O(count).
  void (*halve)(float* const* from, float* const* to, std::size_t count, std::size_t first_half) noexcept;

  // The same in steps, for parts that many threads halve together (tree/split.cpp).

  /// Chooses the axis, and brackets the key of `rank`, by a sample of the entries. `scratch` is three streams of
  /// `count` floats.
  SampleBracket (*bracket)(const float* const* entry, std::size_t count, std::size_t rank,
                           float* const* scratch) noexcept;
  /// Writes the keys in a bracket to `some`, which has space for `count`.
  BracketCounts (*collect_in_bracket)(const float* key, std::size_t count, const SampleBracket& bracket,
                                      float* some) noexcept;
  /// A value that exactly `rank` keys are less than. If there is none, since equal keys straddle that rank, their
  /// value. rank < count.
  float (*pivot)(const float* key, std::size_t count, std::size_t rank) noexcept;
  /// Counts keys.
  KeyCounts (*count_keys)(const float* key, std::size_t count, float pivot) noexcept;
  /// Writes the entries whose keys are less than the pivot to `less`, those whose keys are larger to `larger`, and
  /// those whose keys equal it to `equal`; if that is null, to `larger` too. Writes nothing else.
  void (*scatter)(const float* const* from, std::size_t count, unsigned axis, float pivot, const KeyCounts& counts,
                  float* const* less, float* const* equal, float* const* larger) noexcept;
};

/// Positions past the last one that SetBits::write() may overwrite.
inline constexpr std::size_t set_bits_slack = 16;

/// Words of bits as a count and as a list of positions.
struct SetBits {
  /// Number of set bits in `count` words.
  std::size_t (*count)(const std::uint64_t* words, std::size_t count) noexcept;

  /// Writes 64 w + i for every set bit i of every word w, ascending. `set` is how many there are, and `out` must have
  /// space for that and set_bits_slack more. Not for more than 2²⁶ words.
  void (*write)(const std::uint64_t* words, std::size_t count, std::size_t set, std::uint32_t* out) noexcept;
};

struct GridFrame;
struct GridShaft;

/// Where the box of a shaft without end is when it has left all bounds behind: its faces, rounded.
struct ClippedEnd {
  float face[6];
  float in_frame[6];  ///< what of it is among the bounds, which the frame is to hold
};

/// How far the bounds of a tile reach on a grid.
struct TileExtent {
  std::int16_t least[6];  ///< coordinate of each stream
  bool any_above;         ///< whether a bound has a coordinate that was cut off above, but for those that have them all
};

/// A word of bounds some of which a grid leaves undecided.
struct UndecidedWord {
  std::uint64_t lanes;  ///< the undecided ones, and maybe others
  std::uint32_t word;   ///< its position in the row
  std::uint32_t shaft;  ///< a number that the caller of test() gave
};

/// Tests of the bounds of a tile by a group of shafts on a grid (kernel/kernels/grid/forming.hpp). Null where vectors
/// would not gain by it.
struct GridKernels {
  std::size_t fewest_shafts;  ///< that gain by it, and tests, by measurement (docs/measurements.md)
  std::size_t fewest_tests;

  /// Whether so many shafts gain by a grid with so many bounds.
  [[nodiscard]] bool pays(std::size_t shafts, std::size_t bounds) const noexcept {
    return shafts >= fewest_shafts && bounds >= (fewest_tests + shafts - 1) / shafts;
  }

  /// The frame around shafts, if there is one. Shafts without end are cut off where clipped[i] says; if that is null,
  /// they have no place on the grid.
  GridFrame (*frame)(const ShaftData* shafts, std::size_t count, const ClippedEnd* clipped) noexcept;
  /// Makes out[i] of shafts[i].
  void (*form_shafts)(const ShaftData* shafts, std::size_t count, const ClippedEnd* clipped, const GridFrame& frame,
                      GridShaft* out) noexcept;
  /// Writes `count` boxes' coordinates on the grid to six streams, aligned to 64 bytes, in whole words: a last one that
  /// the boxes do not fill is filled up by boxes that are outside of everything.
  void (*snap_boxes)(const GridFrame& frame, const float* const* box, std::size_t count,
                     std::int16_t* const* grid) noexcept;

  /// How far `words` words of bounds on the grid reach, more than none.
  TileExtent (*extent)(const std::int16_t* const* grid, std::size_t words) noexcept;

  /// Tests `words` words of bounds, at most most_block_words, on the grid. Writes their kept bits, 0 only for bounds
  /// that are certainly outside. Lists the words that hold undecided bounds, with `shaft` as their shaft's number, at
  /// `undecided`, which must have space for all. Returns how many it lists.
  std::size_t (*test)(const GridShaft& on_grid, const std::int16_t* const* grid, std::size_t words, std::uint64_t* kept,
                      std::uint32_t shaft, UndecidedWord* undecided) noexcept;

  /// Tests in floats what test() left undecided of the `count` boxes in `stream`, in `words` listed words: bits of row
  /// kept[u.shaft] of shaft[u.shaft].
  void (*resolve)(const ShaftData* const* shaft, const float* const* stream, std::size_t count,
                  const UndecidedWord* undecided, std::size_t words, std::uint64_t* const* kept) noexcept;

  /// The stages that follow, for `count` bounds, at most most_block_words words of them: added planes, spheres, and
  /// inside bits unless `inside` is null.
  using Finish = void(const ShaftData& shaft, const float* const* stream, std::size_t count, std::uint64_t* kept,
                      std::uint64_t* inside) noexcept;
  Finish* finish_boxes;
  Finish* finish_spheres;
};

struct Kernels {
  unsigned width;  ///< floats in a vector: 1, 4, 8 or 16
  Test* boxes;
  Test* spheres;
  Test* boxed_spheres;  ///< as spheres, with the streams of boxes_around_spheres() after their own
  KeepsOne* keeps_box;
  KeepsOne* keeps_sphere;
  ClassifyOne* classify_box;
  ClassifyOne* classify_sphere;
  BoxesAroundSpheres* boxes_around_spheres;
  GridKernels grid;
  CompilePair* compile_pair;
  CompileMoving* compile_swept;
  CompileMoving* compile_swept_infinite;
  CompileShadow* compile_endless_shadow;
  CompileFinite* compile_finite;
  AllFinite* all_finite;
  AllPlanesUsable* all_planes_usable;
  AddPlanes* add_planes;
  TestListedWords* listed_boxes;
  TestListedWords* listed_spheres;
  OcclusionKernels blocking;
  SiblingKernels siblings;
  RayKernels rays;
  /// Triangles, in nine streams, as shaftcull/triangles.hpp says; `inside` is null. Not exactly for a hull.
  Test* triangles_by_vertices;
  Test* triangles_exactly;
  CompressIndices* compress_indices;
  KeepLayers* keep_layers;
  NodeBounds* node_bounds_of_boxes;
  NodeBounds* node_bounds_of_spheres;
  BestNode* best_node;
  SplitKernels split;
  SetBits set_bits;

  [[nodiscard]] KeepsOne* keeps_one(const BoxView& /*box*/) const noexcept { return keeps_box; }
  [[nodiscard]] KeepsOne* keeps_one(const SphereView& /*sphere*/) const noexcept { return keeps_sphere; }
  [[nodiscard]] TestListedWords* listed(const BoxView& /*boxes*/) const noexcept { return listed_boxes; }
  [[nodiscard]] TestListedWords* listed(const SphereView& /*spheres*/) const noexcept { return listed_spheres; }
  [[nodiscard]] NodeBounds* node_bounds(const BoxView& /*boxes*/) const noexcept { return node_bounds_of_boxes; }
  [[nodiscard]] NodeBounds* node_bounds(const SphereView& /*spheres*/) const noexcept { return node_bounds_of_spheres; }
};

}  // namespace shaftcull::kernel
