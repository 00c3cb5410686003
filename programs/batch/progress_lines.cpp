// SPDX-License-Identifier: MIT
#include "batch/progress_lines.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace shaftcull::batch {
namespace {

constexpr auto pause = std::chrono::seconds(1);

std::string rate_text(double rate, const char* things) {
  constexpr std::array units{"", "k", "M", "G"};
  std::size_t unit = 0;
  for (; rate >= 1000 && unit + 1 < units.size(); ++unit) rate /= 1000;
  return fmt::format("{:.3g} {}{}/s", rate, units[unit], things);
}

}  // namespace

std::string progress_line(const ProgressState& state, ProgressForm form) {
  const std::uint64_t now = state.blocks_done - state.blocks_before;
  const bool known = now != 0 && state.seconds > 0;
  const double rate = known ? static_cast<double>(now) * state.things_a_block / state.seconds : 0;
  const double left = known ? static_cast<double>(state.blocks - state.blocks_done) * state.things_a_block / rate : 0;
  if (form == ProgressForm::json) {
    const auto number = [&](double value) { return known ? fmt::format("{:.6g}", value) : std::string("null"); };
    return fmt::format(
        R"({{"phase":"{}","blocks_done":{},"blocks":{},"blocks_before":{},"seconds":{:.3f},"{}_per_second":{},)"
        R"("seconds_left":{}}})",
        state.phase, state.blocks_done, state.blocks, state.blocks_before, state.seconds, state.things, number(rate),
        number(left));
  }
  std::string text = fmt::format("{}: {} of {} {}", state.phase, state.blocks_done, state.blocks, state.pieces);
  if (state.blocks_before != 0) text += fmt::format(" ({} from an earlier run)", state.blocks_before);
  if (known) text += fmt::format(", {}, {:.0f} s left", rate_text(rate, state.things), std::ceil(left));
  return text;
}

bool ProgressLines::due(Clock::time_point now) const { return form_ != ProgressForm::none && now - last_ >= pause; }

void ProgressLines::write(const ProgressState& state, Clock::time_point now) {
  if (form_ == ProgressForm::none || (!due(now) && state.blocks_done != state.blocks)) return;
  last_ = now;
  const std::string line = progress_line(state, form_) + '\n';
  static_cast<void>(std::fwrite(line.data(), 1, line.size(), file_));
  std::fflush(file_);
}

}  // namespace shaftcull::batch
