// SPDX-License-Identifier: MIT
/// JSON that remembers on which line each of its parts stands, so that errors can name it.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace shaftcull::cli {

/// A value of a JSON text. What it lacks, or is not, it tells in an InvalidArgument that names its line and its place:
/// "line 7: results/form/batch/per_s is \"fast\", not a number".
class JsonPart {
 public:
  [[nodiscard]] JsonPart at(const std::string& key) const;
  /// Nothing but whether there is such a member.
  [[nodiscard]] bool has(const std::string& key) const;
  [[nodiscard]] std::vector<JsonPart> elements() const;
  [[nodiscard]] std::vector<std::pair<std::string, JsonPart>> members() const;
  [[nodiscard]] bool is_null() const { return json_->is_null(); }
  [[nodiscard]] double number() const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string text() const;

  /// Throws InvalidArgument: "line 7: results/form/batch/per_s `what`".
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  friend class JsonText;
  using Json = nlohmann::ordered_json;
  using Lines = std::map<std::string, std::size_t>;  ///< by place

  JsonPart(const Json& json, const Lines& lines, std::string place)
      : json_(&json), lines_(&lines), place_(std::move(place)) {}
  [[nodiscard]] JsonPart inner(const std::string& key, const Json& json) const;
  void require(bool is_it, const char* kind) const;

  const Json* json_;
  const Lines* lines_;
  std::string place_;
};

/// A JSON text. It must outlive its parts.
class JsonText {
 public:
  /// Throws InvalidArgument, which names a line, if `text` is not JSON.
  explicit JsonText(const std::string& text);
  JsonText(const JsonText&) = delete;
  JsonText& operator=(const JsonText&) = delete;
  ~JsonText() = default;

  [[nodiscard]] JsonPart root() const { return {json_, lines_, ""}; }

 private:
  JsonPart::Json json_;
  JsonPart::Lines lines_;
};

}  // namespace shaftcull::cli
