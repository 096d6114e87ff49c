// The bake: scene in, light maps out.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/bake_options.h"

namespace lucarne {

/// Bakes and writes the .dlm (and the report where asked). Returns the report. Throws Error; leaves nothing half-written.
nlohmann::json bake(const BakeOptions& options);

}  // namespace lucarne
