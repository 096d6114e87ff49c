#include "tracer/scene/gltf_json.h"

#include "tracer/scene/scene.h"

namespace lucarne {
namespace {

constexpr int kMaxDepth = 128;
constexpr std::size_t kMaxValues = std::size_t{1} << 24;

/// Depth and number of values, strings skipped; no recursion.
void scanJson(std::string_view text, const Place& file) {
  int depth = 0;
  std::size_t values = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') {
        ++i;
      } else if (c == '"') {
        inString = false;
      }
      continue;
    }
    if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      ++values;
      if (++depth > kMaxDepth) file.fail("its JSON is nested deeper than " + std::to_string(kMaxDepth) + " levels");
    } else if (c == '}' || c == ']') {
      --depth;
    } else if (c == ',') {
      ++values;
    }
    if (values > kMaxValues) file.fail("its JSON has more than " + std::to_string(kMaxValues) + " values");
  }
}

const Json* findTyped(const Json& object, const char* key, bool (Json::*is)() const noexcept, const char* what,
                      const Place& place) {
  const Json* member = findMember(object, key);
  if (member != nullptr && !(member->*is)()) place.in(key).fail(std::string("is not ") + what);
  return member;
}

std::uint64_t asCount(const Json& value, const Place& place) {
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  if (value.is_number()) {
    const double number = value.get<double>();
    if (number >= 0 && number <= 9007199254740992.0 && std::floor(number) == number) {
      return static_cast<std::uint64_t>(number);
    }
  }
  place.fail("is not a whole number of 0 or more");
}

}  // namespace

Json parseGltfJson(std::string_view text, const Place& file) {
  if (text.substr(0, 3) == "\xef\xbb\xbf")
    file.fail("its JSON starts with a byte order mark; save it as UTF-8 without one");
  scanJson(text, file);
  Json json;
  try {
    json = Json::parse(text.begin(), text.end());
  } catch (const Json::exception& e) {
    std::string reason = e.what();
    if (const std::size_t end = reason.find("] "); reason.starts_with("[json.exception.") && end != std::string::npos)
      reason.erase(0, end + 2);  // the library's own name for the error
    if (reason.size() > 200) reason.resize(200);
    for (char& c : reason) {
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
    }
    file.fail("its JSON cannot be read: " + reason);
  }
  if (!json.is_object()) file.fail("its JSON is not an object");
  return json;
}

const Json* findMember(const Json& object, const char* key) {
  const auto it = object.find(key);
  return it == object.end() ? nullptr : &*it;
}

std::size_t sizeOf(const Json& object, const char* key) {
  const Json* list = findMember(object, key);
  return list == nullptr ? 0 : list->size();
}

const Json* findObject(const Json& object, const char* key, const Place& place) {
  return findTyped(object, key, &Json::is_object, "an object", place);
}

const Json* findArray(const Json& object, const char* key, const Place& place) {
  return findTyped(object, key, &Json::is_array, "an array", place);
}

const Json& objectArray(const Json& object, const char* key, const Place& place) {
  static const Json none = Json::array();
  const Json* list = findArray(object, key, place);
  if (list == nullptr) return none;
  for (std::size_t i = 0; i < list->size(); ++i) {
    if (!(*list)[i].is_object()) place.in(key, i).fail("is not an object");
  }
  return *list;
}

const Json* findExtension(const Json& object, const char* name, const Place& place) {
  const Json* extensions = findObject(object, "extensions", place);
  return extensions == nullptr ? nullptr : findObject(*extensions, name, place.in("extensions"));
}

double numberOf(const Json& object, const char* key, double fallback, const Place& place) {
  const Json* member = findMember(object, key);
  if (member == nullptr) return fallback;
  if (!member->is_number()) place.in(key).fail("is not a number");
  const double value = member->get<double>();
  if (!std::isfinite(value)) place.in(key).fail("is not finite");
  return value;
}

bool flagOf(const Json& object, const char* key, bool fallback, const Place& place) {
  const Json* member = findTyped(object, key, &Json::is_boolean, "true or false", place);
  return member == nullptr ? fallback : member->get<bool>();
}

std::string textOf(const Json& object, const char* key, const std::string& fallback, const Place& place) {
  const Json* member = findTyped(object, key, &Json::is_string, "a string", place);
  return member == nullptr ? fallback : member->get_ref<const std::string&>();
}

std::uint64_t countOf(const Json& object, const char* key, std::uint64_t fallback, const Place& place) {
  const Json* member = findMember(object, key);
  return member == nullptr ? fallback : asCount(*member, place.in(key));
}

std::uint64_t requiredCount(const Json& object, const char* key, const Place& place) {
  if (findMember(object, key) == nullptr) place.fail(std::string("has no ") + key);
  return countOf(object, key, 0, place);
}

std::uint32_t asIndex(const Json& value, std::size_t size, const Place& place) {
  const std::uint64_t index = asCount(value, place);
  if (index >= size) {
    place.fail("refers to number " + std::to_string(index) + ", but there are " + std::to_string(size));
  }
  return static_cast<std::uint32_t>(index);
}

std::uint32_t indexOf(const Json& object, const char* key, std::size_t size, const Place& place) {
  const Json* member = findMember(object, key);
  return member == nullptr ? kNone : asIndex(*member, size, place.in(key));
}

std::uint32_t requiredIndex(const Json& object, const char* key, std::size_t size, const Place& place) {
  if (findMember(object, key) == nullptr) place.fail(std::string("has no ") + key);
  return indexOf(object, key, size, place);
}

}  // namespace lucarne
