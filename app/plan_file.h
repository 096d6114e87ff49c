// plan.json: the settings of a bake, fixed before several machines take pieces of it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "app/bake_options.h"

namespace lucarne {

/// Written by `check --plan`: all that decides the result (settings, photons, kernel, format), where the scene and its
/// sky lie, seen from the folder of the plan, and hashes of them, so that another scene is noticed. `header` is that of
/// the bake with nothing traced.
nlohmann::json planOf(const BakeOptions& options, const PartHeader& header, const std::filesystem::path& folder);

/// `given`, with every setting that decides the result as the plan has it. `typed`: options that stood on the command
/// line ("--density"); UsageError for one that contradicts the plan. Scene and environment come from the plan unless
/// they were typed. InputError for a file that is no plan, or one of settings that this program does not know.
BakeOptions withPlan(const BakeOptions& given, const std::set<std::string>& typed, const std::filesystem::path& plan);

/// Error(mergeRefused) with what differs when the bake is not that of the plan: another scene, sky or layout. A warning
/// where this machine traces rays otherwise than the one that made the plan.
void checkAgainstPlan(const std::filesystem::path& plan, const PartHeader& header);

}  // namespace lucarne
