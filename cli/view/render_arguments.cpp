#include "cli/view/render_arguments.h"

#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/units.h"
#include "cli/choices.h"

namespace lucarne {

void addRenderArguments(CLI::App& cmd, RenderOptions& options, std::string& size, bool withPathTracer) {
  cmd.add_option("--size", size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  std::map<std::string, RendererKind> renderers = {{"singlepass", RendererKind::singlepass},
                                                   {"multipass", RendererKind::multipass}};
  if (withPathTracer) renderers.emplace("pathtraced", RendererKind::pathtraced);
  addChoice<RendererKind>(cmd, "--renderer", options.renderer, renderers, "singlepass",
                          std::string("singlepass; multipass: the paper's, one pass a direction") +
                              (withPathTracer ? "; pathtraced: the truth, without light maps" : ""));
  addChoice<LightMapFormat>(
      cmd, "--map-format", options.format,
      {{"half", LightMapFormat::half}, {"rgb9e5", LightMapFormat::rgb9e5}, {"float", LightMapFormat::float32}}, "half",
      "light maps on the GPU: half, rgb9e5 (half the memory) or float (exact)");
  cmd.add_option_function<std::string>(
         "--gpu-memory", [&options](const std::string& text) { options.gpuMemory = parseBytes("--gpu-memory", text); },
         "bytes that light maps may take on the GPU, like 512M: more of them are shown in a smaller format, then with "
         "fewer directions; none: what the driver says is free")
      ->type_name("SIZE");
  addChoice<LobeKind>(cmd, "--lobe", options.lobe,
                      {{"cell", LobeKind::cell}, {"barsi", LobeKind::barsi}, {"sample", LobeKind::sample}}, "cell",
                      "highlights: cell: the lobe averaged over each direction's cell and normalised; to compare with "
                      "it barsi: averaged by a "
                      "closed form, and sample: in the middle of the cell");
}

void addViewArguments(CLI::App& cmd, View& view) {
  std::map<std::string, ViewKind> views;
  std::string help = "what to show; .exr holds the values, .png colours for them:";
  for (const ViewName& v : kViewNames) {
    views.emplace(v.name, v.view);
    help += (v.view == ViewKind::full ? " " : "; ") + std::string(v.name) + ": " + std::string(v.meaning);
  }
  addChoice<ViewKind>(cmd, "--view", view.kind, views, "full", help);
  cmd.add_option("--psi", view.psi, "the direction of --view direction, from 0")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
}

void addToneCurve(CLI::App& cmd, ToneCurve& curve) {
  addChoice<ToneCurve>(cmd, "--tonemap", curve, {{"filmic", ToneCurve::filmic}, {"plain", ToneCurve::plain}}, "filmic",
                       "filmic: bends highlights and shadows; plain: what is above white is white");
}

void applyExposure(const std::string& exposure, DisplayOptions& options) {
  if (exposure == "auto") return;
  double value = 0;
  char rest = 0;
  if (std::sscanf(exposure.c_str(), "%lf%c", &value, &rest) != 1 || !(std::abs(value) <= 100))
    throw UsageError("--exposure must be auto or an exposure value from -100 to 100, not '" + exposure + "'");
  options.ev100 = value;
}

void applySize(const std::string& size, RenderOptions& options) {
  char rest = 0;
  if (std::sscanf(size.c_str(), "%6dx%6d%c", &options.width, &options.height, &rest) != 2 || options.width < 1 ||
      options.height < 1)
    throw UsageError("--size must be WIDTHxHEIGHT, like 1280x720, not '" + size + "'");
}

}  // namespace lucarne
