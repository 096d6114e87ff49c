// The tallies of hours, where the disk that they were meant for fails.
#pragma once

#include "app/bake_setup.h"
#include "distributed/bake_job.h"

namespace lucarne {

/// Saves the state wherever it can be: in its folder, beside the output, in the folder that the program was started in,
/// in the one for temporary files. Where all of them fail it waits and tries again, for an hour at most or until it is
/// told to stop. Returns what the user has to know to go on, for the end of an error's line.
std::string rescueState(const BakeSetup& setup, const BakeState& state, CheckpointFolder& folder);

/// The same for states that are saved.
std::string howToGoOn(const BakeState& state, const std::string& place);

}  // namespace lucarne
