// What a bake says of itself: the report, and the part of it that the .dlm keeps.
#pragma once

#include <array>
#include <nlohmann/json.hpp>

#include "app/bake_scene.h"
#include "distributed/part_header.h"

namespace lucarne {

/// What there is to report on. `header` has its content hash; `baked` is null where no maps were made.
struct ReportInput {
  const BakeOptions& options;
  const Scene& scene;
  const BakePlan& plan;
  const PartHeader& header;
  const Baked* baked;
};

/// The report's keys are a contract with others; see docs/report.md.
nlohmann::json makeReport(const ReportInput& input);

/// Keys whose values differ from run to run of one bake.
inline constexpr std::array kRunKeys = {"seconds", "photons_per_second", "rays_per_second", "trace_variant_speedup", "threads",
                                        "ranks",   "checkpoints",        "checkpoint_seconds", "peak_memory_bytes"};

/// Nothing that differs from run to run of the same bake, on one machine or on many.
nlohmann::json provenanceOf(nlohmann::json report);

/// What ends the bake: `photons` (null: unlimited), and where they are given `time_seconds` and `target_error`.
nlohmann::json stopSettings(const BakeOptions& options);

/// `format`, and `k_max` where that means anything.
nlohmann::json formatSettings(const DlmFormat& format);

/// The file's name, or that of the built-in scene.
std::string sceneName(const BakeOptions& options);

}  // namespace lucarne
