#include <iostream>
#include <memory>

#include "app/probe_points.h"
#include "cli/commands.h"

namespace lucarne {

void addProbe(CLI::App& app, Action& action) {
  CLI::App* cmd = app.add_subcommand("probe", "ask light maps at points: lines \"x y z nx ny nz\" on standard input");
  const auto path = std::make_shared<std::string>();
  const auto text = std::make_shared<bool>(false);
  cmd->add_option("DLM", *path, "the light maps")->required();
  auto* json = cmd->add_flag_function("--json", [](std::int64_t) {}, "answers are one JSON line each: the default");
  cmd->add_flag("--text", *text, "answers for people instead of JSON")->excludes(json);
  cmd->callback([=, &action] { action = [=] { probePoints(*path, std::cin, std::cout, *text); }; });
}

}  // namespace lucarne
