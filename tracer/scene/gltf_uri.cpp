#include "tracer/scene/gltf_uri.h"

#include <algorithm>

namespace lucarne {
namespace {

int base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::vector<std::uint8_t> decodeBase64(std::string_view text, const Place& place) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) place.fail("is base64 cut short");
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int digit = base64Digit(c);
    if (digit < 0) place.fail("is not base64");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    if ((count += 6) >= 8) {
      count -= 8;
      bytes.push_back(static_cast<std::uint8_t>(bits >> count));
    }
  }
  return bytes;
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string percentDecoded(std::string_view uri, const Place& place) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    if (i + 2 >= uri.size() || hexDigit(uri[i + 1]) < 0 || hexDigit(uri[i + 2]) < 0) {
      place.fail("has a % that two hexadecimal digits do not follow");
    }
    text += static_cast<char>(hexDigit(uri[i + 1]) * 16 + hexDigit(uri[i + 2]));
    i += 2;
  }
  return text;
}

}  // namespace

bool isDataUri(std::string_view uri) { return uri.substr(0, 5) == "data:"; }

std::vector<std::uint8_t> decodeDataUri(std::string_view uri, const Place& place, std::string* mimeType) {
  const std::size_t comma = uri.find(',');
  constexpr std::string_view kBase64 = ";base64";
  const std::string_view head = uri.substr(5, comma == std::string_view::npos ? comma : comma - 5);
  if (comma == std::string_view::npos || !head.ends_with(kBase64)) place.fail("is not a base64 data URI");
  const std::string_view type = head.substr(0, head.size() - kBase64.size());
  if (type.find(";;") != std::string_view::npos || type.ends_with(';')) place.fail("is not a valid data URI");
  if (mimeType != nullptr) *mimeType = std::string(type.substr(0, type.find(';')));
  return decodeBase64(uri.substr(comma + 1), place);
}

std::filesystem::path confinedPath(const std::filesystem::path& folder, std::string_view uri, const Place& place) {
  const std::string text = percentDecoded(uri, place);
  const auto isBad = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\\' || c == ':'; };
  const bool bad = text.empty() || text.front() == '/' || std::any_of(text.begin(), text.end(), isBad);
  const std::filesystem::path path(text);
  if (bad || path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end()) {
    place.fail("is not a file in the scene's own folder; put the file beside the scene or pack all into one .glb");
  }
  return folder / path;
}

}  // namespace lucarne
