#include "cli/layout_options.h"

#include <algorithm>

#include "base/units.h"
#include "cli/choices.h"

namespace lucarne {

void addLayoutOptions(CLI::App& cmd, BakeOptions& o, LayoutTexts& texts) {
  cmd.add_option("--photons", texts.photons, "photons to trace, e.g. 20M or 1e9; four times as many halve the noise")
      ->capture_default_str();
  cmd.add_option("--directions", texts.directions,
                 "size of the direction set: more show sharper highlights, cost memory and frame time; auto: 14, 32 or 64, as "
                 "the scene's glossy surfaces need")
      ->capture_default_str();
  cmd.add_option("--density", o.texelsPerMetre, "texels per metre: finer shadows, more noise for the same photons")
      ->capture_default_str();
  addChoice<ChartMode>(cmd, "--charts", o.charts, {{"auto", ChartMode::automatic}, {"grow", ChartMode::grow}}, "auto",
                       "auto: the scene's own unwrapping (TEXCOORD_1) where it can be used; grow: none of it");
  cmd.add_option("--texels", texts.texels, "texel budget; a scene that needs more is baked at a lower density")
      ->capture_default_str();
  addChoice<DirectMode>(cmd, "--direct", o.direct,
                        {{"photons", DirectMode::photons}, {"gathered", DirectMode::gathered}}, "photons",
                        "light straight from lamps and sky: brought by photons, or gathered at every texel");
  cmd.add_option("--direct-samples", texts.directSamples, "of --direct gathered: samples a texel")->capture_default_str();
  addChoice<DirectionFilter>(cmd, "--direction-filter", o.directionFilter,
                             {{"nearest", DirectionFilter::nearest}, {"linear", DirectionFilter::linear}}, "nearest",
                             "nearest: light counts in the cell that it comes from; linear: it is shared among the three "
                             "directions around it");
  cmd.add_flag("--moments", o.moments,
               "the mean direction of each cell's light and how far it spreads, too: sharper highlights in their true places, "
               "for more memory and disk");
  cmd.add_flag("--keep-all-directions", o.keepAllDirections, "direction maps also for surfaces without a glossy lobe");
}

void finishLayout(BakeOptions& o, const LayoutTexts& texts) {
  o.photons = parseCount("--photons", texts.photons);
  o.chooseDirections = texts.directions == "auto";
  if (!o.chooseDirections) {
    constexpr std::uint64_t kTooMany = 1 << 20;  // refused later, with the others that are out of range
    o.directions = static_cast<int>(std::min(kTooMany, parseCount("--directions", texts.directions)));
  }
  o.directSamples = parseCount("--direct-samples", texts.directSamples);
  o.texelBudget = parseCount("--texels", texts.texels);
}

void addSkyOptions(CLI::App& cmd, BakeOptions& o, std::string& environment) {
  cmd.add_option("--environment", environment,
                 "SKY.exr or SKY.hdr: an equirectangular map in cd/m² around the scene, +y up, its middle toward +x");
  cmd.add_option("--environment-scale", o.environmentScale, "times the values of the map")->capture_default_str();
  cmd.add_option("--environment-turn", o.environmentTurn,
                 "degrees that the map is turned about the vertical, counter-clockwise from above; whole columns")
      ->capture_default_str();
}

void finishSky(BakeOptions& o, const std::string& environment) {
  if (!environment.empty()) o.environment = environment;
}

void addMachineOptions(CLI::App& cmd, BakeOptions& o) {
  cmd.add_option("--threads", o.threads, "0: all; the result does not depend on it")->capture_default_str();
  addFormatOptions(cmd, o.format);
}

void addFormatOptions(CLI::App& cmd, DlmFormat& format) {
  addChoice<MapFormat>(cmd, "--format", format.directional,
                       {{"half", MapFormat::half},
                        {"float", MapFormat::float32},
                        {"rgb9e5", MapFormat::rgb9e5},
                        {"ldr8", MapFormat::ldr8}},
                       "half", "numbers of the directional maps on disk: half, float, rgb9e5 or ldr8");
  cmd.add_option("--kmax", format.kMax,
                 "of ldr8: light above so many times the mean of its surface is cut; less is finer in the dark")
      ->capture_default_str();
}

}  // namespace lucarne
