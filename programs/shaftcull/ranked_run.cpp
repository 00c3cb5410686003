// SPDX-License-Identifier: MIT
#include "ranked_run.hpp"

#include <exception>
#include <memory>
#include <optional>

#include "complaint.hpp"
#include "interrupt.hpp"
#include "subcommand.hpp"
#include "workers.hpp"

namespace shaftcull::cli {

void run_on_ranks(int threads, const std::function<void()>& check,
                  const std::function<void(batch::Ranks&, const batch::Surroundings&)>& work) {
  std::unique_ptr<batch::Ranks> ranks;
  try {
    ranks = batch::launched_ranks();
    std::optional<Workers> workers;
    batch::on_all(*ranks, [&] {
      check();
      workers.emplace(threads);
    });
    const InterruptWatch interrupt;
    const auto on_threads = [&](const std::function<void()>& some) { workers->run(some); };
    work(*ranks, batch::Surroundings{on_threads, [&] { return interrupt.signal(); }});
  } catch (const batch::OtherRankFailed& other) {
    if (ranks) ranks->meet();
    throw EarlyExit(ranks ? other.code() : exit_ok);
  } catch (const std::exception& error) {
    const bool lacks_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
    const int code = complain(lacks_memory ? "out of memory; set a limit with --memory" : error.what(),
                              batch::exit_code_of(std::current_exception()));
    if (ranks) {
      // Where others do not know of it, they would wait for this rank for ever. Where they do, they wait until it is
      // said: a launcher ends all when the first of them ends.
      if (ranks->size() > 1 && !ranks->have_failed()) ranks->abort(code);
      ranks->meet();
    }
    throw EarlyExit(code);
  }
}

}  // namespace shaftcull::cli
