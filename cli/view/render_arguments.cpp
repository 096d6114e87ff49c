#include "cli/view/render_arguments.h"

#include <cstdio>

#include "base/error.h"
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
  if (!withPathTracer) return;
  addChoice<LobeKind>(cmd, "--lobe", options.lobe,
                      {{"cell", LobeKind::cell}, {"barsi", LobeKind::barsi}, {"sample", LobeKind::sample}}, "cell",
                      "highlights: cell: the lobe averaged over each direction's cell and normalised; to compare with "
                      "it barsi: averaged by a "
                      "closed form, and sample: in the middle of the cell");
}

void applySize(const std::string& size, RenderOptions& options) {
  char rest = 0;
  if (std::sscanf(size.c_str(), "%6dx%6d%c", &options.width, &options.height, &rest) != 2 || options.width < 1 ||
      options.height < 1)
    throw UsageError("--size must be WIDTHxHEIGHT, like 1280x720, not '" + size + "'");
}

}  // namespace lucarne
