// readDlm() for those who show how far it is, and for those who take the directional maps page by page.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "dlm/directional_file.h"
#include "dlm/dlm_reader.h"

namespace lucarne {

/// Told before each step what is read and the share that is done, by bytes. What it throws ends the reading.
using DlmStep = std::function<void(const std::string& step, double share)>;

Dlm readDlm(const std::filesystem::path& folder, const DlmStep& observe);

struct OpenedDlm {
  Dlm dlm;                                     // all but maps.directional and maps.meanDirections
  std::optional<DirectionalFile> directional;  // none: no surface keeps light by direction
  double share = 1;                            // that is done, by bytes
};

/// As readDlm(), but for the directional maps, of which only the file's hash is checked.
OpenedDlm openDlm(const std::filesystem::path& folder, const DlmStep& observe);

}  // namespace lucarne
