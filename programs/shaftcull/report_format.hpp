// SPDX-License-Identifier: MIT
/// The formats that reports are printed in.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace shaftcull::cli {

/// What `--format` chooses.
enum class ReportFormat : std::uint8_t { text, json, csv };

/// The format of that name, "json" say; text for any other.
[[nodiscard]] inline ReportFormat report_format(std::string_view name) {
  if (name == "json") return ReportFormat::json;
  return name == "csv" ? ReportFormat::csv : ReportFormat::text;
}

/// The report as the function of that format writes it.
template <class Report>
[[nodiscard]] std::string in_format(ReportFormat format, const Report& report, std::string (*as_text)(const Report&),
                                    std::string (*as_json)(const Report&), std::string (*as_csv)(const Report&)) {
  switch (format) {
    case ReportFormat::json:
      return as_json(report);
    case ReportFormat::csv:
      return as_csv(report);
    case ReportFormat::text:
      break;
  }
  return as_text(report);
}

}  // namespace shaftcull::cli
