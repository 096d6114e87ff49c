#include "player/look_panel.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui/imgui.h>

#include <algorithm>

#include "player/light_plot.h"

namespace lucarne {

const char* const kLookKeysHelp =
    "V         next view (Shift: the one before)\n"
    "[ ]       direction of the view\n"
    "T L       tone curve, lobe of highlights\n"
    "X M       hold the exposure, smooth edges\n"
    "K         compare with the path-traced truth\n"
    "I         what is here (right button: there)\n"
    "O         save a picture, .png and .exr\n"
    "Tab       controls";

namespace {

constexpr float kEdge = 8;  // pixels between windows and the edge of the picture

int wrapped(int psi, int count) { return (psi % count + count) % count; }

void toggle(bool& value) { value = !value; }

std::optional<Vec2d> underMouse() {
  const ImGuiIO& io = ImGui::GetIO();
  if (!ImGui::IsMousePosValid()) return Vec2d{0.5, 0.5};  // it turns the head
  return Vec2d{static_cast<double>(io.MousePos.x / io.DisplaySize.x),
               static_cast<double>(io.MousePos.y / io.DisplaySize.y)};
}

void handleKey(LookSettings& look, int directionCount, KeyPress press) {
  switch (press.key) {
    case GLFW_KEY_V:
      look.view.kind = neighbourOf(look.view.kind, press.shift ? -1 : 1);
      break;
    case GLFW_KEY_RIGHT_BRACKET:
      look.view.psi = wrapped(look.view.psi + 1, directionCount);
      break;
    case GLFW_KEY_LEFT_BRACKET:
      look.view.psi = wrapped(look.view.psi - 1, directionCount);
      break;
    case GLFW_KEY_T:
      look.curve = nextOf(look.curve);
      break;
    case GLFW_KEY_L:
      look.lobe = nextOf(look.lobe);
      break;
    case GLFW_KEY_X:
      toggle(look.exposureLocked);
      break;
    case GLFW_KEY_M:
      toggle(look.smoothEdges);
      break;
    case GLFW_KEY_K:
      toggle(look.compare);
      break;
    case GLFW_KEY_TAB:
      toggle(look.panel);
      break;
    case GLFW_KEY_O:
      look.screenshot = true;
      break;
    case GLFW_KEY_I:
      look.inspectAt = Vec2d{0.5, 0.5};
      break;
    default:
      break;
  }
}

}  // namespace

void handleLookKeys(LookSettings& look, int directionCount, const std::vector<KeyPress>& presses) {
  for (const KeyPress& press : presses) handleKey(look, directionCount, press);
}

void handleLookMouse(LookSettings& look) {
  if (!ImGui::GetIO().WantCaptureMouse && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) look.inspectAt = underMouse();
}

namespace {

/// A scrollbar, or a smaller picture, must not push the window over the right edge.
void keepInSight() {
  const ImVec2 at = ImGui::GetWindowPos();
  const float over = at.x + ImGui::GetWindowWidth() - (ImGui::GetIO().DisplaySize.x - kEdge);
  if (over > 0) ImGui::SetWindowPos({at.x - over, at.y});
}

}  // namespace

void drawLookPanel(LookSettings& look, int directionCount, float height) {
  if (!look.panel) return;
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::SetNextWindowPos({io.DisplaySize.x - kEdge, kEdge}, ImGuiCond_FirstUseEver, {1, 0});
  constexpr float kLeast = 80;
  ImGui::SetNextWindowSizeConstraints({0, 0}, {io.DisplaySize.x, std::max(height, kLeast)});
  ImGui::Begin("look", &look.panel, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  keepInSight();
  constexpr float kSliders = 150;  // narrow enough for numbers and controls side by side
  ImGui::PushItemWidth(kSliders);
  if (ImGui::BeginCombo("view", nameOf(look.view.kind).data())) {
    for (const ViewName& v : kViewNames) {
      if (ImGui::Selectable(v.name.data(), v.view == look.view.kind)) look.view.kind = v.view;
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", v.meaning.data());
    }
    ImGui::EndCombo();
  }
  ImGui::SliderInt("direction", &look.view.psi, 0, directionCount - 1);
  look.view.psi = std::clamp(look.view.psi, 0, directionCount - 1);
  ImGui::SliderFloat("stops", &look.stops, -8, 8, "%+.1f");
  ImGui::Checkbox("hold the exposure", &look.exposureLocked);
  if (ImGui::Button(nameOf(look.curve).data())) look.curve = nextOf(look.curve);
  ImGui::SameLine();
  ImGui::TextUnformatted("tone curve");
  if (ImGui::Button(nameOf(look.lobe).data())) look.lobe = nextOf(look.lobe);
  ImGui::SameLine();
  ImGui::TextUnformatted("lobe of highlights");
  ImGui::Checkbox("smooth edges", &look.smoothEdges);
  ImGui::Checkbox("compare with the truth", &look.compare);
  if (ImGui::Button("save a picture")) look.screenshot = true;
  ImGui::PopItemWidth();
  ImGui::End();
}

void drawDivider(LookSettings& look, const std::string& state) {
  if (!look.compare) return;
  constexpr float kGrip = 12;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({look.divider * size.x - kGrip / 2, 0});
  ImGui::SetNextWindowSize({kGrip, size.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin("divider", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoMove);
  ImGui::InvisibleButton("grip", {kGrip, size.y});
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemActive()) look.divider = std::clamp(ImGui::GetIO().MousePos.x / size.x, 0.02f, 0.98f);
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImDrawList* over = ImGui::GetForegroundDrawList();
  const float y = size.y - 24;
  const char* left = "light maps";
  const ImVec2 extent = ImGui::CalcTextSize(left);
  over->AddText({look.divider * size.x - 10 - extent.x, y}, IM_COL32_WHITE, left);
  over->AddText({look.divider * size.x + 10, y}, IM_COL32_WHITE, ("truth: " + state).c_str());
}

float drawInspection(const Inspection& found) {
  const ImGuiIO& io = ImGui::GetIO();
  const ProbeAnswer& answer = found.answer;
  ImGui::SetNextWindowPos({io.DisplaySize.x - kEdge, io.DisplaySize.y - kEdge}, ImGuiCond_Always, {1, 1});
  ImGui::SetNextWindowBgAlpha(0.7f);
  ImGui::Begin("here", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoNav);
  ImGui::Text("material    %s", found.material.empty() ? "(no name)" : found.material.c_str());
  ImGui::Text("position    %.4g %.4g %.4g m", found.position.x, found.position.y, found.position.z);
  ImGui::Text("normal      %.3f %.3f %.3f", found.normal.x, found.normal.y, found.normal.z);
  if (!answer.onSurface) {
    ImGui::TextUnformatted("no light map here");
  } else {
    const Rgbd E = answer.irradiance;
    ImGui::Text("chart       %u, %s", answer.chart, answer.back ? "back" : "front");
    ImGui::Text("irradiance  %.4g %.4g %.4g lx", E.x, E.y, E.z);
    ImGui::Text("its error   %.3g lx (%.2g %%)", answer.standardError, 100 * answer.relativeError);
    ImGui::Text("photons     %.0f", answer.photons);
    // In low windows smaller, to leave room for the controls above.
    drawLightPlot(answer, found.normal, std::clamp(io.DisplaySize.y / 10 - 8, 40.f, 80.f));
  }
  const float height = ImGui::GetWindowHeight();
  ImGui::End();
  return height;
}

}  // namespace lucarne
