#include "app/report_files.h"

namespace lucarne {

ReportFiles reportFiles(const std::filesystem::path& report) {
  const std::filesystem::path ending = report.extension();
  if (ending != ".json" && ending != ".html") return {report, std::nullopt};
  std::filesystem::path json = report, page = report;
  return {json.replace_extension(".json"), page.replace_extension(".html")};
}

}  // namespace lucarne
