#include "player/light_plot.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "player/tonemap.h"

namespace lucarne {
namespace {

constexpr float kMargin = 0.3f;  // radii; spots near the horizon reach beyond it

ImU32 colourOf(Rgbd radiance, double white) {
  const auto code = [&](double v) {
    return std::clamp(static_cast<int>(std::lround(255 * encodeSrgb(static_cast<float>(v / white)))), 0, 255);
  };
  return IM_COL32(code(radiance.x), code(radiance.y), code(radiance.z), 255);
}

}  // namespace

std::vector<LightSpot> lightSpots(const ProbeAnswer& answer, Vec3d normal) {
  const Vec3d sky = std::abs(normal.y) < 0.999 ? Vec3d{0, 1, 0} : Vec3d{0, 0, -1};
  const Vec3d up = normalize(sky - normal * dot(sky, normal)), right = cross(up, normal);
  std::vector<LightSpot> spots;
  for (const ProbeDirection& d : answer.directions) {
    const double cosIntegral = d.solidAngle * d.meanCosine;
    if (!(cosIntegral > 0)) continue;
    spots.push_back({{dot(d.direction, right), dot(d.direction, up)},
                     std::sqrt(cosIntegral / std::numbers::pi),
                     d.irradiance / cosIntegral});
  }
  return spots;
}

void drawLightPlot(const ProbeAnswer& answer, Vec3d normal, float radius) {
  if (answer.directions.empty()) {
    ImGui::TextUnformatted("light not kept by direction");
    return;
  }
  const std::vector<LightSpot> spots = lightSpots(answer, normal);
  double white = 0;
  for (const LightSpot& s : spots) white = std::max(white, maxComponent(s.radiance));
  ImGui::Text("light by direction, white %.3g cd/m2", white);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float half = (1 + kMargin) * radius;
  const ImVec2 middle{corner.x + half, corner.y + half};
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddCircleFilled(middle, radius, IM_COL32(20, 20, 24, 255), 64);
  for (const LightSpot& s : spots) {
    const ImVec2 at{middle.x + radius * static_cast<float>(s.centre.x),
                    middle.y - radius * static_cast<float>(s.centre.y)};
    list->AddCircleFilled(at, std::max(radius * static_cast<float>(s.radius), 1.5f),
                          colourOf(s.radiance, std::max(white, 1e-300)), 24);
  }
  list->AddCircle(middle, radius, IM_COL32(160, 160, 160, 255), 64);
  ImGui::Dummy({2 * half, 2 * half});
}

}  // namespace lucarne
