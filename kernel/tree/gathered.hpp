/// Streams as records: sorting reads bounds from all over memory, and a record is in one place, not in six.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "run/cut.hpp"
#include "run/parallel.hpp"
#include "shaftcull/tree.hpp"
#include "tree/source.hpp"

namespace shaftcull::kernel {

template <class Bound>
class Gathered {
 public:
  explicit Gathered(const ViewOf<Bound>& view)
      : bounds_(std::make_unique_for_overwrite<Bound[]>(view.count)), count_(view.count) {
    parallel_for(pieces(count_, source_block), 1, [&](std::size_t b, std::size_t) {
      const Run block = piece(count_, source_block, b);
      for (std::size_t i = block.first; i != block.end(); ++i) bounds_[i] = view[i];
    });
  }
  [[nodiscard]] RecordsOf<Bound> records() const noexcept {
    return shaftcull::records(std::span<const Bound>(bounds_.get(), count_));
  }

 private:
  std::unique_ptr<Bound[]> bounds_;
  std::size_t count_;
};

}  // namespace shaftcull::kernel
