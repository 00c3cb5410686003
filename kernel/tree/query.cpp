// SPDX-License-Identifier: MIT
#include "tree/query.hpp"

#include <string>
#include <type_traits>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "shaftcull/error.hpp"
#include "support/fail.hpp"
#include "support/text.hpp"

namespace shaftcull::kernel {

template <class Bound>
Query<Bound>::Query(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, Question question,
                    const Excluding& excluding)
    : shafts_(data_of(shafts)),
      parts_(TreeAccess::parts(tree) == nullptr ? empty_ : *TreeAccess::parts(tree)),
      kernels_(active_kernels()),
      question_(question),
      own_(excluding.own),
      own_per_shaft_(shafts.empty() ? 0 : excluding.own.size() / shafts.size()),
      mask_(excluding.mask),
      only_layers_(excluding.only_layers) {
  if (parts_.dirty_words != 0)
    kernel::fail(NeedsRefit("query of a tree whose bounds were updated; call refit() first"));
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
    kernel::fail(InvalidArgument("excluding.own has " + counted_indices(own_.size()) +
                                 ", which is not a multiple of the " + counted(shafts.size(), "shaft") +
                                 "; each needs as many"));
  }
  require_below("excluding.own", own_, parts_.size);
  require_memory("excluding.mask", mask_, "words");
  if (!mask_.empty() && mask_.size() != words_for(parts_.size)) {
    kernel::fail(InvalidArgument("excluding.mask has " + counted(mask_.size(), "word") + "; the bits of " +
                                 counted(parts_.size, "bound") + " take " + std::to_string(words_for(parts_.size))));
  }
  require_memory("excluding.only_layers", only_layers_, "sets of layers");
  if (only_layers_.empty()) return;
  if (only_layers_.size() != 1 && only_layers_.size() != shafts.size()) {
    kernel::fail(InvalidArgument("excluding.only_layers has " + counted(only_layers_.size(), "set") +
                                 " of layers for " + counted(shafts.size(), "shaft") +
                                 "; give one for each, or one for all"));
  }
  if (!parts_.layers.exist() && parts_.size != 0) {
    kernel::fail(InvalidArgument(
        "excluding.only_layers asks for layers, and the tree has none; call set_layers() of the tree first"));
  }
}

template <class Bound>
void Query<Bound>::require_apart(const char* call, const char* name, std::span<const std::byte> output) const {
  kernel::require_apart(call, name, output, "excluding.own", bytes_of(own_));
  kernel::require_apart(call, name, output, "excluding.mask", bytes_of(mask_));
  kernel::require_apart(call, name, output, "excluding.only_layers", bytes_of(only_layers_));
}

template <class Bound>
void Query<Bound>::walk_leaves(std::size_t s, LeafVisitor& visitor, const VisitorTraits& traits) const {
  in_float_environment(
      [&] { Walk<Bound>(parts_, kernels_, shafts_[s], question_, exclusion(s), visitor, traits).run(); });
}

template class Query<Box>;
template class Query<Sphere>;

}  // namespace shaftcull::kernel
