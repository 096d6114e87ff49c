// How much two pictures, or two sets of light maps, differ. docs/compare.md tells what each number means.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace lucarne {

struct CompareOptions {
  std::filesystem::path a, b;      // a is the reference
  std::filesystem::path picture;   // pictures: where to write the map of FLIP; empty: nowhere
  std::uint64_t points = 100'000;  // light maps of different layouts: where both are asked
  std::optional<double> maxRmse;   // in the unit of the values: display codes 0 … 1, those of the EXR, lx
  std::optional<double> maxRelative;
  std::optional<double> maxFlip;  // pictures only: of the mean
};

/// "kind" is "pictures" or "light maps". UsageError where a and b are of different kinds or an option is of the other
/// kind; InputError for files that cannot be read, pictures of different sizes and light maps of different scenes.
nlohmann::json compare(const CompareOptions& options);

/// For each limit that the result is above, what is above what. A value that could not be told is above any limit.
std::vector<std::string> exceededLimits(const nlohmann::json& compared, const CompareOptions& options);

/// The result for people.
std::string compareText(const nlohmann::json& compared);

}  // namespace lucarne
