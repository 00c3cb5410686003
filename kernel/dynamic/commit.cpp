// SPDX-License-Identifier: MIT
/// A commit plans first, and allocates all that it needs. Then it writes, and nothing throws any more.
#include "dynamic/commit.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "dispatch/active_kernels.hpp"
#include "dynamic/block_boxes.hpp"
#include "dynamic/block_writer.hpp"
#include "dynamic/change_in_place.hpp"
#include "dynamic/commit_plan.hpp"
#include "dynamic/members.hpp"
#include "dynamic/sort_blocks.hpp"
#include "dynamic/state_parts.hpp"
#include "parallel/parallel.hpp"
#include "tree/build.hpp"
#include "tree/entries.hpp"
#include "tree/source.hpp"

namespace shaftcull::kernel {
namespace {

template <class Bound>
class Commit {
 public:
  Commit(const Shared<StateOf<Bound>>& old, const Changes<Bound>& changes, bool layers, bool everything, Upkeep& upkeep)
      : old_(old),
        in_place_(old.is_only()),
        changes_(changes),
        layers_(layers),
        everything_(everything),
        upkeep_(upkeep),
        spent_(begun(upkeep)),
        kernels_(active_kernels()),
        plan_(*old, changes.all, spent_, kernels_),
        writer_(plan_, changes_, kernels_) {}

  Shared<StateOf<Bound>> run() {
    if (everything_ || plan_.is_worth_sorting_all()) return sort_all();
    plan_.complete();
    if (ChangeInPlace<Bound>::is_possible(old_, plan_, adds_layers())) {
      ChangeInPlace<Bound>(*old_, plan_, index_end(), writer_, kernels_).run();
      upkeep_ = spent_;
      return old_;
    }
    sort_groups();
    plan_table();
    Shared<StateOf<Bound>> next = prepare();
    write_blocks();
    finish(*next);
    upkeep_ = spent_;
    return next;
  }

 private:
  /// A block of the next state.
  struct Place {
    std::uint32_t number;
    std::uint32_t from;              ///< the position that it has now, or `no_position`
    Shared<LeafBlock<Bound>> block;  ///< a new one, or a copy to be changed; null: the present one
    [[nodiscard]] bool is_new() const noexcept { return from == no_position; }
  };

  [[nodiscard]] static Upkeep begun(Upkeep upkeep) noexcept {
    upkeep.sorted_last = 0;
    return upkeep;
  }
  [[nodiscard]] const DynamicState<Bound>& old() const noexcept { return *old_; }
  [[nodiscard]] std::size_t blocks() const noexcept { return old().blocks.size(); }

  Shared<StateOf<Bound>> sort_all() {
    Members<Bound> members(plan_.count());
    std::vector<std::uint64_t> gone(blocks() * block_words);
    for (const BlockStep& step : plan_.steps()) {
      gone[step.block * block_words + step.leaf / fanout] |= std::uint64_t{1} << step.leaf % fanout;
    }
    for (std::size_t b = 0; b != blocks(); ++b) add_stayers(members, b, gone.data() + b * block_words);
    for (const BlockStep& step : plan_.steps()) {
      if (step.kind == BlockStep::move) add(members, changes_.all[step.change]);
    }
    for (const std::uint32_t c : plan_.arrivals()) add(members, changes_.all[c]);
    Blocks<Bound> sorted;
    if (members.count() != 0) {
      node_size_ = size_of_nodes(members, members.count());
      sorted = sorted_blocks_in_parallel(members, sorting(), kernels_);
    }
    const BlockBoxes boxes(sorted);
    for (std::size_t b = 0; b != sorted.size(); ++b) {
      table_.push_back({static_cast<std::uint32_t>(b + 1), no_position, std::move(sorted[b])});
    }
    numbers_ = table_.size() + 1;
    order_table(boxes);
    in_place_ = false;  // nothing of it is used again
    for (std::size_t i = 0; i != pages(); ++i) pages_.push_back(Shared<PlacePage>(new PlacePage));
    node_size_count_ = members.count();
    spent_.sorted_last = members.count();
    spent_.saved = 0;
    Shared<StateOf<Bound>> next = prepare();
    write_blocks();
    finish(*next);
    upkeep_ = spent_;
    return next;
  }

