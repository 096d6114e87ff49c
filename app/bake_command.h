// Bakes as commands that a user can type.
#pragma once

#include <string>

#include "app/bake_options.h"

namespace lucarne {

/// "lucarne bake room.glb -o OUTPUT --seed 3 …": the command that bakes with the settings of a part, defaults left out,
/// `rest` at the end. Names are quoted for a shell. Errors as optionsOf().
std::string bakeCommand(const PartHeader& header, const std::string& output, const std::string& rest);

/// The same of options as they were typed: paths, piece, format and instruction set, too. Nothing that only decides how
/// fast this machine works or what it reports.
std::string bakeCommand(const BakeOptions& options);

/// 'it'\''s' for it's; plain names as they are.
std::string quotedForShell(const std::string& name);

}  // namespace lucarne
