// SPDX-License-Identifier: MIT
/// Hashes of answers, by family: the same on every processor, by every compiler, and on record.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shaftcull/isa.hpp"

namespace shaftcull::hashes {

/// How a question is asked: with one shaft in either form, or with many shafts in parallel.
enum class Way : std::uint8_t { slab, planes, many };

/// Questions of one kind about made-up cases, which follow from integers and are the same everywhere.
struct Family {
  const char* name;                                         ///< as the program prints it
  const char* what;                                         ///< what is asked
  std::span<const Way> ways;                                ///< all of which give the same hash
  std::uint64_t (*hash_of)(std::uint64_t scenes, Way way);  ///< of the answers, on the instruction set in use
  std::uint64_t few;                                        ///< scenes of a quick look: some 10,000 cases or more
  std::uint64_t many;                                       ///< scenes of a whole one: a million cases
  std::uint64_t hash_of_few;                                ///< on record
  std::uint64_t hash_of_many;                               ///< likewise
};

/// All of them. Exact answers do not change: if a hash differs from the record, an answer was or is wrong.
[[nodiscard]] std::span<const Family> families() noexcept;

/// A hash that is not the one on record.
struct Deviation {
  Isa isa;
  Way way;
  std::uint64_t hash;
};

/// Asks about the cases of a family in all ways, on instruction sets that this machine has, and tells which hashes are
/// not on record: none, if all is well. The first cases only for a quick look. The set in use stays the same.
[[nodiscard]] std::vector<Deviation> deviations(const Family& family, bool quick, std::span<const Isa> isas);

/// "slab form", "plane form", "many shafts".
[[nodiscard]] const char* name(Way way) noexcept;

// What they are made of.
std::uint64_t between_boxes(std::uint64_t scenes, Way way);
std::uint64_t between_boxes_open(std::uint64_t scenes, Way way);
std::uint64_t moving_boxes(std::uint64_t scenes, Way way);
std::uint64_t moving_boxes_open(std::uint64_t scenes, Way way);
std::uint64_t convex_hulls(std::uint64_t scenes, Way way);
std::uint64_t convex_hulls_open(std::uint64_t scenes, Way way);
std::uint64_t triangles_of_hulls(std::uint64_t scenes, Way way);
std::uint64_t polygon_shafts(std::uint64_t scenes, Way way);
std::uint64_t triangles_by_vertices(std::uint64_t scenes, Way way);
std::uint64_t triangles_exactly(std::uint64_t scenes, Way way);
std::uint64_t what_blocks(std::uint64_t scenes, Way way);
std::uint64_t first_contacts(std::uint64_t scenes, Way way);
std::uint64_t contact_normals(std::uint64_t scenes, Way way);
std::uint64_t box_trees(std::uint64_t scenes, Way way);
std::uint64_t sphere_trees(std::uint64_t scenes, Way way);
std::uint64_t triangle_trees(std::uint64_t scenes, Way way);
std::uint64_t sights(std::uint64_t scenes, Way way);
std::uint64_t facet_sights(std::uint64_t scenes, Way way);
std::uint64_t solids(std::uint64_t scenes, Way way);
std::uint64_t found_solids(std::uint64_t scenes, Way way);

}  // namespace shaftcull::hashes