  [[nodiscard]] bool has_layers() const noexcept { return layers_ || old().has_layers; }
  [[nodiscard]] bool adds_layers() const noexcept { return has_layers() && !old().has_layers; }
  [[nodiscard]] std::size_t index_end() const noexcept { return changes_.slots.size(); }
  [[nodiscard]] std::size_t pages() const noexcept { return LeafBlocks::pages_for(index_end()); }

  static void add(Members<Bound>& members, const Change<Bound>& change) noexcept {
    members.add(change.bound, change.index, change.layers);
  }
  void add_stayers(Members<Bound>& members, std::size_t block, const std::uint64_t* gone) const noexcept {
    const LeafBlock<Bound>& from = *old().blocks[block];
    std::uint64_t stay[block_words];
    for (std::size_t w = 0; w != block_words; ++w) stay[w] = from.taken[w] & ~gone[w];
    if (!plan_.walks_blocks()) return members.add(from, stay);
    writer_.for_each_changed(from, stay, [&](std::size_t leaf, const Change<Bound>& change) {
      add(members, change);
      stay[leaf / fanout] &= ~(std::uint64_t{1} << leaf % fanout);
    });
    members.add(from, stay);
  }
  [[nodiscard]] BlockSorting sorting() const noexcept {
    return {.node_size = node_size_, .has_layers = has_layers(), .keeps_large_apart = plan_.count() > sorted_in_block};
  }
  void sort_groups() {
    refresh_node_size();
    sorted_.resize(plan_.groups().size());
    parallel_for(sorted_.size(), 1, [&](std::size_t g, std::size_t) {
      const SortedGroup& group = plan_.groups()[g];
      std::size_t most = group.arrivals.size();
      for (const std::uint32_t b : group.blocks) most += plan_.count_after(b);
      if (most == 0) return;
      Members<Bound> members(most);
      for (const std::uint32_t b : group.blocks) {
        std::uint64_t gone[block_words] = {};
        for (const BlockStep& step : plan_.steps_of(b)) {
          if (step.kind != BlockStep::insert) gone[step.leaf / fanout] |= std::uint64_t{1} << step.leaf % fanout;
        }
        add_stayers(members, b, gone);
        for (const BlockStep& step : plan_.steps_of(b)) {
          if (step.kind != BlockStep::erase) add(members, changes_.all[step.change]);
        }
      }
      for (const std::uint32_t c : group.arrivals) add(members, changes_.all[c]);
      sorted_[g] = sorted_blocks(members, sorting(), kernels_);
      for (const Shared<LeafBlock<Bound>>& block : sorted_[g]) block->is_apart = group.are_apart;
    });
  }

  /// The usual size of a node follows the number of bounds.
  void refresh_node_size() {
    node_size_ = old().node_size;
    node_size_count_ = old().node_size_count;
    if (plan_.groups().empty()) return;
    spent_.sorted_since_size += spent_.sorted_last;
    const bool is_old = spent_.sorted_since_size > plan_.count() || plan_.count() >= 2 * node_size_count_ ||
                        2 * plan_.count() <= node_size_count_;
    if (!is_old) return;
    constexpr std::size_t most = 1024;
    const std::size_t apart = old().count / most + 1;
    Members<Bound> sample(old().count / apart + 1);
    std::size_t i = 0;
    for (const Shared<LeafBlock<Bound>>& block : old().blocks) {
      for (std::size_t leaf = 0; leaf != block_leaves; ++leaf) {
        if ((block->taken[leaf / fanout] >> leaf % fanout & 1) == 0 || i++ % apart != 0) continue;
        float bound[rows_of<Bound>];
        block->read(leaf, bound);
        sample.add(bound, 0, 0);
      }
    }
    if (sample.count() == 0) return;
    node_size_ = size_of_nodes(sample, plan_.count());
    node_size_count_ = plan_.count();
    spent_.sorted_since_size = 0;
  }

