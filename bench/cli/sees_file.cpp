// SPDX-License-Identifier: MIT
/// Answers of `shaftcull sees` in files that one process writes while they come.
#include <array>

#include <fmt/format.h>

#include "npz.hpp"
#include "output_file.hpp"
#include "sees_arrays.hpp"
#include "sees_run.hpp"
#include "shaftcull/error.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

constexpr std::uint64_t most_csv_pairs = 100'000'000;

class NpzSights final : public SightSink {
 public:
  NpzSights(const std::string& path, const SeesScene& scene, std::span<const std::uint32_t> order, std::uint32_t rays)
      : file_(path) {
    for (NpyFormat& format : answer_arrays(rays)) arrays_.push_back(&file_.add(std::move(format)));
    append(first_candidate_array, std::span(&no_candidate_before, 1));
    for (SceneArray& known : scene_arrays(scene, order, rays)) {
      NpyArray& array = file_.add(std::move(known.format));
      known.pour([&](std::span<const std::byte> bytes) { array.append(bytes); });
    }
  }

  void take(const SightBatch& batch, std::span<const std::uint32_t> seen) override {
    rows_.clear();
    for (const SightProduct& product : batch.products) {
      rows_.push_back({product.a.first, product.a.count, product.b.first, product.b.count,
                       static_cast<std::uint32_t>(product.sight)});
    }
    append(products_array, std::span<const ProductRow>(rows_));
    append(undecided_array, batch.undecided.pairs);
    append(candidates_array, batch.undecided.candidates);
    ends_.clear();
    for (std::size_t i = 0; i < batch.undecided.pairs.size(); ++i) {
      ends_.push_back(candidate_count_ + batch.undecided.first_candidate[i + 1]);
    }
    append(first_candidate_array, std::span<const std::uint64_t>(ends_));
    candidate_count_ += batch.undecided.candidates.size();
    if (arrays_.size() > seen_array) append(seen_array, seen);
  }

  void finish() override { file_.finish(); }

 private:
  using ProductRow = std::array<std::uint32_t, 5>;

  template <class T>
  void append(AnswerArray array, std::span<const T> rows) {
    arrays_[array]->append(rows);
  }

  NpzFile file_;
  std::vector<NpyArray*> arrays_;  ///< those of answers, by AnswerArray
  std::uint64_t candidate_count_ = 0;
  std::vector<ProductRow> rows_;
  std::vector<std::uint64_t> ends_;
};

class CsvSights final : public SightSink {
 public:
  CsvSights(const std::string& path, std::span<const std::uint32_t> order, std::uint32_t rays)
      : order_(order), has_rays_(rays != 0), file_(checked(path, order.size())) {
    file_.write(has_rays_ ? "a,b,sight,seen\n" : "a,b,sight\n");
  }

  void take(const SightBatch& batch, std::span<const std::uint32_t> seen) override {
    text_.clear();
    for (const SightProduct& product : batch.products) {
      const char* const word = name(product.sight);
      for (std::uint32_t i = 0; i < product.a.count; ++i) {
        for (std::uint32_t j = 0; j < product.b.count; ++j) {
          fmt::format_to(std::back_inserter(text_), "{},{},{}{}\n", order_[product.a.first + i],
                         order_[product.b.first + j], word, has_rays_ ? "," : "");
        }
      }
      write_out(std::size_t{1} << 20);
    }
    for (std::size_t i = 0; i < batch.undecided.pairs.size(); ++i) {
      const PatchPair& pair = batch.undecided.pairs[i];
      fmt::format_to(std::back_inserter(text_), "{},{},{}{}\n", pair.a, pair.b, name(Sight::undecided),
                     has_rays_ ? fmt::format(",{}", seen[i]) : "");
    }
    write_out(0);
  }

  void finish() override { file_.finish(); }

 private:
  static const std::string& checked(const std::string& path, std::uint64_t patches) {
    const std::uint64_t pairs = patches * (patches - 1) / 2;
    if (pairs <= most_csv_pairs) return path;
    throw InvalidArgument(
        fmt::format("--out {}: {} pairs; a CSV file may have {}; give an .npz file, or larger patches", path,
                    grouped(pairs), grouped(most_csv_pairs)));
  }

  /// Writes the text if it is longer than `most`.
  void write_out(std::size_t most) {
    if (text_.size() <= most) return;
    file_.write(text_);
    text_.clear();
  }

  std::span<const std::uint32_t> order_;
  bool has_rays_;
  OutputFile file_;
  std::string text_;
};

}  // namespace

std::unique_ptr<SightSink> sight_file(const std::string& path, const SeesScene& scene,
                                      std::span<const std::uint32_t> order, std::uint32_t rays) {
  if (path.ends_with(".npz")) return std::make_unique<NpzSights>(path, scene, order, rays);
  if (path.ends_with(".csv") || is_stream(path)) return std::make_unique<CsvSights>(path, order, rays);
  throw InvalidArgument(fmt::format("--out {}: what kind of file? Give a name that ends in .npz or .csv", path));
}

}  // namespace shaftcull::cli
