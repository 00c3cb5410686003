// SPDX-License-Identifier: MIT
/// `shaftcull batch`: what do very many shafts keep of very many bounds?
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "batch_job.hpp"
#include "instruction_set.hpp"
#include "number.hpp"
#include "shaftcull/error.hpp"
#include "subcommand.hpp"
#include "workers.hpp"

namespace shaftcull::cli {
namespace {

struct BatchOptions {
  batch::Job job;
  std::vector<double> origin;
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
      "Tell of a whole file of shafts what each keeps of a file of bounds, on one machine or, with MPI, on many");
  batch.add_option("--bounds", job.bounds, "Boxes (N x 6), spheres (N x 4) or triangles (N x 9)")->type_name("ARRAY");
  batch.add_option("--shafts", job.shafts, "Two boxes a row (N x 12), or positions of two of --boxes (N x 2)")
      ->type_name("ARRAY");
  batch.add_option("--boxes", job.boxes, "Boxes (N x 6) that --shafts has positions of")->type_name("ARRAY");
  add_choice<batch::ShaftKind>(
      batch, "--kinds", job.question.kind,
      by_name({batch::ShaftKind::between, batch::ShaftKind::shadow, batch::ShaftKind::swept, batch::ShaftKind::sun}),
      "What rows of --shafts are: between two boxes; the shadow of a light and an occluder; a box "
      "swept by a vector, or towards it without end (N x 9) (default: between)")
      ->type_name("KIND");
  add_choice<batch::Answer>(
      batch, "--answer", job.question.answer,
      by_name({batch::Answer::count, batch::Answer::list, batch::Answer::classify, batch::Answer::first,
               batch::Answer::occluded}),
      "How many bounds each shaft keeps; which; which overlap it and which are inside; which it "
      "reaches first, and when; whether one of the bounds, solid boxes, blocks it (default: count)")
      ->type_name("ANSWER");
  add_choice<Contact>(batch, "--contact", job.question.contact, {{"closed", Contact::closed}, {"open", Contact::open}},
                      "Whether bounds are kept that only touch a shaft, closed, or not, open (default: closed)")
      ->type_name("CONTACT");
  batch
      .add_option("--origin", options->origin,
                  "Subtract this point from arrays of float64 before they are rounded to floats (default: 0,0,0)")
      ->type_name("X,Y,Z")
      ->delimiter(',')
      ->expected(3);
  batch.add_option("--out", job.out, "The HDF5 file to write; FILE.parts/ holds what is finished until then")
      ->type_name("FILE");
  add_number(batch, "--memory", options->megabytes, 1, std::numeric_limits<std::uint64_t>::max() >> 20,
             "MB that bounds may take in a rank; if they take more, they are dealt into shares (default: no limit)")
      ->type_name("MB");
  add_number(batch, "--block", job.block, 1, 1'000'000'000,
             "Shafts that are dealt and stored at once (default: 65536, of lists 16384)")
      ->type_name("N");
  add_choice<batch::ProgressForm>(
      batch, "--progress", job.progress,
      {{"none", batch::ProgressForm::none}, {"text", batch::ProgressForm::text}, {"json", batch::ProgressForm::json}},
      "A line a second on standard error: none, text or json (default: text)")
      ->type_name("FORM");
  batch.add_option("--log", job.log, "Write when each rank did what to FILE.RANK, as CSV")->type_name("FILE");
  add_number(batch, "--threads", options->threads, 0, most_threads,
             "Threads of each rank, 0 for all it may use; answers do not depend on it (default: 0)")
      ->type_name("N");
  options->isa.add_option(batch);
  batch.footer(
      "An ARRAY is FILE.npy, of NumPy, or FILE.h5:/dataset, of HDF5: float32, positions int32, uint32, int64 or "
      "uint64.\n"
      "Boxes and spheres of float64 become such of float32 that contain them, and vertices the nearest floats.\n"
      "mpirun or srun start it on many machines, one rank a machine or socket; the file is the same. A run that was\n"
      "ended in any way is started again with the same command, and goes on.");
  batch.callback([options] {
    batch::Job& wanted = options->job;
    wanted.memory = options->megabytes << 20;
    const std::vector<double>& origin = options->origin;
    for (const double x : origin) {
      if (!std::isfinite(x))
        throw InvalidArgument(fmt::format("--origin {}: give finite numbers", fmt::join(origin, ",")));
    }
    if (!origin.empty()) wanted.origin = Origin({origin[0], origin[1], origin[2]});
    run_batch_job(wanted, options->threads, [&] {
      if (wanted.bounds.empty()) throw InvalidArgument("batch: which bounds? Add --bounds ARRAY");
      if (wanted.shafts.empty()) throw InvalidArgument("batch: which shafts? Add --shafts ARRAY");
      if (wanted.out.empty()) throw InvalidArgument("batch: where to? Add --out FILE.h5");
      options->isa.select();
    });
  });
}

}  // namespace shaftcull::cli
