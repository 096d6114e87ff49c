// Options of bake and check that decide the result.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <set>
#include <string>

#include "cli/layout_options.h"

namespace lucarne {

/// Numbers arrive as text, so that 20M and 1e9 work and nonsense is refused in our words.
struct QualityTexts {
  LayoutTexts layout;
  std::string environment, seed = "0";
  std::optional<double> kernelWidth;
  std::string dropError = "0%";
};

/// Those of addLayoutOptions() and addSkyOptions(), and --kernel, --kernel-width, --seams, --drop-error, --seed, --sampler, --light,
/// --no-guide. `o` and `texts` must outlive the parsing.
void addQualityOptions(CLI::App& cmd, BakeOptions& o, QualityTexts& texts);
/// --threads, --format, --kmax, --isa.
void addTracingOptions(CLI::App& cmd, BakeOptions& o);
/// After parsing: UsageError for texts that are no numbers.
void finishQuality(BakeOptions& o, const QualityTexts& texts);

/// The options that stood on the command line, "--density" and the like.
std::set<std::string> typedOptions(const CLI::App& cmd);

}  // namespace lucarne
