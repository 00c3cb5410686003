// SPDX-License-Identifier: MIT
/// Options of a query, drawn at random, and the part of the truth that they leave.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "options/scenes.hpp"
#include "options/truth.hpp"
#include "oracle/random.hpp"
#include "shaftcull/query.hpp"

namespace shaftcull {

/// Options that a case may have, as bits.
struct Options {
  static constexpr unsigned exclude = 1;
  static constexpr unsigned exclude_each = 2;
  static constexpr unsigned exclude_mask = 4;
  static constexpr unsigned layer_mask = 8;
  static constexpr unsigned limit = 16;
  static constexpr unsigned only = 32;
  static constexpr unsigned all = 63;
};

/// Numbers in braces: at least one, at most eight.
inline Numbers in_braces(const Indices& n) {
  switch (n.size()) {
    case 1:
      return {n[0]};
    case 2:
      return {n[0], n[1]};
    case 3:
      return {n[0], n[1], n[2]};
    case 4:
      return {n[0], n[1], n[2], n[3]};
    case 5:
      return {n[0], n[1], n[2], n[3], n[4]};
    case 6:
      return {n[0], n[1], n[2], n[3], n[4], n[5]};
    case 7:
      return {n[0], n[1], n[2], n[3], n[4], n[5], n[6]};
    default:
      return {n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]};
  }
}

/// Lists of one shaft, in their order.
struct ShaftLists {
  Indices kept;
  Indices overlap;
  Indices inside;
};

/// The options of a query of many shafts, and of one of them alone. The queries refer to memory of this object.
class QueryCase {
 public:
  /// With none of the options that `allowed` has, one of them or several.
  QueryCase(Random& random, const Truth& truth, unsigned allowed, TriangleTest test = TriangleTest::exact)
      : shafts_(truth.shafts()), test_(test) {
    const unsigned kind = random.below(8);
    const unsigned drawn = kind == 0 ? 0 : kind < 4 ? 1U << random.below(6) : random.below(64);
    const unsigned options = drawn & allowed;
    const auto bounds = static_cast<unsigned>(truth.bounds());
    const auto some_shaft = [&] { return random.below(static_cast<unsigned>(shafts_)); };
    // Half of the indices are of bounds that a shaft keeps, where one more or less shows.
    const auto some_bound = [&](std::size_t shaft) {
      const Indices& kept = truth.kept(shaft);
      return !kept.empty() && random.one_in(2) ? kept[random.below(static_cast<unsigned>(kept.size()))]
                                               : random.below(bounds);
    };
    if ((options & Options::exclude) != 0 && bounds != 0) {
      exclude_.resize(random.below(13));
      for (std::uint32_t& index : exclude_) index = some_bound(some_shaft());
      is_in_braces_ = random.one_in(2) && !exclude_.empty() && exclude_.size() <= Numbers::most_in_braces;
    }
    if ((options & Options::exclude_each) != 0 && bounds != 0) {
      row_ = random.below(4);
      for (std::size_t i = 0; i != shafts_ * row_; ++i) exclude_each_.push_back(some_bound(i / row_));
    }
    if ((options & Options::exclude_mask) != 0) draw_mask(random, bounds);
    if ((options & Options::layer_mask) != 0) {
      layer_mask_.resize(random.one_in(2) ? 1 : shafts_);
      for (std::uint32_t& mask : layer_mask_) {
        mask = random.one_in(8) ? 0 : random.one_in(4) ? ~0U : random.one_in(2) ? 0x00ff00ffU : 1U << random.below(32);
      }
    }
    if ((options & Options::limit) != 0) {
      const std::size_t kept = truth.kept(some_shaft()).size();
      const std::size_t limits[] = {0,    1,        random.below(20),   kept / 2,
                                    kept, kept + 1, truth.bounds() + 5, Query::no_limit - 1};
      limit_ = limits[random.below(8)];
    }
    if ((options & Options::only) != 0) draw_candidates(random, truth, some_shaft(), some_bound);
  }
  QueryCase(const QueryCase&) = delete;
  QueryCase& operator=(const QueryCase&) = delete;

  [[nodiscard]] bool asks_for_layers() const { return !layer_mask_.empty(); }

  /// The query of all shafts.
  [[nodiscard]] Query of_all() const {
    Query query;
    query.exclude = is_in_braces_ ? in_braces(exclude_) : Numbers(exclude_);
    query.exclude_each = exclude_each_;
    query.exclude_mask = exclude_mask_;
    query.layer_mask = layer_mask_;
    query.limit = limit_;
    if (only_) query.only = std::span<const std::uint32_t>(*only_);
    query.triangle_test = test_;
    return query;
  }
  /// The query of one of them.
  [[nodiscard]] Query of_one(std::size_t shaft) const {
    Query query = of_all();
    query.exclude_each = std::span<const std::uint32_t>(exclude_each_).subspan(shaft * row_, row_);
    if (!layer_mask_.empty()) query.layer_mask = layer_mask_of(shaft);
    return query;
  }

