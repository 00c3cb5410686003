// SPDX-License-Identifier: MIT
#include "visibility/pair_parts.hpp"

#include <algorithm>

namespace shaftcull::kernel {
namespace {

/// Walks through all pairs in order, group by group, and collects those of a part. A pair of groups that has at most a
/// quarter of a part's pairs, or cannot be split, belongs to the part of its first pair.
class PartWalk {
 public:
  PartWalk(const SightJob& job, std::uint32_t part, std::uint32_t parts) : job_(job) {
    const std::uint64_t total = job.pairs(0, 0);
    const std::uint64_t share = total / parts;
    const auto first_of = [&](std::uint64_t i) { return share * i + std::min(i, total % parts); };
    most_ = std::max<std::uint64_t>(share / 4, 1);
    begin_ = first_of(part);
    end_ = first_of(std::uint64_t{part} + 1);
  }

  std::vector<GroupPair> groups() {
    visit({0, 0}, 0);
    return found_;
  }

 private:
  /// `before` pairs come before these.
  void visit(const GroupPair& groups, std::uint64_t before) {
    const std::uint64_t pairs = job_.pairs(groups.a, groups.b);
    if (pairs == 0 || before >= end_ || before + pairs <= begin_) return;
    const PatchGroup& a = job_.a.tree.groups()[groups.a];
    const PatchGroup& b = job_.b.tree.groups()[groups.b];
    if (pairs <= most_ || (a.has_patches && b.has_patches)) {
      if (before >= begin_) found_.push_back(groups);
      return;
    }
    const auto visit_next = [&](const GroupPair& part) {
      visit(part, before);
      before += job_.pairs(part.a, part.b);
    };
    if (job_.is_of_one_set && groups.a == groups.b) {
      for (std::uint32_t i = 0; i != a.children; ++i) {
        for (std::uint32_t j = i; j != a.children; ++j) visit_next({a.first_child + i, a.first_child + j});
      }
    } else if (!a.has_patches && (b.has_patches || a.count >= b.count)) {
      for (std::uint32_t i = 0; i != a.children; ++i) visit_next({a.first_child + i, groups.b});
    } else {
      for (std::uint32_t i = 0; i != b.children; ++i) visit_next({groups.a, b.first_child + i});
    }
  }

  const SightJob& job_;
  std::uint64_t most_ = 0;
  std::uint64_t begin_ = 0;
  std::uint64_t end_ = 0;
  std::vector<GroupPair> found_;
};

}  // namespace

std::vector<GroupPair> groups_of_part(const SightJob& job, std::uint32_t part, std::uint32_t parts) {
  if (job.a.tree.groups().empty() || job.b.tree.groups().empty()) return {};
  if (parts == 1) return {{0, 0}};
  return PartWalk(job, part, parts).groups();
}

}  // namespace shaftcull::kernel
