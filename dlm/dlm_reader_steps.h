// readDlm() for those who show how far it is.
#pragma once

#include <functional>
#include <string>

#include "dlm/dlm_reader.h"

namespace lucarne {

/// Told before each step what is read and the share that is done, by bytes. What it throws ends the reading.
using DlmStep = std::function<void(const std::string& step, double share)>;

Dlm readDlm(const std::filesystem::path& folder, const DlmStep& observe);

}  // namespace lucarne
