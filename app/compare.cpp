#include "app/compare.h"

#include <cmath>

#include "app/compare_kinds.h"
#include "base/error.h"
#include "base/units.h"

namespace lucarne {
namespace {

bool isLightMaps(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw InputError(path.string() + ": no such file or folder");
  return std::filesystem::is_directory(path);
}

}  // namespace

nlohmann::json compare(const CompareOptions& options) {
  const bool maps = isLightMaps(options.a);
  if (maps != isLightMaps(options.b)) {
    throw UsageError("compare takes two pictures or two .dlm folders; " + options.a.string() + " and " +
                     options.b.string() + " are one of each");
  }
  if (maps && options.maxFlip)
    throw UsageError("--max-flip is for pictures; for light maps there are --max-rmse and --max-relative");
  if (maps && !options.picture.empty())
    throw UsageError("--picture is for pictures; see lucarne info --picture for light maps");
  nlohmann::json compared = maps ? compareLightMaps(options) : comparePictures(options);
  compared["a"] = options.a.string();
  compared["b"] = options.b.string();
  return compared;
}

std::vector<std::string> exceededLimits(const nlohmann::json& compared, const CompareOptions& options) {
  std::vector<std::string> exceeded;
  const auto check = [&](const std::string& name, const nlohmann::json& value, const std::optional<double>& limit) {
    if (!limit || (value.is_number() && value.get<double>() <= *limit)) return;
    exceeded.push_back(name + " " + (value.is_number() ? formatNumber(value.get<double>()) : "unknown") + " is above " +
                       formatNumber(*limit));
  };
  if (compared["kind"] == "pictures") {
    check("RMSE", compared["rmse"], options.maxRmse);
    check("relative error", compared["relative_error"], options.maxRelative);
    check("FLIP", compared["flip"]["mean"], options.maxFlip);
    const bool limited = options.maxRmse || options.maxRelative || options.maxFlip;
    const auto broken = compared["non_finite_pixels"].get<std::uint64_t>();
    if (limited && broken > 0) exceeded.push_back(formatCount(broken) + " pixels are not finite");
  } else {
    check("RMSE", compared["irradiance"]["rmse_lx"], options.maxRmse);
    check("relative error", compared["irradiance"]["relative_error"], options.maxRelative);
  }
  return exceeded;
}

}  // namespace lucarne
