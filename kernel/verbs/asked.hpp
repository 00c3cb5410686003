// SPDX-License-Identifier: MIT
/// A query, checked, and the way to its answers: a scan of streams, or walks through a tree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "compiled/shaft_data.hpp"
#include "flat/scan.hpp"
#include "kernels/kernel_table.hpp"
#include "query/bound_streams.hpp"
#include "query/options.hpp"
#include "query/question.hpp"
#include "shaftcull/query.hpp"
#include "tree/tree_query.hpp"

namespace shaftcull::kernel {

class Asked {
 public:
  /// For the verb `call`. Throws InvalidArgument and NeedsRefit as shaftcull/query.hpp says. Refers to all arguments.
  Asked(const char* call, std::span<const CompiledShaft> shafts, const Bounds& bounds, Question question,
        const Query& query, const Takes& takes);
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;

  [[nodiscard]] std::span<const ShaftData> shafts() const noexcept { return shafts_; }
  [[nodiscard]] const Options& options() const noexcept { return options_; }
  [[nodiscard]] const Kernels& kernels() const noexcept { return kernels_; }
  /// How many bounds there are, and words of their bits.
  [[nodiscard]] std::size_t size() const noexcept { return scanned_.streams.count; }
  [[nodiscard]] std::size_t row_words() const noexcept { return bit_words(size()); }
  [[nodiscard]] BoundKind kind() const noexcept { return scanned_.streams.kind; }

  /// The walks, if the bounds are a tree and all of them are asked about; otherwise null.
  [[nodiscard]] const TreeQuery* walks() const noexcept { return walks_; }
  /// Walks of first contact: those of a tree of such bounds, if walks() is not null.
  template <class Bound>
  [[nodiscard]] const BoundsQuery<Bound>* walks_of() const noexcept {
    return std::get_if<BoundsQuery<Bound>>(&query_);
  }
  /// The bounds to scan. Those of a tree are in tree order.
  [[nodiscard]] const ScannedBounds& scanned() const noexcept { return scanned_; }
  /// The scan of shaft s. Its `kept` are those of all bounds, or of the candidates.
  [[nodiscard]] Scan scan(std::size_t s) const noexcept {
    return {shafts_[s], scanned_, question_, options_, s, kernels_};
  }
  /// The counter (query/counters.hpp) when it has seen what shaft s keeps, by a scan or a walk.
  template <class AnyCounter>
  [[nodiscard]] AnyCounter counted(std::size_t s, AnyCounter counter) const {
    if (walks_ != nullptr) {
      walks_->walk(s, counter);
    } else {
      scan(s).scan(counter);
    }
    return counter;
  }
  [[nodiscard]] Question question() const noexcept { return question_; }

  /// Throws InvalidArgument for a view of more bounds than indices tell apart.
  void require_index_width() const;
  /// Throws InvalidArgument for spheres and triangles.
  void require_boxes() const;
  /// Throws InvalidArgument for triangles.
  void require_no_triangles() const;

 private:
  std::span<const ShaftData> shafts_;
  const Kernels& kernels_;
  Question question_;
  ScannedBounds scanned_;
  Options options_;
  std::variant<std::monostate, BoundsQuery<Box>, BoundsQuery<Sphere>, TriangleQuery> query_;
  const TreeQuery* walks_ = nullptr;
};

}  // namespace shaftcull::kernel
