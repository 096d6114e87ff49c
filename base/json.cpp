#include "base/json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace lucarne {
namespace {

using nlohmann::json;

void requireFinite(const json& value, const std::string& place) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    throw std::logic_error("a number that is not finite cannot be written as JSON: " + place);
  }
  if (!value.is_structured()) return;
  for (const auto& item : value.items()) requireFinite(item.value(), place + "/" + item.key());
}

/// Counts brackets outside of strings. The parser itself does not recurse, but what walks its result does.
void requireShallow(std::span<const std::uint8_t> bytes, const std::string& name) {
  int depth = 0;
  bool inString = false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::uint8_t c = bytes[i];
    if (inString && c == '\\') {
      ++i;
    } else if (c == '"') {
      inString = !inString;
    } else if (!inString && (c == '[' || c == '{')) {
      if (++depth > kMaxJsonDepth) {
        throw InputError(name + ": JSON nested more than " + std::to_string(kMaxJsonDepth) + " deep");
      }
    } else if (!inString && (c == ']' || c == '}')) {
      --depth;
    }
  }
}

/// "line 3, column 7" of the byte before `count`.
std::string positionOf(std::span<const std::uint8_t> bytes, std::size_t count) {
  const auto text = bytes.first(std::min(count, bytes.size()));
  const auto lines = std::count(text.begin(), text.end(), '\n');
  const auto lineStart = std::find(text.rbegin(), text.rend(), '\n').base();
  return "line " + std::to_string(lines + 1) + ", column " + std::to_string(text.end() - lineStart);
}

/// The parser's reason without its number, its own position, and what cannot be printed.
std::string reasonOf(const std::exception& error) {
  constexpr std::size_t kLongest = 120;
  std::string reason = error.what();
  for (const char* before : {"] ", ": "}) {
    if (const std::size_t at = reason.find(before); at != std::string::npos) reason.erase(0, at + 2);
  }
  reason.resize(std::min(reason.size(), kLongest));
  std::replace_if(
      reason.begin(), reason.end(), [](char c) { return c < 32 || c > 126; }, '?');
  return reason;
}

}  // namespace

std::string dumpJson(const json& value) {
  requireFinite(value, "");
  return value.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

json parseJson(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.size() > kMaxJsonBytes) {
    throw InputError(name + ": JSON of more than " + std::to_string(kMaxJsonBytes) + " bytes");
  }
  requireShallow(bytes, name);
  try {
    return json::parse(bytes.begin(), bytes.end());
  } catch (const json::parse_error& error) {
    throw InputError(name + ": not valid JSON at " + positionOf(bytes, error.byte) + ": " + reasonOf(error));
  } catch (const json::exception& error) {
    throw InputError(name + ": not valid JSON: " + reasonOf(error));
  }
}

void JsonView::refuse(const std::string& reason) const {
  throw InputError(file_ + ": " + (place_.empty() ? "the document" : place_) + " " + reason);
}

bool JsonView::has(const std::string& key) const { return value_.is_object() && value_.contains(key); }

JsonView JsonView::at(const std::string& key) const {
  if (!value_.is_object()) refuse("must be an object");
  const std::string place = place_.empty() ? key : place_ + "." + key;
  const auto found = value_.find(key);
  if (found == value_.end()) throw InputError(file_ + ": " + place + " is missing");
  return {*found, file_, place};
}

JsonView JsonView::at(std::size_t index) const {
  if (index >= size()) refuse("has only " + std::to_string(size()) + " elements");
  return {value_[index], file_, place_ + "[" + std::to_string(index) + "]"};
}

std::size_t JsonView::size() const {
  if (!value_.is_array()) refuse("must be an array");
  return value_.size();
}

double JsonView::number() const {
  if (!value_.is_number()) refuse("must be a number");
  return value_.get<double>();
}

std::int64_t JsonView::integer(std::int64_t lowest, std::int64_t highest) const {
  const std::string range = std::to_string(lowest) + " to " + std::to_string(highest);
  if (!value_.is_number_integer()) refuse("must be a whole number");
  const bool isHuge = value_.is_number_unsigned() && value_.get<std::uint64_t>() > std::uint64_t{INT64_MAX};
  if (isHuge || value_.get<std::int64_t>() < lowest || value_.get<std::int64_t>() > highest) {
    refuse("must be a whole number from " + range);
  }
  return value_.get<std::int64_t>();
}

std::uint64_t JsonView::count() const {
  if (!value_.is_number_unsigned()) refuse("must be a whole number, not negative");
  return value_.get<std::uint64_t>();
}

bool JsonView::flag() const {
  if (!value_.is_boolean()) refuse("must be true or false");
  return value_.get<bool>();
}

std::string JsonView::text() const {
  if (!value_.is_string()) refuse("must be text");
  return value_.get<std::string>();
}

std::vector<double> JsonView::numbers(std::size_t size) const {
  if (this->size() != size) refuse("must have " + std::to_string(size) + " elements");
  std::vector<double> values;
  for (std::size_t i = 0; i < size; ++i) values.push_back(at(i).number());
  return values;
}

}  // namespace lucarne
