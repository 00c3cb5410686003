// SPDX-License-Identifier: MIT
// Hashes of answers, for JavaScript: conformance/hashes.
#include "hashes/hashes.hpp"

#include <cstdint>
#include <span>

namespace {

using shaftcull::hashes::Family;

const Family& family_at(std::uint32_t family) { return shaftcull::hashes::families()[family]; }

}  // namespace

// Positions are those of families() and of their ways; JavaScript keeps them in range.
extern "C" {

[[clang::export_name("hash_families")]] std::uint32_t hash_families() {
  return static_cast<std::uint32_t>(shaftcull::hashes::families().size());
}

[[clang::export_name("hash_family_name")]] const char* hash_family_name(std::uint32_t family) {
  return family_at(family).name;
}

[[clang::export_name("hash_family_what")]] const char* hash_family_what(std::uint32_t family) {
  return family_at(family).what;
}

[[clang::export_name("hash_ways")]] std::uint32_t hash_ways(std::uint32_t family) {
  return static_cast<std::uint32_t>(family_at(family).ways.size());
}

[[clang::export_name("hash_way_name")]] const char* hash_way_name(std::uint32_t family, std::uint32_t way) {
  return shaftcull::hashes::name(family_at(family).ways[way]);
}

[[clang::export_name("hash_of")]] std::uint64_t hash_of(std::uint32_t family, std::uint32_t way, std::uint32_t quick) {
  const Family& asked = family_at(family);
  return asked.hash_of(quick != 0 ? asked.few : asked.many, asked.ways[way]);
}

[[clang::export_name("hash_on_record")]] std::uint64_t hash_on_record(std::uint32_t family, std::uint32_t quick) {
  const Family& asked = family_at(family);
  return quick != 0 ? asked.hash_of_few : asked.hash_of_many;
}

}  // extern "C"
