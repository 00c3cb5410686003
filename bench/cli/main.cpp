/// The program `shaftcull`.
#include <array>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "shaftcull/isa.hpp"
#include "subcommand.hpp"

namespace {

using namespace shaftcull::cli;

#ifdef SHAFTCULL_CLI_WITH_VERIFY
constexpr std::array subcommands{add_demo, add_cull, add_stats, add_draw, add_verify, add_bench_report};
#else
constexpr std::array subcommands{add_demo, add_cull, add_stats, add_draw, add_bench_report};
#endif

std::string version() {
  std::string isas;
  for (const shaftcull::Isa isa : shaftcull::available_isas()) isas += fmt::format(" {}", shaftcull::name(isa));
  const shaftcull::IsaChoice choice = shaftcull::isa_choice();
  return fmt::format("shaftcull {} (this machine runs:{}; in use: {}{}{})", SHAFTCULL_VERSION, isas,
                     shaftcull::name(choice.running), choice.refusal.empty() ? "" : "; ", choice.refusal);
}

/// Reports an error in a single line, whatever the text that others gave us looks like.
int complain(std::string what, ExitCode code) {
  for (char& c : what) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (!what.empty() && what.back() == ' ') what.pop_back();
  fmt::print(stderr, "shaftcull: {}\n", what);
  return code;
}

int run(int argc, char** argv) {
  CLI::App program{"Shaft culling: which of millions of bounds may lie between two boxes?", "shaftcull"};
  program.set_version_flag("--version", version);
  program.require_subcommand(1);
  program.footer(
      "SHAFTCULL_ISA=scalar|sse4_2|avx2|avx512 in the environment forces an instruction set.\n"
      "Exit code: 0; 2 if an option, the environment or a file cannot be used; 1 after any other failure.");
  for (const auto add : subcommands) add(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return program.exit(error);
    return complain(fmt::format("{} (see shaftcull --help)", error.what()), exit_bad_input);
  }
  return std::fflush(stdout) == 0 ? exit_ok : complain("standard output cannot be written", exit_failure);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::invalid_argument& error) {
    return complain(error.what(), exit_bad_input);
  } catch (const std::bad_alloc&) {
    return complain("out of memory; ask for fewer bounds or shafts", exit_failure);
  } catch (const std::exception& error) {
    return complain(error.what(), exit_failure);
  }
}
