// Options that several commands share with bake: what is laid out and traced, and how this machine works.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/bake_options.h"
#include "cli/choices.h"

namespace lucarne {

/// Numbers arrive as text, so that 20M and 1e9 work and nonsense is refused in our words.
struct LayoutTexts {
  std::string photons = "20M", directions = "auto", texels = "1M", directSamples = "64";
};

/// --photons, --directions, --density, --charts, --texels, --direct, --direct-samples, --direction-filter, --moments, --keep-all-directions. `o` and
/// `texts` must outlive the parsing.
void addLayoutOptions(CLI::App& cmd, BakeOptions& o, LayoutTexts& texts);
/// After parsing: UsageError for texts that are no numbers.
void finishLayout(BakeOptions& o, const LayoutTexts& texts);

/// --environment, --environment-scale, --environment-turn. As above.
void addSkyOptions(CLI::App& cmd, BakeOptions& o, std::string& environment);
/// After parsing.
void finishSky(BakeOptions& o, const std::string& environment);

/// --threads, --format and --kmax.
void addMachineOptions(CLI::App& cmd, BakeOptions& o);
/// --format and --kmax.
void addFormatOptions(CLI::App& cmd, DlmFormat& format);

/// --seams, of a bake or (std::optional) of a merge.
template <class Seams>
void addSeams(CLI::App& cmd, Seams& seams, const std::string& defaultName) {
  addChoice<Seams>(cmd, "--seams", seams, {{"fit", SeamMode::fit}, {"keep", SeamMode::keep}}, defaultName,
                   "where charts continue each other: fit their light together, or keep it as it was found");
}

}  // namespace lucarne
