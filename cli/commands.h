// One function a subcommand: adds it to the command line, with its options, and the action that runs when it is chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace lucarne {

/// Set by the subcommand that was chosen; run by main after parsing. Returns nothing; failures are exceptions.
using Action = std::function<void()>;

void addBake(CLI::App& app, Action& action);
void addMerge(CLI::App& app, Action& action);
void addCheck(CLI::App& app, Action& action);
void addInfo(CLI::App& app, Action& action);
void addProbe(CLI::App& app, Action& action);
void addCompare(CLI::App& app, Action& action);
void addRender(CLI::App& app, Action& action);  // with OpenGL only
void addPlay(CLI::App& app, Action& action);

}  // namespace lucarne
