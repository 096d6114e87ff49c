#include "app/check.h"

#include <cstdio>
#include <memory>

#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "cli/commands.h"
#include "cli/quality_options.h"

namespace lucarne {
namespace {

struct CheckArguments {
  BakeOptions options;
  QualityTexts texts;
  std::string scene, plan;
  bool json = false;
};

void runCheck(CheckArguments& a) {
  setQuiet(true);  // what is to be said stands in the result
  if (!a.scene.empty()) a.options.scene = a.scene;
  finishQuality(a.options, a.texts);
  if (!a.plan.empty()) checkWritable(a.plan);
  const nlohmann::json checked = checkScene(a.options, std::filesystem::path(a.plan).parent_path());
  std::fputs((a.json ? dumpJson(checked) : checkText(checked)).c_str(), stdout);
  const nlohmann::json& failures = checked["failures"];
  if (!failures.empty()) throw InputError("the bake would fail: " + failures[0].get<std::string>());
  if (!a.plan.empty()) writeFileAtomically(a.plan, dumpJson(checked["plan"]));
}

}  // namespace

void addCheck(CLI::App& app, Action& action) {
  CLI::App* cmd = app.add_subcommand(
      "check", "before a bake: what will be modelled, the lights, the layout, and what memory, disk and time it takes");
  cmd->footer(
      "Give the options of the bake that is meant: the estimates are of that one. Warnings end with 0, too; 3: the "
      "file is\n"
      "bad, or the bake would fail.");
  const auto a = std::make_shared<CheckArguments>();
  cmd->add_option("SCENE", a->scene, "a .glb or .gltf file in metres; none: the built-in room");
  cmd->add_flag("--json", a->json, "as JSON");
  cmd->add_option("--plan", a->plan,
                  "write PLAN.json, which fixes scene and settings for several machines: lucarne bake --plan PLAN.json "
                  "--part K/N -o ...");
  addQualityOptions(*cmd, a->options, a->texts);
  addTracingOptions(*cmd, a->options);
  cmd->callback([=, &action] { action = [=] { runCheck(*a); }; });
}

}  // namespace lucarne
