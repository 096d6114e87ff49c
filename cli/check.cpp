#include "app/check.h"

#include <cstdio>
#include <memory>

#include "base/json.h"
#include "base/log.h"
#include "cli/commands.h"
#include "cli/layout_options.h"

namespace lucarne {

void addCheck(CLI::App& app, Action& action) {
  CLI::App* cmd = app.add_subcommand(
      "check", "before a bake: what will be modelled, the lights, the layout, and what memory, disk and time it takes");
  cmd->footer("Give the options of the bake that is meant: the estimates are of that one. Warnings end with 0, too.");
  const auto options = std::make_shared<BakeOptions>();
  const auto texts = std::make_shared<LayoutTexts>();
  const auto scene = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  cmd->add_option("SCENE", *scene, "a .glb or .gltf file in metres; none: the built-in room");
  cmd->add_flag("--json", *json, "as JSON");
  addLayoutOptions(*cmd, *options, *texts);
  const auto sky = std::make_shared<std::string>();
  addSkyOptions(*cmd, *options, *sky);
  addMachineOptions(*cmd, *options);
  cmd->callback([=, &action] {
    action = [=] {
      setQuiet(true);  // what is to be said stands in the result
      if (!scene->empty()) options->scene = *scene;
      finishLayout(*options, *texts);
      finishSky(*options, *sky);
      const nlohmann::json checked = checkScene(*options);
      std::fputs((*json ? dumpJson(checked) : checkText(checked)).c_str(), stdout);
    };
  });
}

}  // namespace lucarne
