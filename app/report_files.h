// Where a report goes: JSON for programs, and beside it a page for people.
#pragma once

#include <filesystem>
#include <optional>

namespace lucarne {

struct ReportFiles {
  std::filesystem::path json;
  std::optional<std::filesystem::path> page;
};

/// Of R.json or R.html both; of any other name the JSON alone.
ReportFiles reportFiles(const std::filesystem::path& report);

}  // namespace lucarne
