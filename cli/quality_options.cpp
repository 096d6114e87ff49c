#include "cli/quality_options.h"

#include "base/units.h"
#include "cli/choices.h"

namespace lucarne {

void addQualityOptions(CLI::App& cmd, BakeOptions& o, QualityTexts& texts) {
  addLayoutOptions(cmd, o, texts.layout);
  addChoice<KernelShape>(cmd, "--kernel", o.kernel.shape, kernelShapes(), "adaptive", kKernelHelp);
  cmd.add_option("--kernel-width", texts.kernelWidth,
                 "distance in texels at which the kernel ends: wider is smoother and blurrier; of adaptive the widest")
      ->default_str("of adaptive 4.5, else 1.5");
  addSeams(cmd, o.seams, "fit");
  cmd.add_option("--drop-error", texts.dropError, kDropHelp)->capture_default_str();
  cmd.add_option("--seed", texts.seed, "another seed gives another, equally good bake")->capture_default_str();
  addChoice<SamplerKind>(cmd, "--sampler", o.sampler, {{"random", SamplerKind::random}, {"sobol", SamplerKind::sobol}},
                         "sobol", "numbers of the photons: sobol (low discrepancy, less noise) or random");
  addChoice<LightPart>(cmd, "--light", o.light,
                       {{"all", LightPart::all}, {"direct", LightPart::direct}, {"indirect", LightPart::indirect}},
                       "all", "which light to store: all, direct or indirect");
  addSkyOptions(cmd, o, texts.environment);
  cmd.add_flag_callback(
      "--no-guide", [&o] { o.guidedEmission = false; },
      "do not aim the light of suns and skies at where a pilot finds it useful (windows)");
}

void addTracingOptions(CLI::App& cmd, BakeOptions& o) {
  addMachineOptions(cmd, o);
  cmd.add_option("--isa", o.isa,
                 "Embree's instruction set (avx512, avx2, sse4.2); bakes to be compared bit by bit need the same");
}

void finishQuality(BakeOptions& o, const QualityTexts& texts) {
  finishSky(o, texts.environment);
  finishLayout(o, texts.layout);
  o.seed = parseCount("--seed", texts.seed);
  o.dropError = parsePercentage("--drop-error", texts.dropError);
  o.kernel.width = texts.kernelWidth.value_or(defaultKernelWidth(o.kernel.shape));
}

std::set<std::string> typedOptions(const CLI::App& cmd) {
  std::set<std::string> typed;
  for (const CLI::Option* option : cmd.get_options())
    if (option->count() > 0) typed.insert(option->get_name());
  return typed;
}

}  // namespace lucarne