  [[nodiscard]] static float size_of_nodes(const Members<Bound>& sample, std::size_t count) {
    return node_size_of<Bound>(RecordSource<Bound>(records_in<Bound>(sample.records(), sample.count())), count);
  }

  /// Lists the blocks of the next state.
  void plan_table() {
    table_.reserve(blocks());
    std::vector<std::uint32_t> free;  // numbers
    for (std::size_t b = 0; b != blocks(); ++b) {
      if (plan_.is_sorted_again(b)) {
        free.push_back(old().number_of[b]);
      } else {
        table_.push_back({old().number_of[b], static_cast<std::uint32_t>(b), {}});
      }
    }
    numbers_ = std::max<std::size_t>(old().position_of.size(), number_of_nothing + 1);
    for (std::size_t n = 1; n < numbers_; ++n) {
      if (old().position_of[n] == no_position) free.push_back(static_cast<std::uint32_t>(n));
    }
    std::sort(free.begin(), free.end(), std::greater<>());
    for (Blocks<Bound>& blocks_of_group : sorted_) {
      for (Shared<LeafBlock<Bound>>& block : blocks_of_group) {
        std::uint32_t number = static_cast<std::uint32_t>(numbers_);
        if (free.empty()) {
          ++numbers_;
        } else {
          number = free.back();
          free.pop_back();
        }
        table_.push_back({number, no_position, std::move(block)});
      }
    }
    if (!plan_.groups().empty()) {
      Blocks<Bound> all;
      for (const Place& place : table_) all.push_back(place.is_new() ? place.block : old().blocks[place.from]);
      order_table(BlockBoxes(all));
    }
    // What is written is not shared with another state, and has layers if there are any.
    for (Place& place : table_) {
      if (place.is_new() || (!plan_.is_changed(place.from) && !adds_layers())) continue;
      const Shared<LeafBlock<Bound>>& block = old().blocks[place.from];
      if (in_place_ && block.is_only() && !adds_layers()) continue;
      place.block = Shared<LeafBlock<Bound>>(new LeafBlock<Bound>(*block, has_layers()));
    }
  }

  /// Puts blocks that are near each other side by side, so that the nodes above them are small.
  void order_table(const BlockBoxes& boxes) {
    if (table_.size() <= top_words * fanout) return;
    const TreeParts<Box> order = build<Box>(ViewSource<Box>(boxes.view()));
    std::vector<Place> ordered;
    ordered.reserve(table_.size());
    for (const std::uint32_t b : order.order) ordered.push_back(std::move(table_[b]));
    table_ = std::move(ordered);
  }

  /// Gets the memory of the next state. After that, nothing throws.
  Shared<StateOf<Bound>> prepare() {
    Shared<StateOf<Bound>> next = in_place_ ? old_ : Shared<StateOf<Bound>>(new StateOf<Bound>);
    if (pages_.empty()) {
      pages_.reserve(pages());
      for (std::size_t i = 0; i != pages(); ++i) {
        if (i >= old().pages.size()) {
          pages_.push_back(Shared<PlacePage>(new PlacePage));
        } else if (in_place_ && !old().pages[i].is_only()) {
          pages_.push_back(Shared<PlacePage>(new PlacePage(*old().pages[i])));
        } else {
          pages_.push_back(old().pages[i]);
        }
      }
    }
    is_written_.assign(table_.size(), 0);
    if (!in_place_) copy_shared_pages();
    parts_.prepare(table_.size(), numbers_, std::move(pages_), has_layers());
    return next;
  }

