// SPDX-License-Identifier: MIT
/// The program `shaftcull`.
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "batch/launcher.hpp"
#include "complaint.hpp"
#include "instruction_set.hpp"
#include "interrupt.hpp"
#include "name_search.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/version.hpp"
#include "standard_streams.hpp"
#include "subcommand.hpp"

namespace {

using namespace shaftcull::cli;

#ifdef SHAFTCULL_CLI_WITH_VERIFY
constexpr std::array subcommands{add_demo,  add_cull,  add_sees, add_factors, add_sun,
                                 add_batch, add_stats, add_draw, add_verify,  add_hash};
#else
constexpr std::array subcommands{add_demo,  add_cull,  add_sees, add_factors, add_sun,
                                 add_batch, add_stats, add_draw, add_hash};
#endif

std::string version() {
  std::string isas;
  for (const shaftcull::Isa isa : shaftcull::available_isas()) isas += fmt::format(" {}", shaftcull::name(isa));
  const shaftcull::IsaChoice choice = shaftcull::isa_choice();
  return fmt::format("shaftcull {} (this machine runs:{}; in use: {}{}{})", SHAFTCULL_VERSION_STRING, isas,
                     shaftcull::name(choice.running), choice.refusal.empty() ? "" : "; ", choice.refusal);
}

/// Ends a run whose output is complete, or is found not to have arrived.
int finish_output(int code) {
  errno = 0;
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (written) return code;
  const std::string why = errno != 0 ? fmt::format(": {}", std::strerror(errno)) : "";
  return complain(fmt::format("standard output cannot be written{}", why), exit_failure);
}

/// What is wrong with a command line that names no subcommand.
std::string missing_subcommand(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* const subcommand : program.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(subcommand->get_name());
  }
  const std::vector<std::string> unknown = program.remaining();
  if (unknown.empty()) return fmt::format("no subcommand is given; the subcommands are {}", closest_names("", names));
  const std::string& first = unknown.front();
  if (first.starts_with('-')) {
    return fmt::format("{}: the program itself has no such option; options go after the subcommand that they belong to",
                       first);
  }
  std::error_code ignored;
  if (std::filesystem::is_regular_file(first, ignored)) {
    return fmt::format(
        "{} is a file, not a subcommand; to list the objects of a mesh that lie between two others: shaftcull cull {}",
        first, first);
  }
  return fmt::format("there is no subcommand '{}'; the subcommands are {}", first, closest_names(first, names));
}

/// Reports options that cannot be used. Of processes that were launched together, with the same ones, the first does
/// so; the others end well, or the launcher might end the first before it has.
int complain_of_options(const std::vector<std::string>& words, const std::string& what) {
  const bool batch = words.size() > 1 && words[1] == "batch";
  return batch && shaftcull::batch::launch().process != 0 ? exit_ok : complain(what, exit_bad_input);
}

int run(const std::vector<std::string>& words) {
  CLI::App program{"Shaft culling: finds the bounds, among millions, that may lie between two boxes", "shaftcull"};
  program.set_version_flag("--version", version, "Print the version, and the instruction set in use");
  program.require_subcommand(1);
  program.footer("The environment variable SHAFTCULL_ISA forces an instruction set. This machine has " +
                 available_names() +
                 ".\n"
                 "Exit code: 0 after success; 2 if an option, the environment or a file cannot be used; 128 +\n"
                 "the number of the signal if SIGINT or SIGTERM ended demo, sees, factors, sun, batch, verify\n"
                 "or hash (demo, verify and hash then print partial results); 1 after any other failure.");
  for (const auto add : subcommands) add(program);
  try {
    // The last one first, without the name of the program.
    program.parse(std::vector<std::string>(words.rbegin(), words.rend() - 1));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success)) {
      const bool known = !program.get_subcommands().empty();
      return complain_of_options(
          words, fmt::format("{} (see shaftcull {}--help)", known ? error.what() : missing_subcommand(program),
                             known ? program.get_subcommands().front()->get_name() + ' ' : ""));
    }
    std::ostringstream text;
    program.exit(error, text, text);
    static_cast<void>(std::fputs(text.str().c_str(), stdout));
  }
  return finish_output(exit_ok);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words;
  try {
    prepare_standard_streams();
    words = command_line(argc, argv);
    return run(words);
  } catch (const Interrupted& interrupted) {
    return finish_output(complain(interrupted.what(), 128 + interrupted.signal()));
  } catch (const EarlyExit& exit) {
    return exit.code();
  } catch (const std::invalid_argument& error) {
    return complain_of_options(words, error.what());
  } catch (const std::bad_alloc&) {
    return complain("out of memory; use fewer bounds or shafts", exit_failure);
  } catch (const std::exception& error) {
    return std::ferror(stdout) != 0 ? finish_output(exit_failure) : complain(error.what(), exit_failure);
  }
}
