// SPDX-License-Identifier: MIT
/// Bits of a tree by the user's indices, for one shaft and for many; and whether anything is kept at all.
#include <algorithm>

#include "parallel/parallel.hpp"
#include "support/index_range.hpp"
#include "tree/query.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::IndexBits;
using kernel::Question;
using kernel::task_shafts;

/// Calls use(s) for every shaft, in parallel, `each` of them in a task.
template <class Use>
void for_each_shaft(std::size_t shafts, std::size_t each, const Use& use) {
  kernel::parallel_for(kernel::chunk_count(shafts, each), 1, [&](std::size_t t, std::size_t) {
    const kernel::IndexRange task = kernel::chunk_at(shafts, each, t);
    for (std::size_t s = task.first; s != task.end(); ++s) use(s);
  });
}

/// A row of bits, all zero.
template <class Bound>
kernel::IndexBits empty_row(const kernel::Query<Bound>& query, std::uint64_t* words) {
  std::fill_n(words, query.row_words(), 0);
  return {query.indices(), words};
}

template <class Bound>
void write_kept(const kernel::Query<Bound>& query, std::size_t s, std::uint64_t* kept) {
  kernel::KeptLister visitor(empty_row(query, kept));
  query.walk(s, visitor);
}
template <class Bound>
void write_both(const kernel::Query<Bound>& query, std::size_t s, std::uint64_t* kept, std::uint64_t* inside) {
  kernel::KeptAndInsideLister visitor(empty_row(query, kept), empty_row(query, inside));
  query.walk(s, visitor);
}
template <class Bound>
void write_inside(const kernel::Query<Bound>& query, std::size_t s, std::uint64_t* inside) {
  kernel::InsideLister visitor(empty_row(query, inside));
  query.walk(s, visitor);
}
template <class Bound>
bool finds_any(const kernel::Query<Bound>& query, std::size_t s) {
  kernel::Finder visitor;
  query.walk(s, visitor);
  return visitor.is_done();
}

/// Checks bits that `call` writes; `name` is what its messages call them.
template <class Bound>
void require_bits(const kernel::Query<Bound>& query, const char* call, const char* name,
                  std::span<const std::uint64_t> words) {
  kernel::require_words(name, words, query.size());
  query.require_apart(call, name, kernel::bytes_of(words));
}
template <class Bound>
void require_rows(const kernel::Query<Bound>& query, const char* call, const char* name,
                  std::span<const std::uint64_t> words) {
  kernel::require_rows(name, words, query.shafts(), query.row_words());
  query.require_apart(call, name, kernel::bytes_of(words));
}

}  // namespace

template <class Bound>
void cull(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<std::uint64_t> kept,
          const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept, excluding);
  require_bits(query, "cull", "kept", kept);
  write_kept(query, 0, kept.data());
}

template <class Bound>
void classify(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<std::uint64_t> kept,
              std::span<std::uint64_t> inside, const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept_and_inside, excluding);
  require_bits(query, "classify", "kept", kept);
  require_bits(query, "classify", "inside", inside);
  kernel::require_apart("classify", "kept", kernel::bytes_of(kept), "inside", kernel::bytes_of(inside));
  write_both(query, 0, kept.data(), inside.data());
}

template <class Bound>
void contained(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<std::uint64_t> inside,
               const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::inside, excluding);
  require_bits(query, "contained", "inside", inside);
  write_inside(query, 0, inside.data());
}

template <class Bound>
bool any(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept, excluding);
  return finds_any(query, 0);
}

template <class Bound>
void cull_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, std::span<std::uint64_t> kept_rows,
               const Excluding& excluding) {
  const kernel::Query<Bound> query(shafts, tree, Question::kept, excluding);
  require_rows(query, "cull_many", "kept_rows", kept_rows);
  for_each_shaft(shafts.size(), task_shafts,
                 [&](std::size_t s) { write_kept(query, s, kept_rows.data() + s * query.row_words()); });
}

template <class Bound>
void classify_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                   std::span<std::uint64_t> kept_rows, std::span<std::uint64_t> inside_rows,
                   const Excluding& excluding) {
  const kernel::Query<Bound> query(shafts, tree, Question::kept_and_inside, excluding);
  require_rows(query, "classify_many", "kept_rows", kept_rows);
  require_rows(query, "classify_many", "inside_rows", inside_rows);
  kernel::require_apart("classify_many", "kept_rows", kernel::bytes_of(kept_rows), "inside_rows",
                        kernel::bytes_of(inside_rows));
  for_each_shaft(shafts.size(), task_shafts, [&](std::size_t s) {
    const std::size_t first = s * query.row_words();
    write_both(query, s, kept_rows.data() + first, inside_rows.data() + first);
  });
}

template <class Bound>
void contained_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                    std::span<std::uint64_t> inside_rows, const Excluding& excluding) {
  const kernel::Query<Bound> query(shafts, tree, Question::inside, excluding);
  require_rows(query, "contained_many", "inside_rows", inside_rows);
  for_each_shaft(shafts.size(), task_shafts,
                 [&](std::size_t s) { write_inside(query, s, inside_rows.data() + s * query.row_words()); });
}

template <class Bound>
void any_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, std::span<std::uint64_t> any,
              const Excluding& excluding) {
  const kernel::Query<Bound> query(shafts, tree, Question::kept, excluding);
  kernel::require_shaft_bits("any", any, shafts.size());
  query.require_apart("any_many", "any", kernel::bytes_of(any));
  for_each_shaft(any.size(), 1, [&](std::size_t w) {  // a task for each word, so that no two share one
    std::uint64_t bits = 0;
    for (std::size_t s = 64 * w; s != std::min(shafts.size(), 64 * (w + 1)); ++s) {
      bits |= std::uint64_t{finds_any(query, s)} << s % 64;
    }
    any[w] = bits;
  });
}

#define SHAFTCULL_QUERIES(Bound)                                                                                       \
  template void cull(const CompiledShaft&, const BoundsTree<Bound>&, std::span<std::uint64_t>, const Excluding&);      \
  template void classify(const CompiledShaft&, const BoundsTree<Bound>&, std::span<std::uint64_t>,                     \
                         std::span<std::uint64_t>, const Excluding&);                                                  \
  template void contained(const CompiledShaft&, const BoundsTree<Bound>&, std::span<std::uint64_t>, const Excluding&); \
  template bool any(const CompiledShaft&, const BoundsTree<Bound>&, const Excluding&);                                 \
  template void cull_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, std::span<std::uint64_t>,          \
                          const Excluding&);                                                                           \
  template void classify_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, std::span<std::uint64_t>,      \
                              std::span<std::uint64_t>, const Excluding&);                                             \
  template void contained_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, std::span<std::uint64_t>,     \
                               const Excluding&);                                                                      \
  template void any_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, std::span<std::uint64_t>,           \
                         const Excluding&);
SHAFTCULL_QUERIES(Box)
SHAFTCULL_QUERIES(Sphere)
#undef SHAFTCULL_QUERIES

}  // namespace shaftcull
