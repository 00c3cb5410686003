// SPDX-License-Identifier: MIT
/// Jobs on the facets of a mesh in parts, which ranks share and which are kept until all are there.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include <fmt/format.h>

#include "batch/checksum.hpp"
#include "facet_job.hpp"
#include "peak_memory.hpp"
#include "ranked_parts.hpp"
#include "ranked_run.hpp"
#include "scene_checksum.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::cli {

template <class Value>
std::uint64_t checksum_of(std::span<const Value> values) {
  return batch::checksum(std::as_bytes(values));
}

/// The scene and the options of a job, the same on all ranks.
template <class Job>
batch::JobDescription describe(const Job& job, const FacetResult& result, batch::Ranks& ranks,
                               const batch::Surroundings& surroundings) {
  const std::string scene = scene_checksum(result.scene);
  batch::agree_on(ranks, checksum_of<char>(scene), fmt::format("{} has other patches than on rank 0", result.source));
  batch::JobDescription description{
      {"command", Job::verb},
      {"version", surroundings.version},
      {"scene", scene},
      {"facets", fmt::format("{}, {:016x}", result.patches.size(), checksum_of<Vec3>(result.patches.corners))}};
  job.describe(description);
  const FacetOptions& options = job.options();
  const std::string text = batch::text_of(description) + options.out + '\n' + options.svg + '\n' + options.ply;
  batch::agree_on(ranks, checksum_of<char>(text), "was started with other options than rank 0");
  return description;
}

/// Does a job on all launched ranks, or in this process if none were launched. A free rank takes the next part, and
/// stores its answer in FILE.parts/, where FILE is kept_beside() of the options. Then the first rank joins all answers
/// and writes the files, which do not depend on the number of ranks. Resumes a job that was interrupted. Throws
/// EarlyExit after one rank has reported an unusable argument. A Job has
///
///   verb, Part               its name, and the answer of a part, as batch::BlockStore wants it
///   options(), check()       its FacetOptions; throws for such that cannot be used
///   prepare()                reads the scene, unless it has it, and returns its FacetResult
///   describe(description)    adds options that answers depend on
///   parts(), pairs()         how many; pairs are those that progress counts
///   answer(part)             of one part, from 0; on any rank
///   add(part, answer)        on the first rank: all parts in their order
///   join(), write()          then these, once
template <class Job>
void run_facet_parts(Job& job) {
  using Clock = std::chrono::steady_clock;
  using Part = typename Job::Part;
  const FacetOptions& options = job.options();
  const auto check = [&] {
    job.check();
    if (options.kept_beside().empty()) {
      throw InvalidArgument(
          fmt::format("{}: several processes need --out, --svg or --ply with a FILE, because finished parts are stored "
                      "beside FILE",
                      Job::verb));
    }
    options.isa.select();
  };
  run_on_ranks(options.threads, check, [&](batch::Ranks& ranks, const batch::Surroundings& surroundings) {
    const Clock::time_point begin = Clock::now();
    RankedParts parts(Job::verb, folder_beside(options.kept_beside()), ranks, surroundings);
    batch::agree_on_version(ranks, surroundings.version);
    FacetResult* result = nullptr;
    batch::on_all(ranks, [&] { result = &job.prepare(); });
    const batch::JobDescription description = describe(job, *result, ranks, surroundings);
    batch::on_first(ranks, [&] { parts.open(description); });
    parts.begin(description, job.parts(), job.pairs());

    std::uint64_t threads = 0;
    surroundings.on_threads([&] { threads = static_cast<std::uint64_t>(concurrency()); });
    const std::function<Part(std::size_t)> answer = [&](std::size_t part) { return job.answer(part); };
    const std::function<void(std::size_t, const Part&)> note = [](std::size_t, const Part&) {};
    parts.find_finished(note);
    parts.compute(answer, note);

    batch::on_first(ranks, [&] {
      for (std::size_t part = 0; part != job.parts(); ++part) job.add(part, parts.template stored<Part>(part));
      surroundings.on_threads([&] { job.join(); });
    });
    ranks.sum({&threads, 1});
    batch::on_first(ranks, [&] {
      result->threads = static_cast<int>(threads);
      result->ranks = ranks.size();
      result->seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      result->memory = peak_memory();
      job.write();
      parts.remove();
    });
  });
}

}  // namespace shaftcull::cli
