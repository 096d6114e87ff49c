// The speed of a bake drawn over its time.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace lucarne {

/// An <svg> element that scales with the page; `curve` is the report's rate_curve: {"seconds": […], "photons": […]},
/// both done so far. Empty where there are fewer than two points.
std::string ratePicture(const nlohmann::json& curve);

}  // namespace lucarne
