// SPDX-License-Identifier: MIT
#include "report/json_text.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Where a reader of a text is.
struct Position {
  std::size_t line = 1;  ///< of the last character that was read
  bool line_ended = false;
};

/// Reads a text and keeps track of its lines.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, Position* position) : at_(at), position_(position) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    // The character behind a number is read before the number is known, so the end of a line is still on the line.
    if (position_->line_ended) ++position_->line;
    position_->line_ended = *at_ == '\n';
    ++at_;
    return *this;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.at_ == b.at_; }

 private:
  const char* at_;
  Position* position_;
};

std::string joined(const std::string& place, const std::string& key) { return place.empty() ? key : place + '/' + key; }

/// Notes the line of each value while the parser goes through a text: that of its key, or, in an array, its own.
class LineNotes {
 public:
  LineNotes(const Position& position, std::map<std::string, std::size_t>& lines) : position_(position), lines_(lines) {}

  void note(Json::parse_event_t event, const Json& parsed) {
    switch (event) {
      case Json::parse_event_t::key:
        open_.back().key = parsed.get<std::string>();
        lines_[joined(open_.back().place, open_.back().key)] = position_.line;
        break;
      case Json::parse_event_t::object_start:
        open(false);
        break;
      case Json::parse_event_t::array_start:
        open(true);
        break;
      case Json::parse_event_t::value:
        place_of_value();
        break;
      case Json::parse_event_t::object_end:
      case Json::parse_event_t::array_end:
        open_.pop_back();
        break;
    }
  }

 private:
  struct Open {
    std::string place;
    bool is_array;
    std::string key;
    std::size_t elements = 0;
  };

  void open(bool is_array) {
    const std::string place = place_of_value();
    open_.push_back({place, is_array, "", 0});
  }

  std::string place_of_value() {
    if (open_.empty()) {
      lines_[""] = position_.line;
      return "";
    }
    Open& around = open_.back();
    if (!around.is_array) return joined(around.place, around.key);
    std::string place = joined(around.place, std::to_string(around.elements++));
    lines_[place] = position_.line;
    return place;
  }

  const Position& position_;
  std::map<std::string, std::size_t>& lines_;
  std::vector<Open> open_;
};

/// A value in few characters.
std::string shown(const Json& json) {
  if (json.is_object()) return "an object";
  if (json.is_array()) return "a list";
  constexpr std::size_t most = 40;
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= most ? text : "a text";
}

}  // namespace

JsonText::JsonText(const std::string& text) {
  Position position;
  LineNotes notes(position, lines_);
  const CountingIterator begin(text.data(), &position);
  const CountingIterator end(text.data() + text.size(), &position);
  try {
    json_ = Json::parse(begin, end, [&](int /*depth*/, Json::parse_event_t event, Json& parsed) {
      notes.note(event, parsed);
      return true;
    });
  } catch (const Json::parse_error& error) {
    const std::size_t read = std::min<std::size_t>(error.byte, text.size());
    const auto at = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(read), '\n');
    throw InvalidArgument(error.byte > text.size() ? fmt::format("line {}: cut short: the text ends within a value", at)
                                                   : fmt::format("line {}: not JSON", at));
  } catch (const Json::out_of_range&) {
    throw InvalidArgument(fmt::format("line {}: a number is too large", position.line));
  }
}

void JsonPart::refuse(const std::string& what) const {
  const auto found = lines_->find(place_);
  const std::size_t line = found == lines_->end() ? 1 : found->second;
  throw InvalidArgument(fmt::format("line {}: {} {}", line, place_.empty() ? "the whole" : place_, what));
}

void JsonPart::require(bool is_it, const char* kind) const {
  if (!is_it) refuse(fmt::format("is {}, not {}", shown(*json_), kind));
}

JsonPart JsonPart::inner(const std::string& key, const Json& json) const {
  return {json, *lines_, joined(place_, key)};
}

bool JsonPart::has(const std::string& key) const {
  require(json_->is_object(), "an object");
  return json_->contains(key);
}

JsonPart JsonPart::at(const std::string& key) const {
  if (!has(key)) refuse(fmt::format("lacks '{}'", key));
  return inner(key, (*json_)[key]);
}

std::vector<JsonPart> JsonPart::elements() const {
  require(json_->is_array(), "a list");
  std::vector<JsonPart> parts;
  for (std::size_t i = 0; i < json_->size(); ++i) parts.push_back(inner(std::to_string(i), (*json_)[i]));
  return parts;
}

std::vector<std::pair<std::string, JsonPart>> JsonPart::members() const {
  require(json_->is_object(), "an object");
  std::vector<std::pair<std::string, JsonPart>> parts;
  for (const auto& [key, value] : json_->items()) parts.emplace_back(key, inner(key, value));
  return parts;
}

double JsonPart::number() const {
  require(json_->is_number(), "a number");
  return json_->get<double>();
}

bool JsonPart::boolean() const {
  require(json_->is_boolean(), "true or false");
  return json_->get<bool>();
}

std::string JsonPart::text() const {
  require(json_->is_string(), "a text");
  return json_->get<std::string>();
}

}  // namespace shaftcull::cli
