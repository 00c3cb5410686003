// SPDX-License-Identifier: MIT
/// A job: many shafts, many bounds, one question, a file of answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "batch/dealing.hpp"
#include "batch/progress_lines.hpp"
#include "batch/question.hpp"
#include "batch/ranks.hpp"
#include "shaftcull/origin.hpp"

namespace shaftcull::batch {

/// What the user gives.
struct Job {
  std::string bounds;  ///< arrays: "FILE.npy" or "FILE.h5:/dataset"
  std::string shafts;
  std::string boxes;  ///< empty unless shafts are positions
  std::string out;    ///< the HDF5 file to make
  Origin origin;      ///< that arrays of float64 become floats relative to
  Question question;
  std::uint64_t block = 0;   ///< shafts a block; 0 for a number that fits the question
  std::uint64_t memory = 0;  ///< bytes that bounds may take in a rank; 0 for as many as they take
  ProgressForm progress = ProgressForm::text;
  std::string log;  ///< as WorkLog has it; may be empty
};

/// What a run did.
struct JobReport {
  std::uint64_t shafts = 0;
  std::uint64_t bounds = 0;
  BoundKind bound_kind = BoundKind::box;
  std::uint64_t blocks = 0;         ///< of shafts
  std::uint64_t shares = 1;         ///< of bounds
  std::uint64_t blocks_before = 0;  ///< blocks of shares that earlier runs had finished
  double seconds = 0;
};

/// All ranks: does the job, or goes on with it where an earlier run of the same job ended; the file is the same,
/// whatever the number of ranks, threads and runs, and whatever the memory.
///
/// Bounds are built into a tree (JobTrees). Shafts are dealt to the ranks in blocks, whoever is free takes the next
/// one, and answers of each are stored in the folder OUT.parts/ at once. If all bounds together take more than
/// `memory`, they are dealt into shares that take no more (SharePlan), whose trees are stored in the folder as well. A
/// rank has one share at a time; it begins with another one than others do, and goes on to the next when all blocks of
/// this one are dealt. When all blocks of all shares are there, ranks merge them into the file, which gets its name
/// when it is whole; then the folder is removed.
///
/// Throws on all ranks as on_all() does: InvalidArgument for what cannot be used, Stopped after a signal, when blocks
/// under way are stored; std::runtime_error if a file cannot be read or written.
JobReport run_job(const Job& job, Ranks& ranks, const Surroundings& surroundings);

}  // namespace shaftcull::batch
