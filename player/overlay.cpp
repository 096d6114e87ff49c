#include "player/overlay.h"

#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>

#include <algorithm>

#include "base/units.h"

namespace lucarne {
namespace {

using Count = unsigned long long;

constexpr float kEdge = 8;       // pixels between windows
constexpr float kBothFit = 640;  // pixels: the height that numbers and help take together

void drawNumbers(const OverlayText& t, const LookSettings& look) {
  const StateCounts &now = t.stats.counts, &unsorted = t.stats.unsorted;
  ImGui::Text("%.1f fps   %.1f ms   %d x %d (scale %.2f)", t.frameSeconds > 0 ? 1 / t.frameSeconds : 0.,
              1000 * t.frameSeconds, t.width, t.height, t.renderScale);
  if (t.gpuSeconds) ImGui::Text("GPU %.2f ms", 1000 * *t.gpuSeconds);
  ImGui::Text("%s   %d directions   lobe %s", t.renderer == RendererKind::multipass ? "multipass" : "singlepass",
              t.stats.directions, nameOf(look.lobe).data());
  const std::string psi = look.view.kind == ViewKind::direction ? " " + std::to_string(look.view.psi) : "";
  ImGui::Text("view           %s%s", nameOf(look.view.kind).data(), psi.c_str());
  ImGui::Separator();
  ImGui::Text("                 sorted   unsorted");
  ImGui::Text("charts         %8llu of %llu in sight", Count{t.stats.visibleCharts}, Count{t.stats.charts});
  ImGui::Text("draws          %8llu   %8llu", Count{now.draws}, Count{unsorted.draws});
  ImGui::Text("directions     %8llu   %8llu", Count{now.directionSwitches}, Count{unsorted.directionSwitches});
  ImGui::Text("materials      %8llu   %8llu", Count{now.materialSwitches}, Count{unsorted.materialSwitches});
  ImGui::Text("textures       %8llu   %8llu", Count{now.textureSwitches}, Count{unsorted.textureSwitches});
  ImGui::Separator();
  ImGui::Text("texture memory %.1f MB (light maps %.1f MB)", 1e-6 * static_cast<double>(t.stats.textureBytes),
              1e-6 * static_cast<double>(t.stats.lightMapBytes));
  if (t.photons > 0) ImGui::Text("photons        %s", formatCount(static_cast<std::uint64_t>(t.photons)).c_str());
  if (scaleOf(look.view.kind) == ViewScale::light) {
    ImGui::Text("exposure       EV %.1f, %s %+.1f   %s", t.ev100, look.exposureLocked ? "held" : "automatic",
                static_cast<double>(look.stops), nameOf(look.curve).data());
  }
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
    ImGui::TextDisabled("H: help   Tab: controls");
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
  ImGui::TextUnformatted(kLookKeysHelp);
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

/// Times of the last frames, the newest at the right.
void Overlay::drawGraph() const {
  const float most = *std::max_element(milliseconds_.begin(), milliseconds_.end());
  ImGui::PlotLines("##frames", milliseconds_.data(), static_cast<int>(milliseconds_.size()),
                   static_cast<int>(frame_ % milliseconds_.size()), nullptr, 0, std::max(most, 50.f), {300, 36});
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

void Overlay::layOut(const OverlayText& text, LookSettings& look) {
  newFrame(text);
  ImGui::SetNextWindowPos({kEdge, kEdge});
  ImGui::SetNextWindowBgAlpha(0.55f);
  ImGui::Begin("lucarne", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
  drawNote(text.note);
  const float height = ImGui::GetIO().DisplaySize.y;
  if (text.stats.directions > 0) {
    if (!text.help || height > kBothFit) {
      drawNumbers(text, look);
      drawGraph();
    }
    drawHelp(text.help);
  }
  ImGui::End();
  const bool found = text.found != nullptr && text.found->has_value();
  const float below = found ? drawInspection(**text.found) + kEdge : 0;
  if (text.stats.directions > 0) {
    handleLookMouse(look);
    drawLookPanel(look, text.stats.directions, height - below - 2 * kEdge);
    drawDivider(look, text.truth);
  }
  ImGui::Render();
}

void Overlay::draw(const OverlayText& text, LookSettings& look) {
  milliseconds_[frame_++ % milliseconds_.size()] = static_cast<float>(1000 * text.lastFrameSeconds);
  layOut(text, look);
  if (window_ == nullptr) layOut(text, look);  // a panel finds its size in one frame and shows it in the next
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace lucarne
