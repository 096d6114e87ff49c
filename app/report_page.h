// The report as one page for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/report_pictures.h"

namespace lucarne {

/// HTML that needs nothing else: styles and pictures are in it, there are no scripts, and no address is asked for.
/// Every text of the report, which may come from a hostile scene, is shown as text. Members that a report lacks are
/// left out.
std::string reportPage(const nlohmann::json& report, const ReportPictures& pictures);

}  // namespace lucarne
