// What a bake leaves behind: light maps or a part, and the report.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "app/bake_setup.h"
#include "distributed/bake_job.h"

namespace lucarne {

/// Error(failed) unless a part can be written there: nothing but parts is replaced, and none that holds a photon which
/// the new one lacks (not asked when `photons` is not known yet).
void checkPartOutput(const std::filesystem::path& path, const std::optional<IndexSet>& photons);
/// The same for a folder of light maps, which replaces such folders alone.
void checkMapsOutput(const std::filesystem::path& path);

/// Asked before the work, not after it: Error(failed) where an output cannot be written, or would replace something
/// that a bake of these options did not make.
void checkOutputs(const BakeOptions& options);

/// Light maps of what the state holds, at `path`. Returns their report.
nlohmann::json writeMaps(const BakeSetup& setup, const BakeState& state, const std::filesystem::path& path,
                         JobEnd end = JobEnd::interrupted);

/// Writes everything the options ask for and removes the saved states. Returns the report.
nlohmann::json finish(const BakeSetup& setup, BakeState& state, CheckpointFolder& folder, const JobResult& result);

}  // namespace lucarne
