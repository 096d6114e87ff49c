#include "app/bake.h"

#include <memory>
#include <nlohmann/json.hpp>

#include "app/plan_file.h"
#include "base/error.h"
#include "base/log.h"
#include "base/units.h"
#include "cli/commands.h"
#include "cli/interrupts.h"
#include "cli/player_of_this_program.h"
#include "cli/quality_options.h"

namespace lucarne {
namespace {

/// Numbers arrive as text, so that 20M and 1e9 work and nonsense is refused in our words.
struct BakeTexts {
  QualityTexts quality;
  std::string scene, report, plan, part, photonRange, checkpoint = "5m", time, targetError, memory;
};

/// The two numbers of "A/B" or "A:B".
std::pair<std::uint64_t, std::uint64_t> parsePair(const std::string& option, const std::string& text, char between) {
  const std::size_t at = text.find(between);
  if (at == std::string::npos)
    throw UsageError(option + " must be two numbers with " + between + " between them, not '" + text + "'");
  return {parseCount(option, text.substr(0, at)), parseCount(option, text.substr(at + 1))};
}

void finishPiece(BakeOptions& options, const BakeTexts& texts, bool photonsGiven) {
  if (!texts.part.empty()) {
    const auto [k, n] = parsePair("--part", texts.part, '/');
    options.part = PartNumber{k, n};
  }
  if (texts.photonRange.empty()) return;
  const auto [begin, end] = parsePair("--photon-range", texts.photonRange, ':');
  options.photonRange = IndexRange{begin, end};
  if (!photonsGiven) options.photons = std::max<std::uint64_t>(1, end);
}

/// With another end in sight photons have none but what is typed.
void finishStopRules(BakeOptions& options, const BakeTexts& texts, bool photonsGiven) {
  if (!texts.time.empty()) options.timeLimit = parseDuration("--time", texts.time);
  if (!texts.targetError.empty()) {
    options.targetError = parsePercentage("--target-error", texts.targetError);
    if (options.targetError == 0) throw UsageError("--target-error must be more than 0");
  }
  if (!photonsGiven && (options.timeLimit || options.targetError > 0)) options.photons = kUnlimitedPhotons;
}

void finish(BakeOptions& options, const BakeTexts& texts, const std::set<std::string>& typed) {
  if (!texts.scene.empty()) options.scene = texts.scene;
  if (!texts.report.empty()) options.report = texts.report;
  finishQuality(options, texts.quality);
  options.checkpointSeconds = texts.checkpoint == "0" ? 0 : parseDuration("--checkpoint", texts.checkpoint);
  if (!texts.memory.empty()) options.memoryBytes = parseBytes("--memory", texts.memory);
  const bool photonsGiven = typed.contains("--photons") || !texts.plan.empty();
  finishStopRules(options, texts, photonsGiven);
  finishPiece(options, texts, photonsGiven);
  if (!texts.plan.empty()) options = withPlan(options, typed, texts.plan);
}

void addStopRules(CLI::App& cmd, BakeTexts& texts) {
  cmd.add_option("--time", texts.time,
                 "end after so long (8h, 90m), the time that earlier runs traced counted in; no limit of photons then "
                 "unless --photons is given");
  cmd.add_option("--target-error", texts.targetError,
                 "end when the estimated relative error is so small (2%); no limit of photons then unless --photons is "
                 "given");
}

void addPieces(CLI::App& cmd, BakeOptions& o, BakeTexts& texts) {
  cmd.add_option(
      "--plan", texts.plan,
      "PLAN.json of `lucarne check --plan`: takes the scene and every setting that decides the result from it; "
      "refuses options that contradict it, and another scene");
  cmd.add_option("--part", texts.part,
                 "K/N: bake part K of N (from 1) of the photons, to be merged: writes NAME.part instead of NAME.dlm");
  cmd.add_option("--photon-range", texts.photonRange, "A:B: bake photons A to B (without B) alone, as a part");
  cmd.add_option("--checkpoint", texts.checkpoint,
                 "save the state in NAME.checkpoint/ that often, and at the end; 0: never")
      ->capture_default_str();
  cmd.add_flag("--resume", o.resume,
               "go on from the saved state of a killed bake, or from a finished part; without one, start anew");
  cmd.add_flag("--keep-part", o.keepPart,
               "the tallies, too, as NAME.part: to merge more photons in later, or to make other maps of");
}

void addRunning(CLI::App& cmd, BakeOptions& o, BakeTexts& texts) {
  addTracingOptions(cmd, o);
  cmd.add_option("--memory", texts.memory,
                 "16G: no process takes more; a bake that would is refused and told what would fit. Default: what is free");
  cmd.add_option(
      "--report", texts.report,
      "R.json or R.html writes both: what happened (rates, energy ledger, errors, warnings, what was left out) for "
      "programs, and a page for people with pictures of the cameras; another name: the JSON alone");
  addChoice<ProgressStyle>(
      cmd, "--progress", o.progress, {{"line", ProgressStyle::line}, {"json", ProgressStyle::json}}, "line",
      "line: one live line on a terminal, a line a minute in a log; json: an object a line on stdout, one a second");
  cmd.add_flag("--quiet", o.quiet, "print errors only");
}

void tell(const BakeOptions& options, const nlohmann::json& report) {
  const std::filesystem::path output = writesPart(options) ? partPath(options) : options.output;
  std::string text = "wrote " + output.string() + ": " + formatCount(report["photons"].get<std::uint64_t>()) +
                     " photons in " + formatDuration(report["seconds"].get<double>());
  if (report.contains("estimated_relative_error"))
    text += ", estimated error " + formatPercent(report["estimated_relative_error"].get<double>());
  const std::string end = report.value("ended_by", "photons");
  if (end == "time") text += "; the time was up";
  if (end == "target_error") text += "; the target is reached";
  if (end == "tallies_full") text += "; the tallies hold no more: bake the rest in parts with light maps of their own";
  logInfo(text);
}

}  // namespace

void addBake(CLI::App& app, Action& action) {
  CLI::App* cmd = app.add_subcommand("bake", "trace photons through a scene and write its light maps");
  const auto options = std::make_shared<BakeOptions>();
  const auto texts = std::make_shared<BakeTexts>();
  cmd->add_option("SCENE", texts->scene, "a .glb or .gltf file in metres; none: the built-in room");
  cmd->add_option("-o,--output", options->output, "the light maps, a folder NAME.dlm; NAME.part for a part")
      ->required();
  addQualityOptions(*cmd, *options, texts->quality);
  addStopRules(*cmd, *texts);
  addPieces(*cmd, *options, *texts);
  addRunning(*cmd, *options, *texts);
  cmd->callback([options, texts, cmd, &action] {
    action = [options, texts, cmd] {
      finish(*options, *texts, typedOptions(*cmd));
      setQuiet(options->quiet);
      Interrupts interrupts;
      const nlohmann::json report = bake(*options, interrupts.control(), playerOfThisProgram());
      if (!report.is_null()) tell(*options, report);  // null: not the first of MPI ranks
    };
  });
}

}  // namespace lucarne
