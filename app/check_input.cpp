#include "app/check_input.h"

namespace lucarne {

std::string quotedName(const std::string& name) {
  if (name.empty()) return "(unnamed)";
  constexpr std::size_t kMost = 60;
  std::size_t end = std::min(kMost, name.size());
  while (end > 0 && end < name.size() && (static_cast<unsigned char>(name[end]) & 0xc0u) == 0x80u) --end;
  std::string text = "'";
  for (const char c : name.substr(0, end)) text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return text + (end < name.size() ? "…'" : "'");
}

}  // namespace lucarne
