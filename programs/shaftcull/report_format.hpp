// SPDX-License-Identifier: MIT
/// The formats that reports are printed in.
#pragma once

#include <cstdint>
#include <string_view>

namespace shaftcull::cli {

/// What `--format` chooses.
enum class ReportFormat : std::uint8_t { text, json, csv };

/// The format of that name, "json" say; text for any other.
[[nodiscard]] inline ReportFormat report_format(std::string_view name) {
  if (name == "json") return ReportFormat::json;
  return name == "csv" ? ReportFormat::csv : ReportFormat::text;
}

}  // namespace shaftcull::cli
