// SPDX-License-Identifier: MIT
#include "batch/input_hash.hpp"

#include <algorithm>
#include <vector>

#include "batch/parallel.hpp"

namespace shaftcull::batch {
namespace {
constexpr std::uint64_t bytes_a_piece = std::uint64_t{16} << 20;
}

Fingerprint hash_of(const ArrayFile& array, Ranks& ranks,
                    const std::function<void(const std::function<void()>&)>& on_threads) {
  const std::uint64_t rows = std::max<std::uint64_t>(bytes_a_piece / array.row_bytes(), 1);
  const std::uint64_t pieces = array.rows() / rows + (array.rows() % rows != 0 ? 1 : 0);
  // Shape and type, then a fingerprint a piece: those of other ranks are 0 here, until all are added.
  std::vector<std::uint64_t> parts(static_cast<std::size_t>(2 * pieces));
  const auto size = static_cast<std::uint64_t>(ranks.size());
  const auto own = static_cast<std::uint64_t>(ranks.rank());
  const auto hash_pieces = [&] {
    const std::uint64_t pieces_here = pieces / size + (own < pieces % size ? 1 : 0);
    for_chunks(static_cast<std::size_t>(pieces_here), 1, [&](std::size_t i, std::size_t /*one*/) {
      const std::uint64_t piece = own + i * size;
      std::vector<std::byte> scratch;
      const std::uint64_t first = piece * rows;
      const Fingerprint found = fingerprint(array.read(first, std::min(rows, array.rows() - first), scratch));
      std::ranges::copy(found, parts.begin() + static_cast<std::ptrdiff_t>(2 * piece));
    });
  };
  on_all(ranks, [&] { on_threads(hash_pieces); });
  ranks.sum(parts);
  parts.insert(parts.end(), {array.rows(), array.columns(), static_cast<std::uint64_t>(array.number())});
  return fingerprint(std::as_bytes(std::span(parts)));
}

}  // namespace shaftcull::batch
