#include "shaftcull/isa.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <string>

#include "dispatch/active_kernels.hpp"
#include "kernels/built_sets.hpp"
#include "kernels/table.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull {
namespace {

constexpr std::array<std::string_view, 4> names = {"scalar", "sse4_2", "avx2", "avx512"};

/// Whether the processor has the instructions and the operating system saves the registers.
bool machine_runs(Isa isa) noexcept {
  switch (isa) {
    case Isa::scalar:
      return true;
#ifdef __x86_64__
    case Isa::sse4_2:
      return __builtin_cpu_supports("sse4.2");
    case Isa::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
             __builtin_cpu_supports("bmi2");
    case Isa::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512vl") && machine_runs(Isa::avx2);
#endif
    default:
      return false;
  }
}

bool available(Isa isa) noexcept { return kernel::kernels_of(isa) != nullptr && machine_runs(isa); }

std::string list_of_available() {
  std::string list;
  for (const Isa isa : available_isas()) list += (list.empty() ? "" : ", ") + std::string(name(isa));
  return list;
}

/// All there are, the better ones later.
constexpr Isa all_isas[] = {Isa::scalar, Isa::sse4_2, Isa::avx2, Isa::avx512};

/// What SHAFTCULL_ISA says, or nothing.
std::string_view asked_for() noexcept {
  const char* text = std::getenv("SHAFTCULL_ISA");
  return text == nullptr ? std::string_view() : std::string_view(text);
}

/// The choice of the environment if there is one that can be followed, else the best there is.
Isa initial_isa() noexcept {
  const std::optional<Isa> wanted = isa_from_name(asked_for());
  if (wanted && available(*wanted)) return *wanted;
  Isa best = Isa::scalar;
  for (const Isa isa : all_isas) best = available(isa) ? isa : best;
  return best;
}

constexpr char lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

constexpr int not_chosen = -1;
constinit std::atomic<int> chosen = not_chosen;

}  // namespace

std::string_view name(Isa isa) noexcept {
  const auto i = static_cast<std::size_t>(isa);
  return i < names.size() ? names[i] : "unknown";
}

std::optional<Isa> isa_from_name(std::string_view text) noexcept {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto same = [](char a, char b) { return a == lower(b); };
    if (std::equal(names[i].begin(), names[i].end(), text.begin(), text.end(), same)) return static_cast<Isa>(i);
  }
  return std::nullopt;
}

std::vector<Isa> available_isas() {
  std::vector<Isa> isas;
  for (const Isa isa : all_isas) {
    if (available(isa)) isas.push_back(isa);
  }
  return isas;
}

Isa active_isa() noexcept {
  int isa = chosen.load(std::memory_order_relaxed);
  if (isa == not_chosen) {
    const int first = static_cast<int>(initial_isa());
    // A select_isa() that came in between wins.
    isa = chosen.compare_exchange_strong(isa, first, std::memory_order_relaxed) ? first : isa;
  }
  return static_cast<Isa>(isa);
}

IsaChoice isa_choice() {
  IsaChoice choice{std::string(asked_for()), {}, active_isa()};
  if (choice.asked.empty()) return choice;
  const std::optional<Isa> wanted = isa_from_name(choice.asked);
  if (wanted && available(*wanted)) return choice;
  choice.refusal = "SHAFTCULL_ISA=" + choice.asked +
                   (wanted ? " is not available here" : " is not an instruction set") + "; this machine has " +
                   list_of_available();
  return choice;
}

void select_isa(Isa isa) {
  if (static_cast<std::size_t>(isa) >= names.size()) {
    throw InvalidArgument("there is no instruction set number " + std::to_string(static_cast<int>(isa)) +
                          "; this machine has " + list_of_available());
  }
  if (!available(isa)) {
    throw InvalidArgument("instruction set " + std::string(name(isa)) + " is not available here; this machine has " +
                          list_of_available());
  }
  chosen.store(static_cast<int>(isa), std::memory_order_relaxed);
}

namespace kernel {

const Kernels& active_kernels() noexcept { return *kernels_of(active_isa()); }

}  // namespace kernel
}  // namespace shaftcull
