// SPDX-License-Identifier: MIT
/// What public calls check before they write anything: null and shared memory, sizes, indices and enumerators. Whether
/// a shaft was formed, compiled/answers.hpp checks.
///
/// Every check throws InvalidArgument with a message that names the argument, its value and what would be right. The
/// messages are made in arguments.cpp, so that a call pays for comparisons only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <tuple>

#include "shaftcull/cull.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/triangles.hpp"
#include "support/overlap.hpp"

namespace shaftcull::kernel {

[[noreturn]] void refuse_null(const char* what, std::size_t size, const char* noun);
[[noreturn]] void refuse_view(const char* noun, std::span<const float* const> streams, std::size_t count);
[[noreturn]] void refuse_form(Form form);
[[noreturn]] void refuse_contact(Contact contact);
[[noreturn]] void refuse_triangle_test(const char* what, TriangleTest test);
[[noreturn]] void refuse_words(const char* what, std::size_t size, std::size_t bounds);
[[noreturn]] void refuse_rows(const char* what, std::size_t size, std::size_t shafts, std::size_t row_words);
[[noreturn]] void refuse_counts(const char* what, std::size_t size, std::size_t shafts);
[[noreturn]] void refuse_shaft_bits(const char* what, std::size_t size, std::size_t shafts);
[[noreturn]] void refuse_index_width(const char* call, std::size_t bounds);
[[noreturn]] void refuse_shared_memory(const char* call, const char* one, const char* other);
[[noreturn]] void refuse_index(const char* what, std::size_t position, std::uint64_t index, std::size_t bounds);

[[noreturn]] void refuse_bound(const char* noun, std::size_t i, const std::string& why);
[[noreturn]] void refuse_order(const char* noun, std::size_t i, std::size_t axis, float lo, float hi);

/// More floats than one array can have.
inline constexpr std::size_t most_floats = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(float);

/// The span called `what`, of things called `noun` in the plural, is not null unless it is empty.
template <class T>
void require_memory(const char* what, std::span<T> span, const char* noun) {
  if (span.data() == nullptr && !span.empty()) [[unlikely]]
    refuse_null(what, span.size(), noun);
}

/// The records of the user's own bounds, called `noun` in the plural, which are not null unless there are none.
template <class Bound>
auto required_records(std::span<const Bound> bounds, const char* noun) {
  require_memory(noun, bounds, noun);
  return strided(bounds);
}

/// What messages call the bounds of a view, by how many streams it has.
template <class View>
inline constexpr const char* bounds_noun = std::tuple_size_v<decltype(View::stream)> == 4   ? "spheres"
                                           : std::tuple_size_v<decltype(View::stream)> == 6 ? "boxes"
                                                                                            : "triangles";

/// All streams of the view are there, and its count is one that memory can hold.
template <class View>
void require_view(const View& view) {
  bool null = false;
  for (const float* stream : view.stream) null |= stream == nullptr;
  if ((null && view.count != 0) || view.count > most_floats) [[unlikely]] {
    refuse_view(bounds_noun<View>, view.stream, view.count);
  }
}

/// The i-th of the boxes called `noun` is finite with lo ≤ hi. In modes in which denormals are what they are.
inline void require_usable_box(const Box& box, const char* noun, std::size_t i) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (!std::isfinite(box.lo[k]) || !std::isfinite(box.hi[k])) [[unlikely]]
      refuse_bound(noun, i, "is not finite");
    if (box.lo[k] > box.hi[k]) [[unlikely]]
      refuse_order(noun, i, k, box.lo[k], box.hi[k]);
  }
}

/// The test called `what` is one.
inline void require_triangle_test(const char* what, TriangleTest test) {
  if (test > TriangleTest::vertices) [[unlikely]]
    refuse_triangle_test(what, test);
}

inline void require_form(Form form) {
  if (form > Form::planes) [[unlikely]]
    refuse_form(form);
}

inline void require_contact(Contact contact) {
  if (contact > Contact::open) [[unlikely]]
    refuse_contact(contact);
}

/// The span called `what` holds exactly the answers of so many bounds.
inline void require_words(const char* what, std::span<const std::uint64_t> words, std::size_t bounds) {
  if (words.size() != bit_words(bounds)) [[unlikely]]
    refuse_words(what, words.size(), bounds);
  require_memory(what, words, "words");
}

/// The span called `what` holds exactly `shafts` rows of `row_words` words.
inline void require_rows(const char* what, std::span<const std::uint64_t> words, std::size_t shafts,
                         std::size_t row_words) {
  const bool overflows = row_words != 0 && shafts > std::numeric_limits<std::size_t>::max() / row_words;
  if (overflows || words.size() != shafts * row_words) [[unlikely]] {
    refuse_rows(what, words.size(), shafts, row_words);
  }
  require_memory(what, words, "words");
}

/// The span called `what` has one count for each shaft.
template <class Count>
void require_counts(const char* what, std::span<Count> counts, std::size_t shafts) {
  if (counts.size() != shafts) [[unlikely]]
    refuse_counts(what, counts.size(), shafts);
  require_memory(what, counts, "counts");
}

/// The span called `what` has exactly the words of one bit a shaft.
inline void require_shaft_bits(const char* what, std::span<const std::uint64_t> words, std::size_t shafts) {
  if (words.size() != bit_words(shafts)) [[unlikely]]
    refuse_shaft_bits(what, words.size(), shafts);
  require_memory(what, words, "words");
}

/// Indices of 32 bits number so many bounds, and leave one index that is none.
inline void require_index_width(const char* call, std::size_t bounds) {
  if (bounds > std::numeric_limits<std::uint32_t>::max()) [[unlikely]]
    refuse_index_width(call, bounds);
}

/// What `call` writes, and what else it writes or reads, share no memory. `one` and `other` are their names.
inline void require_apart(const char* call, const char* one, std::span<const std::byte> one_bytes, const char* other,
                          std::span<const std::byte> other_bytes) {
  if (overlap(one_bytes, other_bytes)) [[unlikely]]
    refuse_shared_memory(call, one, other);
}

/// The span called `what` is there, and holds indices of so many bounds.
inline void require_below(const char* what, std::span<const std::uint32_t> indices, std::size_t bounds) {
  require_memory(what, indices, "indices");
  std::uint32_t most = 0;
  for (const std::uint32_t index : indices) most = std::max(most, index);  // no early end: this loop becomes vectors
  if (indices.empty() || most < bounds) return;
  std::size_t bad = 0;
  while (indices[bad] < bounds) ++bad;
  refuse_index(what, bad, indices[bad], bounds);
}

}  // namespace shaftcull::kernel
