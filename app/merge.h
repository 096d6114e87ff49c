// Merging parts into light maps, or into one part.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/bake_options.h"
#include "app/report_pictures.h"

namespace lucarne {

struct MergeOptions {
  std::vector<std::string> inputs;              // parts, folders of them, @LIST files with a path a line
  std::optional<std::filesystem::path> output;  // NAME.dlm or NAME.part; none: only verify
  std::optional<KernelShape> kernel;            // none: as the parts were baked
  std::optional<double> kernelWidth;
  std::optional<SeamMode> seams;
  std::optional<double> dropError;
  bool complete = false;  // missing photons are an error
  DlmFormat format;
  std::optional<std::filesystem::path> report;
  bool quiet = false;
};

/// Returns the report: that of a bake of the same photons, and "parts", "missing_photons" ([begin, end] each). Throws
/// Error(mergeRefused) with one line that names the files and what differs; then nothing is written. Inputs are never
/// touched. A report of light maps gets its page, as that of a bake.
nlohmann::json merge(const MergeOptions& options, const PlayerPictures& player = {});

/// The files that the inputs stand for, in the order given; of a folder, its .part files by name. InputError for what
/// is not there.
std::vector<std::filesystem::path> partFiles(const std::vector<std::string>& inputs);

}  // namespace lucarne
