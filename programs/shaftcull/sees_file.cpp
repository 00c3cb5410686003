// SPDX-License-Identifier: MIT
/// Answers of `shaftcull sees` in files that one process writes while they come.
#include <array>
#include <utility>

#include <fmt/format.h>

#include "npz.hpp"
#include "output_file.hpp"
#include "sees_arrays.hpp"
#include "sees_csv.hpp"
#include "sees_run.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

class NpzSights final : public SightSink {
 public:
  NpzSights(const std::string& path, const SeesScene& scene, std::span<const std::uint32_t> order,
            const SightContent& content)
      : file_(path) {
    for (AnswerArray& array : answer_arrays(content)) {
      arrays_.emplace_back(array.kind, &file_.add(std::move(array.format)));
      if (array.kind == AnswerKind::first_candidate) arrays_.back().second->append(std::span(&no_candidate_before, 1));
    }
    for (SceneArray& known : scene_arrays(scene, order, content)) {
      NpyArray& array = file_.add(std::move(known.format));
      known.pour([&](std::span<const std::byte> bytes) { array.append(bytes); });
    }
  }

  void take(const SightBatch& batch, std::span<const std::uint32_t> seen) override {
    rows_.clear();
    for (const PairBlock& block : batch.blocks) {
      rows_.push_back(
          {block.a.first, block.a.count, block.b.first, block.b.count, static_cast<std::uint32_t>(block.sight)});
    }
    ends_.clear();
    for (const std::size_t end : ends_of(batch.undecided)) ends_.push_back(candidate_count_ + end);
    candidate_count_ += batch.undecided.candidates.size();
    for (const auto& [kind, array] : arrays_) {
      switch (kind) {
        case AnswerKind::blocks:
          array->append(std::span<const ProductRow>(rows_));
          break;
        case AnswerKind::undecided:
          array->append(batch.undecided.pairs);
          break;
        case AnswerKind::seen:
          array->append(seen);
          break;
        case AnswerKind::first_candidate:
          array->append(std::span<const std::uint64_t>(ends_));
          break;
        case AnswerKind::candidates:
          array->append(batch.undecided.candidates);
          break;
      }
    }
  }

  void finish() override { file_.finish(); }

 private:
  using ProductRow = std::array<std::uint32_t, 5>;

  NpzFile file_;
  std::vector<std::pair<AnswerKind, NpyArray*>> arrays_;  ///< those of answers
  std::uint64_t candidate_count_ = 0;
  std::vector<ProductRow> rows_;
  std::vector<std::uint64_t> ends_;
};

/// Lines of undecided pairs are kept on disk until all others are written.
class CsvSights final : public SightSink {
 public:
  CsvSights(const std::string& path, std::span<const std::uint32_t> order, std::uint32_t rays)
      : file_(path),
        undecided_(file_),
        lines_(
            order, rays, [this](std::string_view text) { file_.write(text); },
            [this](std::string_view text) { undecided_.write(text); }) {
    file_.write(csv_heading(rays));
  }

  void take(const SightBatch& batch, std::span<const std::uint32_t> seen) override { lines_.take(batch, seen); }

  void finish() override {
    undecided_.read_all([this](std::string_view text) { file_.write(text); });
    file_.finish();
  }

 private:
  OutputFile file_;
  Spool undecided_;
  CsvLines lines_;
};

}  // namespace

SightForm sight_form(const std::string& path, std::uint64_t patches) {
  if (path.ends_with(".npz")) return SightForm::npz;
  if (!path.ends_with(".csv") && !is_stream(path)) {
    throw InvalidArgument(fmt::format("--out {}: unknown kind of file; give a name that ends in .npz or .csv", path));
  }
  require_pairs_for_csv(path, patches);
  return SightForm::csv;
}

std::unique_ptr<SightSink> sight_file(const std::string& path, const SeesScene& scene,
                                      std::span<const std::uint32_t> order, const SightContent& content) {
  if (sight_form(path, order.size()) == SightForm::npz) return std::make_unique<NpzSights>(path, scene, order, content);
  require_no_candidates(path, content);
  return std::make_unique<CsvSights>(path, order, content.rays);
}

}  // namespace shaftcull::cli
