// SPDX-License-Identifier: MIT
/// `shaftcull hash`: does this machine give the answers that all others give?
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "hashes/hashes.hpp"
#include "instruction_set.hpp"
#include "interrupt.hpp"
#include "name_search.hpp"
#include "number.hpp"
#include "progress.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/version.hpp"
#include "subcommand.hpp"
#include "table.hpp"
#include "workers.hpp"

namespace shaftcull::cli {
namespace {

using hashes::Family;

struct HashOptions {
  bool quick = false;
  std::vector<std::string> families;
  std::vector<std::string> isas;
  int threads = 0;
};

std::vector<const Family*> families_of(const HashOptions& options) {
  std::vector<const Family*> chosen;
  std::vector<std::string> names;
  for (const Family& family : hashes::families()) {
    names.emplace_back(family.name);
    if (options.families.empty()) chosen.push_back(&family);
  }
  for (const std::string& name : options.families) {
    const auto at = std::ranges::find(names, name);
    if (at == names.end()) {
      throw InvalidArgument(fmt::format("--family {}: there is no family of that name; the families are {}", name,
                                        closest_names(name, names)));
    }
    chosen.push_back(&hashes::families()[static_cast<std::size_t>(at - names.begin())]);
  }
  return chosen;
}

class Hashing {
 public:
  explicit Hashing(const HashOptions& options)
      : options_(options), isas_(instruction_sets(options.isas)), families_(families_of(options)) {}

  void run() {
    const Workers workers(options_.threads);
    progress_.milestone(fmt::format("{} families, {}, on:{}", families_.size(), size_text(), names_of(isas_)));
    workers.run([&] {
      for (const Family* const family : families_) {
        if (interrupt_.signal() != 0) return;
        look_at(*family);
      }
    });
  }

  void print() const {
    fmt::print("{}", table_.text());
    fmt::print("\nshaftcull {}, {}, on:{}\n", SHAFTCULL_VERSION_STRING, size_text(), names_of(isas_));
  }

  [[nodiscard]] int interrupted() const noexcept { return done_ < families_.size() ? interrupt_.signal() : 0; }
  [[nodiscard]] std::size_t done() const noexcept { return done_; }
  [[nodiscard]] std::size_t wrong() const noexcept { return wrong_; }
  [[nodiscard]] std::size_t families() const noexcept { return families_.size(); }

 private:
  [[nodiscard]] const char* size_text() const noexcept {
    return options_.quick ? "about 10,000 cases of each or more" : "a million cases of each";
  }

  /// Adds a row; where hashes differ from the record, one for each of them.
  void look_at(const Family& family) {
    progress_.update(fmt::format("{} of {} families; {}", done_, families_.size(), family.name));
    const std::string on_record = fmt::format("{:016x}", options_.quick ? family.hash_of_few : family.hash_of_many);
    const std::vector<hashes::Deviation> found = hashes::deviations(family, options_.quick, isas_);
    if (found.empty()) table_.add_row({family.name, on_record, "yes"});
    for (const auto& [isa, way, hash] : found) {
      table_.add_row({family.name, fmt::format("{:016x}", hash),
                      fmt::format("NO, the record has {}: {}, {}", on_record, name(isa), name(way))});
    }
    if (!found.empty()) ++wrong_;
    ++done_;
  }

  const HashOptions& options_;
  std::vector<Isa> isas_;
  std::vector<const Family*> families_;
  Table table_{{"family", "hash", "as on record"}};
  std::size_t done_ = 0;
  std::size_t wrong_ = 0;
  Progress progress_;
  InterruptWatch interrupt_;
};

void run(const HashOptions& options) {
  Hashing hashing(options);
  hashing.run();
  hashing.print();
  if (hashing.wrong() != 0) {
    std::fflush(stdout);
    throw std::runtime_error(
        fmt::format("{} of {} families have other hashes here than on record", hashing.wrong(), hashing.families()));
  }
  if (const int signal = hashing.interrupted(); signal != 0) {
    throw Interrupted(signal,
                      fmt::format("hash: interrupted after {} of {} families", hashing.done(), hashing.families()));
  }
}

}  // namespace

void add_hash(CLI::App& program) {
  const auto options = std::make_shared<HashOptions>();
  CLI::App& hash =
      *program.add_subcommand("hash", "Compare hashes of answers with the record, which is the same for all machines");
  hash.add_flag("--quick", options->quick, "About 10,000 cases per family instead of a million");
  hash.add_option("--family", options->families, "Families of answers to compare (default: all)")->type_name("NAME");
  hash.add_option("--isa", options->isas, "Instruction sets to test (default: that of SHAFTCULL_ISA, or all)")
      ->type_name("NAME");
  add_number(hash, "--threads", options->threads, 0, most_threads,
             "Number of threads, 0 for all; hashes do not depend on it (default: 0)")
      ->type_name("N");
  hash.footer(
      "A family is one kind of question. Its cases are made from integers, so they are the same\n"
      "everywhere. The program tests them on each instruction set, in slab and plane form, with one\n"
      "shaft and with many. All must give the same hash, which is on record (docs/hashes.md). Exit code\n"
      "1 if a hash differs: then an answer is wrong, on this machine or on record. Please report it.");
  hash.callback([options] { run(*options); });
}

}  // namespace shaftcull::cli
