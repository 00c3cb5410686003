// SPDX-License-Identifier: MIT
/// cull_many(), classify_many() and contained_many(): every task writes its words straight into the user's rows.
#include "flat/batch_job.hpp"
#include "parallel/parallel.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull {
namespace {

template <class View>
void write_bits(const kernel::BatchJob<View>& job, std::uint64_t* kept, std::uint64_t* inside) {
  const kernel::Tiling tiling = kernel::Tiling::unordered(job.bounds(), job.shafts());
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const kernel::IndexRange block = tiling.block(b);
    const kernel::IndexRange group = tiling.group(g);
    const kernel::Rows all_kept{kept, job.row_words()};
    const kernel::Rows all_inside{inside, job.row_words()};
    job.test(block, group, all_kept.from(group.first * job.row_words() + block.first / 64),
             all_inside.from(group.first * job.row_words() + block.first / 64));
  });
}

template <class View>
void cull_rows(std::span<const CompiledShaft> shafts, const View& bounds, std::span<std::uint64_t> kept) {
  const kernel::BatchJob<View> job(shafts, bounds, kernel::Bits::kept);
  kernel::require_rows("kept_rows", kept, shafts.size(), job.row_words());
  write_bits(job, kept.data(), nullptr);
}

template <class View>
void classify_rows(std::span<const CompiledShaft> shafts, const View& bounds, std::span<std::uint64_t> kept,
                   std::span<std::uint64_t> inside) {
  const kernel::BatchJob<View> job(shafts, bounds, kernel::Bits::kept_and_inside);
  kernel::require_rows("kept_rows", kept, shafts.size(), job.row_words());
  kernel::require_rows("inside_rows", inside, shafts.size(), job.row_words());
  kernel::require_apart("classify_many", "kept_rows", kernel::bytes_of(kept), "inside_rows", kernel::bytes_of(inside));
  write_bits(job, kept.data(), inside.data());
}

template <class View>
void contained_rows(std::span<const CompiledShaft> shafts, const View& bounds, std::span<std::uint64_t> inside) {
  const kernel::BatchJob<View> job(shafts, bounds, kernel::Bits::inside);
  kernel::require_rows("inside_rows", inside, shafts.size(), job.row_words());
  write_bits(job, nullptr, inside.data());
}

}  // namespace

void cull_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::span<std::uint64_t> kept_rows) {
  cull_rows(shafts, boxes, kept_rows);
}

void cull_many(std::span<const CompiledShaft> shafts, const SphereView& spheres, std::span<std::uint64_t> kept_rows) {
  cull_rows(shafts, spheres, kept_rows);
}

void classify_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::span<std::uint64_t> kept_rows,
                   std::span<std::uint64_t> inside_rows) {
  classify_rows(shafts, boxes, kept_rows, inside_rows);
}

void classify_many(std::span<const CompiledShaft> shafts, const SphereView& spheres, std::span<std::uint64_t> kept_rows,
                   std::span<std::uint64_t> inside_rows) {
  classify_rows(shafts, spheres, kept_rows, inside_rows);
}

void contained_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::span<std::uint64_t> inside_rows) {
  contained_rows(shafts, boxes, inside_rows);
}

void contained_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                    std::span<std::uint64_t> inside_rows) {
  contained_rows(shafts, spheres, inside_rows);
}

}  // namespace shaftcull
