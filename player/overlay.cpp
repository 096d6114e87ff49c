#include "player/overlay.h"

#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>

#include "base/units.h"

namespace lucarne {
namespace {

using Count = unsigned long long;

void drawNumbers(const OverlayText& t) {
  const StateCounts &now = t.stats.counts, &unsorted = t.stats.unsorted;
  ImGui::Text("%.1f fps   %.1f ms   %d x %d", t.frameSeconds > 0 ? 1 / t.frameSeconds : 0., 1000 * t.frameSeconds,
              t.width, t.height);
  if (t.gpuSeconds) ImGui::Text("GPU %.2f ms", 1000 * *t.gpuSeconds);
  ImGui::Text("%s   %d directions", t.renderer == RendererKind::multipass ? "multipass" : "singlepass",
              t.stats.directions);
  ImGui::Separator();
  ImGui::Text("                 sorted   unsorted");
  ImGui::Text("draws          %8llu   %8llu", Count{now.draws}, Count{unsorted.draws});
  ImGui::Text("directions     %8llu   %8llu", Count{now.directionSwitches}, Count{unsorted.directionSwitches});
  ImGui::Text("materials      %8llu   %8llu", Count{now.materialSwitches}, Count{unsorted.materialSwitches});
  ImGui::Text("textures       %8llu   %8llu", Count{now.textureSwitches}, Count{unsorted.textureSwitches});
  ImGui::Separator();
  ImGui::Text("texture memory %.1f MB (light maps %.1f MB)", 1e-6 * static_cast<double>(t.stats.textureBytes),
              1e-6 * static_cast<double>(t.stats.lightMapBytes));
  if (t.photons > 0) ImGui::Text("photons        %s", formatCount(static_cast<std::uint64_t>(t.photons)).c_str());
  ImGui::Text("exposure       %+.1f stops", t.exposureStops);
}

/// No wider than the numbers below it.
void drawNote(const std::string& note) {
  constexpr float kWidth = 290;
  if (note.empty()) return;
  ImGui::PushTextWrapPos(kWidth);
  ImGui::TextUnformatted(note.c_str());
  ImGui::PopTextWrapPos();
}

void drawHelp(bool open) {
  if (!open) {
    ImGui::TextDisabled("H: help");
    return;
  }
  ImGui::Separator();
  ImGui::TextUnformatted(
      "W A S D   walk          mouse look (click; Esc lets go)\n"
      "Shift     run           wheel walk faster, slower\n"
      "C         crouch        space jump\n"
      "F         fly, walk     Q E   fly down, up\n"
      "N P       next, previous camera   Home  back to it\n"
      "R         reload the maps\n"
      "1 2       singlepass, multipass\n"
      "+ - 0     brighter, darker, automatic\n"
      "H F1      this help     Esc   quit");
}

}  // namespace

Overlay::Overlay(GLFWwindow* window) : window_(window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
  ImGui::StyleColorsDark();
  if (window_ != nullptr) ImGui_ImplGlfw_InitForOpenGL(window_, true);
  ImGui_ImplOpenGL3_Init("#version 450 core");
}

Overlay::~Overlay() {
  ImGui_ImplOpenGL3_Shutdown();
  if (window_ != nullptr) ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Overlay::newFrame(const OverlayText& text) {
  ImGui_ImplOpenGL3_NewFrame();
  if (window_ != nullptr) {
    ImGui_ImplGlfw_NewFrame();
  } else {
    ImGui::GetIO().DisplaySize = {static_cast<float>(text.width), static_cast<float>(text.height)};
    ImGui::GetIO().DeltaTime = 1.f / 60;
  }
  ImGui::NewFrame();
}

void Overlay::layOut(const OverlayText& text) {
  newFrame(text);
  ImGui::SetNextWindowPos({8, 8});
  ImGui::SetNextWindowBgAlpha(0.55f);
  ImGui::Begin("lucarne", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
  drawNote(text.note);
  if (text.stats.directions > 0) {
    drawNumbers(text);
    drawHelp(text.help);
  }
  ImGui::End();
  ImGui::Render();
}

void Overlay::draw(const OverlayText& text) {
  layOut(text);
  if (window_ == nullptr) layOut(text);  // a panel finds its size in one frame and shows it in the next
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace lucarne
