#include "cli/view/render_arguments.h"

#include <cstdio>
#include <map>

#include "base/error.h"

namespace lucarne {

void addRenderArguments(CLI::App& cmd, RenderOptions& options, std::string& size) {
  cmd.add_option("--size", size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  static const std::map<std::string, RendererKind> renderers{{"singlepass", RendererKind::singlepass},
                                                             {"multipass", RendererKind::multipass}};
  cmd.add_option("--renderer", options.renderer, "singlepass, or multipass: the paper's, one pass a direction")
      ->transform(CLI::CheckedTransformer(renderers).description(""))
      ->type_name("NAME")
      ->default_str("singlepass");
  static const std::map<std::string, LightMapFormat> formats{
      {"half", LightMapFormat::half}, {"rgb9e5", LightMapFormat::rgb9e5}, {"float", LightMapFormat::float32}};
  cmd.add_option("--map-format", options.format, "light maps on the GPU: half, rgb9e5 (half the memory) or float (exact)")
      ->transform(CLI::CheckedTransformer(formats).description(""))
      ->type_name("NAME")
      ->default_str("half");
}

void applySize(const std::string& size, RenderOptions& options) {
  char rest = 0;
  if (std::sscanf(size.c_str(), "%6dx%6d%c", &options.width, &options.height, &rest) != 2 || options.width < 1 ||
      options.height < 1)
    throw UsageError("--size must be WIDTHxHEIGHT, like 1280x720, not '" + size + "'");
}

}  // namespace lucarne
