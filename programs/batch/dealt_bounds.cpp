// SPDX-License-Identifier: MIT
#include "batch/dealt_bounds.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "batch/parallel.hpp"
#include "shaftcull/geometry.hpp"

namespace shaftcull::batch {
namespace {

constexpr std::size_t least_in_task = std::size_t{1} << 14;

/// What a stretch has of a share.
struct Piece {
  std::uint64_t count;   ///< of its bounds
  std::uint64_t floats;  ///< checksum of their floats
  std::uint64_t places;  ///< … and of their places
};

struct Stretch {
  std::vector<Piece> pieces;          ///< of each share
  std::vector<std::uint64_t> sum;     ///< one checksum, of these
  std::vector<float> floats;          ///< piece after piece
  std::vector<std::uint32_t> places;  ///< in the stretch, likewise

  static auto arrays(const Stretch& stretch) {
    return std::tie(stretch.pieces, stretch.sum, stretch.floats, stretch.places);
  }
};

template <class Number>
std::uint64_t checksum_of(std::span<const Number> numbers) noexcept {
  return checksum(std::as_bytes(numbers));
}

template <class Number>
std::span<const Number> numbers_in(std::span<const std::byte> bytes) noexcept {
  return {reinterpret_cast<const Number*>(bytes.data()), bytes.size() / sizeof(Number)};
}

}  // namespace

DealtBounds::DealtBounds(const BoundsSource& bounds, const PlannedShares& plan, const std::string& folder,
                         const Fingerprint& job, int rank)
    : bounds_(bounds), plan_(plan), folder_(folder + "/bounds"), store_(folder_, job, rank) {}

std::uint64_t DealtBounds::stretches() const noexcept {
  return (bounds_.size() + plan_.bounds_a_stretch - 1) / plan_.bounds_a_stretch;
}

std::vector<std::uint64_t> DealtBounds::missing(Ranks& ranks) {
  std::vector<std::uint64_t> all(static_cast<std::size_t>(stretches()));
  std::iota(all.begin(), all.end(), 0U);
  return missing_blocks(store_, all, ranks);
}

void DealtBounds::store(std::uint64_t stretch) const {
  const std::uint64_t first = stretch * plan_.bounds_a_stretch;
  const auto size = static_cast<std::size_t>(std::min(plan_.bounds_a_stretch, bounds_.size() - first));
  const std::size_t shares = plan_.count();
  const std::size_t columns = bounds_.array().columns();
  std::vector<std::byte> scratch;
  const float* const floats = bounds_.read(first, size, scratch).data();

  // Each task counts what its bounds add to each share; then it is known where they go, in the order of the file.
  const std::size_t task = std::max(least_in_task, 16 * shares);
  const std::size_t tasks = (size + task - 1) / task;
  std::vector<std::uint32_t> share_of(size);
  std::vector<std::uint32_t> next(tasks * shares);
  for_chunks(size, task, [&](std::size_t begin, std::size_t some) {
    std::uint32_t* const count = next.data() + begin / task * shares;
    for (std::size_t i = begin; i != begin + some; ++i) {
      const ShareKey key{middle_of(bounds_.box_around(floats + i * columns)), first + i};
      share_of[i] = static_cast<std::uint32_t>(plan_.cuts.share_of(key));
      ++count[share_of[i]];
    }
  });
  Stretch dealt{std::vector<Piece>(shares), std::vector<std::uint64_t>(1), std::vector<float>(size * columns),
                std::vector<std::uint32_t>(size)};
  std::vector<std::size_t> begins(shares + 1);
  std::size_t begin = 0;
  for (std::size_t share = 0; share != shares; ++share) {
    begins[share] = begin;
    for (std::size_t t = 0; t != tasks; ++t) {
      std::uint32_t& here = next[t * shares + share];
      begin += std::exchange(here, static_cast<std::uint32_t>(begin));
    }
  }
  begins[shares] = begin;
  for_chunks(size, task, [&](std::size_t from, std::size_t some) {
    std::uint32_t* const to = next.data() + from / task * shares;
    for (std::size_t i = from; i != from + some; ++i) {
      const std::size_t at = to[share_of[i]]++;
      std::copy_n(floats + i * columns, columns, dealt.floats.data() + at * columns);
      dealt.places[at] = static_cast<std::uint32_t>(i);
    }
  });
  for_chunks(shares, 1, [&](std::size_t share, std::size_t /*one*/) {
    const std::size_t at = begins[share];
    const std::size_t count = begins[share + 1] - at;
    dealt.pieces[share] = {count,
                           checksum_of(std::span<const float>(dealt.floats).subspan(at * columns, count * columns)),
                           checksum_of(std::span<const std::uint32_t>(dealt.places).subspan(at, count))};
  });
  dealt.sum[0] = checksum_of(std::span<const Piece>(dealt.pieces));
  store_.write(0, stretch, dealt);
}

ShareBounds DealtBounds::of(std::uint64_t share) const {
  const auto which = static_cast<std::size_t>(share);
  const std::size_t columns = bounds_.array().columns();
  ShareBounds kept{{}, {}, box_around(std::span<const Vec3>())};
  kept.floats.reserve(static_cast<std::size_t>(plan_.sizes[which]) * columns);
  kept.positions.reserve(static_cast<std::size_t>(plan_.sizes[which]));
  // Only what is read is compared with its checksum.
  const auto add = [&](const MappedBlock& block, std::uint64_t stretch) {
    const auto pieces = numbers_in<Piece>(block.array(0));
    const auto sum = numbers_in<std::uint64_t>(block.array(1));
    const auto floats = numbers_in<float>(block.array(2));
    const auto places = numbers_in<std::uint32_t>(block.array(3));
    if (pieces.size() != plan_.count() || sum.size() != 1 || sum[0] != checksum_of(pieces)) return false;
    std::size_t at = 0;
    for (std::size_t s = 0; s != which; ++s) at += static_cast<std::size_t>(pieces[s].count);
    const auto count = static_cast<std::size_t>(pieces[which].count);
    if (at + count > places.size() || places.size() * columns != floats.size()) return false;
    const auto own = floats.subspan(at * columns, count * columns);
    const auto own_places = places.subspan(at, count);
    if (checksum_of(own) != pieces[which].floats || checksum_of(own_places) != pieces[which].places) return false;
    kept.floats.insert(kept.floats.end(), own.begin(), own.end());
    for (const std::uint32_t place : own_places) {
      kept.positions.push_back(stretch * plan_.bounds_a_stretch + place);
    }
    return true;
  };
  for (std::uint64_t stretch = 0; stretch != stretches(); ++stretch) {
    const std::optional<MappedBlock> block = store_.map(0, stretch, BlockStore::Check::header);
    if (block && add(*block, stretch)) continue;
    store_.give_up(0, stretch);
  }
  for (std::size_t i = 0; i != kept.positions.size(); ++i) {
    kept.box = joined(kept.box, bounds_.box_around(kept.floats.data() + i * columns));
  }
  return kept;
}

void DealtBounds::remove() const noexcept {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace shaftcull::batch
