// SPDX-License-Identifier: MIT
/// Answers of `shaftcull sees` in files.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "npz.hpp"
#include "output_file.hpp"
#include "sees_run.hpp"
#include "shaftcull/error.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

constexpr std::uint64_t most_csv_pairs = 100'000'000;

class NpzSights final : public SightSink {
 public:
  NpzSights(const std::string& path, const SeesScene& scene, std::span<const std::uint32_t> order, std::uint32_t rays)
      : file_(path),
        products_(file_.add("products", "<u4", {5})),
        undecided_(file_.add("undecided", "<u4", {2})),
        first_candidate_(file_.add("first_candidate", "<u8")),
        candidates_(file_.add("candidates", "<u4")),
        seen_(rays == 0 ? nullptr : &file_.add("seen", "<u4")) {
    append_one(first_candidate_, std::uint64_t{0});
    if (rays != 0) append_one(file_.add("rays", "<u4"), rays);
    file_.add("order", "<u4").append(order);
    file_.add("patch_boxes", "<f4", {2, 3}).append(std::span<const Box>(scene.boxes));
    file_.add("patch_planes", "<f4", {4}).append(std::span<const Plane>(scene.planes));
    NpyArray& corners = file_.add("patch_corners", "<f8", {3, 3});
    NpyArray& objects = file_.add("patch_objects", "<u4");
    for (const MeshPatch& patch : scene.patches) {
      corners.append(std::span<const Point3>(patch.corner));
      append_one(objects, scene.mesh.triangles[patch.triangle].object);
    }
    NpyArray& blockers = file_.add("blocker_boxes", "<f4", {2, 3});
    NpyArray& blocker_objects = file_.add("blocker_objects", "<u4");
    for (std::size_t i = 0; i < scene.blockers.size(); ++i) {
      append_one(blockers, scene.blockers.box(i));
      append_one(blocker_objects, scene.object_of_blocker(i));
    }
  }

  void take(const SightBatch& batch, std::span<const std::uint32_t> seen) override {
    rows_.clear();
    for (const SightProduct& product : batch.products) {
      rows_.push_back({product.a.first, product.a.count, product.b.first, product.b.count,
                       static_cast<std::uint32_t>(product.sight)});
    }
    products_.append(std::span<const ProductRow>(rows_));
    undecided_.append(batch.undecided.pairs);
    candidates_.append(batch.undecided.candidates);
    ends_.clear();
    for (std::size_t i = 0; i < batch.undecided.pairs.size(); ++i) {
      ends_.push_back(candidate_count_ + batch.undecided.first_candidate[i + 1]);
    }
    first_candidate_.append(std::span<const std::uint64_t>(ends_));
    candidate_count_ += batch.undecided.candidates.size();
    if (seen_ != nullptr) seen_->append(seen);
  }

  void finish() override { file_.finish(); }

 private:
  using ProductRow = std::array<std::uint32_t, 5>;

  template <class T>
  static void append_one(NpyArray& array, const T& value) {
    array.append(std::span<const T>(&value, 1));
  }

  NpzFile file_;
  NpyArray& products_;
  NpyArray& undecided_;
  NpyArray& first_candidate_;
  NpyArray& candidates_;
  NpyArray* seen_;
  std::uint64_t candidate_count_ = 0;
  std::vector<ProductRow> rows_;
  std::vector<std::uint64_t> ends_;
};

static_assert(sizeof(Box) == 6 * sizeof(float) && sizeof(Plane) == 4 * sizeof(float), "they are rows of arrays");
static_assert(sizeof(PatchPair) == 2 * sizeof(std::uint32_t), "it is a row of an array");

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
