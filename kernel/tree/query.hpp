/// A checked question to a tree.
#pragma once

#include <span>
#include <string>
#include <type_traits>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "kernels/table.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/query.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"
#include "tree/access.hpp"
#include "tree/visitors.hpp"
#include "tree/walk.hpp"

namespace shaftcull::kernel {

template <class Bound, class Index>
class Query {
 public:
  /// Throws NeedsRefit and InvalidArgument as shaftcull/query.hpp says.
  Query(std::span<const CompiledShaft> shafts, const BoundsTree<Bound, Index>& tree, Question question,
        const ExcludingOf<Index>& excluding)
      : shafts_(data_of(shafts)),
        parts_(TreeAccess::parts(tree) == nullptr ? empty_ : *TreeAccess::parts(tree)),
        kernels_(active_kernels()),
        question_(question),
        own_(excluding.own),
        own_per_shaft_(shafts.empty() ? 0 : excluding.own.size() / shafts.size()),
        mask_(excluding.mask) {
    if (parts_.dirty_words != 0) throw NeedsRefit("query of a tree whose bounds were updated; call refit() first");
    require_memory("shafts", shafts, "shafts");
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      if (question == Question::blocking) {
        require_two_ends(shafts_[s], s);
      } else {
        require_answers(shafts_[s], question != Question::inside, question != Question::kept,
                        std::is_same_v<Bound, Sphere>, s);
      }
    }
    if (own_per_shaft_ * shafts.size() != own_.size()) {
      throw InvalidArgument("excluding.own has " + counted_indices(own_.size()) + ", which is not a multiple of the " +
                            counted(shafts.size(), "shaft") + "; each needs as many");
    }
    require_below("excluding.own", own_, parts_.size);
    require_memory("excluding.mask", mask_, "words");
    if (!mask_.empty() && mask_.size() != words_for(parts_.size)) {
      throw InvalidArgument("excluding.mask has " + counted(mask_.size(), "word") + "; the bits of " +
                            counted(parts_.size, "bound") + " take " + std::to_string(words_for(parts_.size)));
    }
  }

  [[nodiscard]] std::size_t shafts() const noexcept { return shafts_.size(); }
  [[nodiscard]] std::size_t size() const noexcept { return parts_.size; }
  [[nodiscard]] std::size_t row_words() const noexcept { return words_for(parts_.size); }
  [[nodiscard]] LeafIndices<Index> indices() const noexcept {
    return {parts_.order, parts_.is_worth_prefetching(), kernels_};
  }

  /// Throws InvalidArgument if `output`, called `name` in the message, is memory that excludes bounds.
  void require_apart(const char* call, const char* name, std::span<const std::byte> output) const {
    kernel::require_apart(call, name, output, "excluding.own", bytes_of(own_));
    kernel::require_apart(call, name, output, "excluding.mask", bytes_of(mask_));
  }

  /// Gives the visitor what shaft s keeps.
  template <class Visitor>
  void walk(std::size_t s, Visitor& visitor) const {
    in_float_environment([&] {
      if (own_.empty() && mask_.empty()) {
        Walk<Bound, Visitor>(parts_, kernels_, shafts_[s], question_, visitor).run();
      } else {
        Filter<Index, Visitor> filter(indices(), own_.subspan(s * own_per_shaft_, own_per_shaft_), mask_, visitor);
        Walk<Bound, Filter<Index, Visitor>>(parts_, kernels_, shafts_[s], question_, filter).run();
      }
    });
  }

 private:
  inline static const TreeParts<Bound, Index> empty_{};
  std::span<const ShaftData> shafts_;
  const TreeParts<Bound, Index>& parts_;
  const Kernels& kernels_;
  Question question_;
  std::span<const Index> own_;
  std::size_t own_per_shaft_;
  std::span<const std::uint64_t> mask_;
};

}  // namespace shaftcull::kernel