  /// The answers of the shaft without a limit, bound by bound in this order.
  [[nodiscard]] ShaftLists lists(const Truth& truth, std::span<const std::uint32_t> layers, std::size_t shaft,
                                 std::span<const std::uint32_t> order) const {
    ShaftLists lists;
    for (const std::uint32_t i : only_ ? std::span<const std::uint32_t>(*only_) : order) {
      const Answer answer = truth(shaft, i);
      if (answer == Answer::outside || leaves_out(shaft, i, layers)) continue;
      lists.kept.push_back(i);
      (answer == Answer::inside ? lists.inside : lists.overlap).push_back(i);
    }
    return lists;
  }

  /// For messages.
  [[nodiscard]] std::string text() const {
    std::string words = "options:";
    const auto say = [&](bool is_there, const char* name, std::size_t number) {
      if (is_there) words += " " + std::string(name) + " " + std::to_string(number);
    };
    say(!exclude_.empty(), is_in_braces_ ? "exclude in braces" : "exclude", exclude_.size());
    say(row_ != 0, "exclude_each", row_);
    say(!exclude_mask_.empty(), "exclude_mask of words", exclude_mask_.size());
    say(!layer_mask_.empty(), "layer masks", layer_mask_.size());
    say(limit_ != Query::no_limit, "limit", limit_);
    say(only_.has_value(), "candidates", only_ ? only_->size() : 0);
    say(test_ == TriangleTest::vertices, "triangle test", static_cast<std::size_t>(test_));
    return words;
  }

 private:
  /// All words are zero, few bits are set, most are or all are. Bits past the last bound mean nothing.
  void draw_mask(Random& random, unsigned bounds) {
    exclude_mask_.resize(bit_words(bounds));
    const unsigned density = random.below(4);
    for (std::uint64_t& word : exclude_mask_) {
      for (unsigned bit = 0; bit != 64 && density != 0; ++bit) {
        const bool is_set = density == 1 ? random.one_in(32) : density == 2 ? !random.one_in(4) : true;
        word |= std::uint64_t{is_set} << bit;
      }
    }
  }

  template <class SomeBound>
  void draw_candidates(Random& random, const Truth& truth, std::size_t shaft, const SomeBound& some_bound) {
    Indices& candidates = only_.emplace();
    const auto bounds = static_cast<unsigned>(truth.bounds());
    if (bounds == 0) return;
    switch (random.below(6)) {
      case 0:  // none
        break;
      case 1:  // those of another shaft
        candidates = truth.kept(shaft);
        break;
      case 2: {  // ascending
        const unsigned share = 1 + random.below(8);
        for (std::uint32_t i = 0; i != bounds; ++i) {
          if (random.one_in(share)) candidates.push_back(i);
        }
        break;
      }
      case 3:  // all, descending
        for (std::uint32_t i = bounds; i != 0; --i) candidates.push_back(i - 1);
        break;
      case 4: {  // in no order, some more than once
        const unsigned most = std::min(2 * bounds, 3000U);
        candidates.resize(1 + random.below(most));
        for (std::uint32_t& index : candidates) index = some_bound(shaft);
        break;
      }
      default:  // one of them again and again, and another
        candidates.assign(1 + random.below(200), some_bound(shaft));
        candidates.push_back(some_bound(shaft));
        break;
    }
  }

  [[nodiscard]] std::uint32_t layer_mask_of(std::size_t shaft) const {
    return layer_mask_[layer_mask_.size() == 1 ? 0 : shaft];
  }

  [[nodiscard]] bool leaves_out(std::size_t shaft, std::uint32_t i, std::span<const std::uint32_t> layers) const {
    const auto row = exclude_each_.begin() + static_cast<std::ptrdiff_t>(shaft * row_);
    const auto end_of_row = row + static_cast<std::ptrdiff_t>(row_);
    return std::find(exclude_.begin(), exclude_.end(), i) != exclude_.end() ||
           std::find(row, end_of_row, i) != end_of_row ||
           (!exclude_mask_.empty() && (exclude_mask_[i / 64] >> i % 64 & 1) != 0) ||
           (!layer_mask_.empty() && (layers[i] & layer_mask_of(shaft)) == 0);
  }

  std::size_t shafts_;
  TriangleTest test_;
  Indices exclude_;
  bool is_in_braces_ = false;
  Indices exclude_each_;
  std::size_t row_ = 0;  // indices of exclude_each for each shaft
  std::vector<std::uint64_t> exclude_mask_;
  Indices layer_mask_;
  std::size_t limit_ = Query::no_limit;
  std::optional<Indices> only_;
};

/// A query without its limit, for verbs that take none.
inline Query unlimited(Query query) {
  query.limit = Query::no_limit;
  return query;
}

/// The first of them, as many as the limit of the query lets through.
inline Indices limited(const Indices& results, const Query& query) {
  const auto size = static_cast<std::ptrdiff_t>(std::min(results.size(), query.limit));
  return {results.begin(), results.begin() + size};
}

/// The bits of indices of `bounds` bounds.
inline std::vector<std::uint64_t> bits_of(const Indices& indices, std::size_t bounds) {
  std::vector<std::uint64_t> bits(bit_words(bounds));
  for (const std::uint32_t index : indices) bits[index / 64] |= std::uint64_t{1} << index % 64;
  return bits;
}

}  // namespace shaftcull