  /// Of pages that another state shares, copies those whose places change. Bounds of words that are split may have
  /// theirs on any page.
  void copy_shared_pages() {
    std::vector<bool> changes(pages());
    bool any_splits = !plan_.groups().empty() || plan_.walks_blocks();
    for (const BlockStep& step : plan_.steps()) {
      changes[changes_.all[step.change].index / LeafBlocks::page_size] = true;
      any_splits = any_splits || step.kind == BlockStep::insert;
    }
    for (std::size_t i = 0; i != pages(); ++i) {
      if ((!changes[i] && !any_splits) || pages_[i].is_only()) continue;
      pages_[i] = Shared<PlacePage>(new PlacePage(*pages_[i]));
    }
  }

  [[nodiscard]] LeafBlock<Bound>& block_at(std::size_t p) const noexcept {
    return table_[p].block ? *table_[p].block : *old().blocks[table_[p].from];
  }

  /// Writes the places of new blocks, and makes the changes of all others.
  void write_blocks() noexcept {
    for (const SortedGroup& group : plan_.groups()) {
      for (const std::uint32_t b : group.blocks) clear_places(plan_.steps_of(b));
    }
    const bool in_tasks = writer_.is_worth_tasks() || !plan_.groups().empty();
    write_each(table_.size(), in_tasks, is_written_, [this](std::size_t p) {
      const PlaceWriter places(parts_.places(), table_[p].number);
      if (table_[p].is_new()) {
        write_places(*table_[p].block, places);
      } else if (plan_.is_changed(table_[p].from)) {
        writer_.write(block_at(p), table_[p].from, places);
      }
    });
  }
  /// Of bounds that are erased.
  void clear_places(std::span<const BlockStep> steps) const noexcept {
    for (const BlockStep& step : steps) {
      const Change<Bound>& change = changes_.all[step.change];
      if (change.has_bound == 0) PlaceWriter(parts_.places(), 0).clear(change.index);
    }
  }

  /// Puts the next state together.
  void finish(DynamicState<Bound>& next) noexcept {
    for (const Place& place : table_) {
      parts_.add(place.block ? place.block : old().blocks[place.from], place.number);
    }
    parts_.move_to(next, kernels_);
    next.owns_pages = in_place_;
    next.index_end = index_end();
    next.count = plan_.count();
    next.node_size = node_size_;
    next.node_size_count = node_size_count_;
  }

  const Shared<StateOf<Bound>>& old_;
  bool in_place_;
  const Changes<Bound>& changes_;
  bool layers_;
  bool everything_;
  Upkeep& upkeep_;
  Upkeep spent_;
  const Kernels& kernels_;

  CommitPlan<Bound> plan_;
  BlockWriter<Bound> writer_;
  std::vector<Blocks<Bound>> sorted_;  ///< of each group
  float node_size_ = 0;
  std::size_t node_size_count_ = 0;

  std::vector<Place> table_;
  std::size_t numbers_ = 0;
  std::vector<std::uint8_t> is_written_;

  std::vector<Shared<PlacePage>> pages_;  ///< of the next state
  StateParts<Bound> parts_;
};

}  // namespace

template <class Bound>
Shared<StateOf<Bound>> empty_state() {
  const Shared<StateOf<Bound>> nothing(new StateOf<Bound>);
  Upkeep upkeep;
  return Commit<Bound>(nothing, {}, false, false, upkeep).run();
}

template <class Bound>
Shared<StateOf<Bound>> committed(const Shared<StateOf<Bound>>& old, const Changes<Bound>& changes, bool layers,
                                 bool everything, Upkeep& upkeep) {
  return Commit<Bound>(old, changes, layers, everything, upkeep).run();
}

#define SHAFTCULL_COMMIT(Bound)                         \
  template Shared<StateOf<Bound>> empty_state<Bound>(); \
  template Shared<StateOf<Bound>> committed(const Shared<StateOf<Bound>>&, const Changes<Bound>&, bool, bool, Upkeep&);
SHAFTCULL_COMMIT(Box)
SHAFTCULL_COMMIT(Sphere)
#undef SHAFTCULL_COMMIT

}  // namespace shaftcull::kernel
