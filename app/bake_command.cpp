#include "app/bake_command.h"

#include <array>
#include <charconv>
#include <string_view>

#include "app/bake_identity.h"
#include "base/units.h"

namespace lucarne {
namespace {

/// The shortest text that reads as the same number.
std::string shortest(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// A path as an argument: one that begins with a hyphen would be taken for an option.
std::string pathArgument(const std::string& path) { return quotedForShell(path.starts_with('-') ? "./" + path : path); }

void addSky(const BakeOptions& o, std::string& text) {
  if (!o.environment) return;
  text += " --environment " + pathArgument(o.environment->string());
  if (o.environmentScale != 1) text += " --environment-scale " + shortest(o.environmentScale);
  if (o.environmentTurn != 0) text += " --environment-turn " + shortest(o.environmentTurn);
}

/// Settings that are not the default, each with a space before it.
std::string settingsText(const BakeOptions& o) {
  const BakeOptions standard;
  const nlohmann::json names = traceSettings(o), resolve = resolveSettings(o);
  std::string text;
  const auto add = [&text](bool differs, const std::string& option) {
    if (differs) text += " " + option;
  };
  const auto name = [](const nlohmann::json& of, const char* key) { return of[key].get<std::string>(); };
  add(o.photons != standard.photons && o.photons != kUnlimitedPhotons, "--photons " + formatExactCount(o.photons));
  add(true, "--directions " + std::to_string(o.directions));
  add(o.charts != standard.charts, "--charts grow");
  add(o.texelsPerMetre != standard.texelsPerMetre, "--density " + shortest(o.texelsPerMetre));
  add(o.texelBudget != standard.texelBudget, "--texels " + formatExactCount(o.texelBudget));
  add(o.keepAllDirections, "--keep-all-directions");
  add(o.directionFilter != standard.directionFilter, "--direction-filter " + name(names, "direction_filter"));
  add(o.moments, "--moments");
  add(o.seed != standard.seed, "--seed " + std::to_string(o.seed));
  add(o.sampler != standard.sampler, "--sampler " + name(names, "sampler"));
  addSky(o, text);
  add(!o.guidedEmission, "--no-guide");
  add(o.light != standard.light, "--light " + name(names, "light"));
  add(gathersDirect(o), "--direct gathered");
  add(gathersDirect(o) && o.directSamples != standard.directSamples,
      "--direct-samples " + formatExactCount(o.directSamples));
  add(o.kernel.shape != standard.kernel.shape, "--kernel " + name(resolve, "kernel"));
  add(o.kernel.width != defaultKernelWidth(o.kernel.shape), "--kernel-width " + shortest(o.kernel.width));
  add(o.seams != standard.seams, "--seams " + seamsName(o));
  add(o.dropError > 0, "--drop-error " + shortest(100 * o.dropError) + "%");
  if (o.timeLimit) add(true, "--time " + shortest(*o.timeLimit) + "s");
  add(o.targetError > 0, "--target-error " + shortest(100 * o.targetError) + "%");
  return text;
}

std::string pieceText(const BakeOptions& o) {
  if (o.part) return " --part " + std::to_string(o.part->k) + "/" + std::to_string(o.part->n);
  if (!o.photonRange) return {};
  return " --photon-range " + formatExactCount(o.photonRange->begin) + ":" + formatExactCount(o.photonRange->end);
}

std::string formatText(const DlmFormat& format) {
  const DlmFormat standard;
  std::string text;
  if (format.directional != standard.directional) text.append(" --format ").append(nameOf(format.directional));
  if (format.directional == MapFormat::ldr8 && format.kMax != standard.kMax) text += " --kmax " + shortest(format.kMax);
  return text;
}

}  // namespace

std::string quotedForShell(const std::string& name) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/+=:,@%";
  if (!name.empty() && name.find_first_not_of(kPlain) == std::string::npos) return name;
  std::string text = "'";
  for (const char c : name) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string bakeCommand(const PartHeader& header, const std::string& output, const std::string& rest) {
  std::string text = "lucarne bake";
  if (header.sceneName != kBuiltinSceneName) text.append(" ").append(pathArgument(header.sceneName));
  text.append(" -o ").append(pathArgument(output)).append(settingsText(optionsOf(header, output)));
  if (!rest.empty()) text.append(" ").append(rest);
  return text;
}

std::string bakeCommand(const BakeOptions& o) {
  std::string text = "lucarne bake";
  if (o.scene) text.append(" ").append(pathArgument(o.scene->string()));
  text.append(" -o ").append(pathArgument(o.output.string()));
  text.append(settingsText(o)).append(pieceText(o)).append(formatText(o.format));
  if (!o.isa.empty()) text.append(" --isa ").append(o.isa);
  if (o.keepPart) text.append(" --keep-part");
  return text;
}

}  // namespace lucarne
