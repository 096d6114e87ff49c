// The two kinds of comparison behind compare().
#pragma once

#include "app/compare.h"

namespace lucarne {

nlohmann::json comparePictures(const CompareOptions& options);
nlohmann::json compareLightMaps(const CompareOptions& options);

}  // namespace lucarne
