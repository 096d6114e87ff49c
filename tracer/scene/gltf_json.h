// Reading JSON that nobody vouches for: every access says what it wants and where it is, and a wrong type, a missing
// member or an index out of range is an InputError that names file and place.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "base/error.h"

namespace lucarne {

using Json = nlohmann::json;

/// A place in a file, "room.glb: meshes[3].primitives[0]", for error texts.
class Place {
 public:
  explicit Place(std::string text, bool isFile = true) : text_(std::move(text)), isFile_(isFile) {}
  Place in(std::string_view member) const { return Place(text_ + (isFile_ ? ": " : ".") + std::string(member), false); }
  Place in(std::string_view member, std::size_t index) const {
    return in(std::string(member) + "[" + std::to_string(index) + "]");
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(text_ + ": " + what); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool isFile_;
};

/// Parses JSON text. Refuses, before the parser sees it, nesting deeper than 128 and more than 2^24 values (the parsed
/// form takes many times the text's memory).
Json parseGltfJson(std::string_view text, const Place& file);

/// The member, or null where it is absent.
const Json* findMember(const Json& object, const char* key);
/// Elements of that member; 0 where it is absent.
std::size_t sizeOf(const Json& object, const char* key);
/// The member if present; fails unless it is of the named type.
const Json* findObject(const Json& object, const char* key, const Place& place);
const Json* findArray(const Json& object, const char* key, const Place& place);
/// The elements of an array of objects that may be absent; fails on anything else.
const Json& objectArray(const Json& object, const char* key, const Place& place);

/// Extension `name` of an object, or null.
const Json* findExtension(const Json& object, const char* name, const Place& place);

double numberOf(const Json& object, const char* key, double fallback, const Place& place);
bool flagOf(const Json& object, const char* key, bool fallback, const Place& place);
std::string textOf(const Json& object, const char* key, const std::string& fallback, const Place& place);
/// Whole number ≥ 0; also accepts 3.0.
std::uint64_t countOf(const Json& object, const char* key, std::uint64_t fallback, const Place& place);
std::uint64_t requiredCount(const Json& object, const char* key, const Place& place);
/// A reference to one of `size` things; kNone where it is absent.
std::uint32_t indexOf(const Json& object, const char* key, std::size_t size, const Place& place);
std::uint32_t requiredIndex(const Json& object, const char* key, std::size_t size, const Place& place);
/// One value as a reference.
std::uint32_t asIndex(const Json& value, std::size_t size, const Place& place);

/// `n` numbers; `fallback` where the member is absent.
template <std::size_t n>
std::array<double, n> numbersOf(const Json& object, const char* key, const std::array<double, n>& fallback,
                                const Place& place) {
  const Json* list = findArray(object, key, place);
  if (list == nullptr) return fallback;
  if (list->size() != n)
    place.in(key).fail("has " + std::to_string(list->size()) + " numbers, not " + std::to_string(n));
  std::array<double, n> values{};
  for (std::size_t i = 0; i < n; ++i) {
    if (!(*list)[i].is_number()) place.in(key, i).fail("is not a number");
    values[i] = (*list)[i].get<double>();
    if (!std::isfinite(values[i])) place.in(key, i).fail("is not finite");
  }
  return values;
}

}  // namespace lucarne
