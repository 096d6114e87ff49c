// Text and bytes as they stand in a web page.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace lucarne {

/// Text that a page shows as it is, also inside quoted attributes: markup characters as entities, bytes that are no
/// UTF-8 and control characters (other than line ends and tabs) as U+FFFD.
std::string escapeHtml(std::string_view text);

/// "data:image/png;base64,…" (RFC 2397).
std::string dataUri(std::string_view mediaType, std::span<const std::uint8_t> bytes);

}  // namespace lucarne
