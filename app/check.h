// The preflight: what a bake would model, light, need and take, told before it is started. docs/check.md says what each
// section means.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/bake_options.h"

namespace lucarne {

/// Reads the scene, lays it out and traces photons for about half a second; writes nothing. Failures as in bake():
/// UsageError, or InputError for a scene that no bake would take. Keys: kind, program, scene, modelled, left_out, lights,
/// uv, surfaces, layout, resources, time, settings, warnings [{id, text}], failures (why the bake would fail: texts), and
/// plan (plan_file.h, seen from `planFolder`).
nlohmann::json checkScene(const BakeOptions& options, const std::filesystem::path& planFolder = {});

/// The same for people: aligned sections, warnings last.
std::string checkText(const nlohmann::json& checked);

}  // namespace lucarne
