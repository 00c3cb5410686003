// SPDX-License-Identifier: MIT
/// `shaftcull batch`: what do very many shafts keep of very many bounds?
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>

#include "batch_job.hpp"
#include "instruction_set.hpp"
#include "number.hpp"
#include "origin_option.hpp"
#include "shaftcull/error.hpp"
#include "subcommand.hpp"
#include "workers.hpp"

namespace shaftcull::cli {
namespace {

struct BatchOptions {
  batch::Job job;
  OriginOption origin;
  std::uint64_t megabytes = 0;
  int threads = 0;
  InstructionSet isa;
};

/// Values by their names.
template <class Value>
std::map<std::string, Value> by_name(std::initializer_list<Value> values) {
  std::map<std::string, Value> names;
  for (const Value value : values) names.emplace(name_of(value), value);
  return names;
}

/// An option whose value is one of some words.
template <class Value>
CLI::Option* add_choice(CLI::App& subcommand, const std::string& option, Value& value,
                        const std::map<std::string, Value>& words, const std::string& description) {
  const auto store = [&value, words](const std::string& word) { value = words.at(word); };
  return subcommand.add_option_function<std::string>(option, store, description)->check(CLI::IsMember(words));
}

}  // namespace

void add_batch(CLI::App& program) {
  const auto options = std::make_shared<BatchOptions>();
  batch::Job& job = options->job;
  CLI::App& batch = *program.add_subcommand(
      "batch",
      "List the bounds of one file that each shaft of another file keeps, on one machine or, with MPI, on many");
  batch.add_option("--bounds", job.bounds, "Boxes (N x 6), spheres (N x 4) or triangles (N x 9)")->type_name("ARRAY");
  batch.add_option("--shafts", job.shafts, "Two boxes per row (N x 12), or positions of two boxes in --boxes (N x 2)")
      ->type_name("ARRAY");
  batch.add_option("--boxes", job.boxes, "Boxes (N x 6) to which the positions in --shafts refer")->type_name("ARRAY");
  add_choice<batch::ShaftKind>(
      batch, "--kinds", job.question.kind,
      by_name({batch::ShaftKind::between, batch::ShaftKind::shadow, batch::ShaftKind::swept, batch::ShaftKind::sun}),
      "Kind of shaft in all rows of --shafts (default: between)\n"
      "between: two boxes; shadow: a light and an occluder; swept: a box and its displacement (N x 9);\n"
      "sun: a box and a direction in which it is swept without end (N x 9)")
      ->type_name("KIND");
  add_choice<batch::Answer>(
      batch, "--answer", job.question.answer,
      by_name({batch::Answer::count, batch::Answer::list, batch::Answer::classify, batch::Answer::first,
               batch::Answer::occluded}),
      "Answers for each shaft (default: count)\n"
      "count: how many bounds it keeps; list: which bounds it keeps; classify: which overlap it, and which are "
      "inside;\n"
      "first: which it reaches first, and when; occluded: whether one of the bounds, as a solid box, blocks it")
      ->type_name("ANSWER");
  add_choice<Contact>(batch, "--contact", job.question.contact, {{"closed", Contact::closed}, {"open", Contact::open}},
                      "Bounds that only touch a shaft: closed keeps them, open does not (default: closed)")
      ->type_name("CONTACT");
  options->origin.add_option(
      batch, "Subtract this point from arrays of float64 before they are rounded to floats (default: 0,0,0)");
  batch.add_option("--out", job.out, "The HDF5 file to write; FILE.parts/ holds partial results until it is complete")
      ->type_name("FILE");
  add_number(batch, "--memory", options->megabytes, 1, std::numeric_limits<std::uint64_t>::max() >> 20,
             "MB that bounds may take in each rank; bounds that need more are divided into shares (default: no limit)")
      ->type_name("MB");
  add_number(batch, "--block", job.block, 1, 1'000'000'000,
             "Shafts per block, the unit that ranks take and store (default: 65536, for lists 16384)")
      ->type_name("N");
  add_choice<batch::ProgressForm>(
      batch, "--progress", job.progress,
      {{"none", batch::ProgressForm::none}, {"text", batch::ProgressForm::text}, {"json", batch::ProgressForm::json}},
      "One line per second on standard error: none, text or json (default: text)")
      ->type_name("FORM");
  batch.add_option("--log", job.log, "Write the times of all steps of each rank to FILE.RANK, as CSV")
      ->type_name("FILE");
  add_number(batch, "--threads", options->threads, 0, most_threads,
             "Threads of each rank, 0 for all that it may use; answers do not depend on it (default: 0)")
      ->type_name("N");
  options->isa.add_option(batch);
  batch.footer(
      "An ARRAY is FILE.npy, of NumPy, or FILE.h5:/dataset, of HDF5. Numbers are float32; positions are int32,\n"
      "uint32, int64 or uint64. Boxes and spheres of float64 are rounded to boxes and spheres of float32 that\n"
      "contain them (bounds of --answer occluded, to boxes within them), and vertices to the nearest floats.\n"
      "To run on many machines, start the program with mpirun or srun, with one rank per machine or socket.\n"
      "The file is the same. However a run was ended, the same command resumes it.");
  batch.callback([options] {
    batch::Job& wanted = options->job;
    wanted.memory = options->megabytes << 20;
    if (options->origin.value()) wanted.origin = Origin(*options->origin.value());
    run_batch_job(wanted, options->threads, [&] {
      if (wanted.bounds.empty()) throw InvalidArgument("batch: no bounds are given; add --bounds ARRAY");
      if (wanted.shafts.empty()) throw InvalidArgument("batch: no shafts are given; add --shafts ARRAY");
      if (wanted.out.empty()) throw InvalidArgument("batch: no output file is given; add --out FILE.h5");
      options->isa.select();
    });
  });
}

}  // namespace shaftcull::cli
