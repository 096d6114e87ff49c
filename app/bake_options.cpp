#include "app/bake_options.h"

#include <cmath>

#include "base/error.h"

namespace lucarne {

void check(const BakeOptions& o) {
  if (o.photons == 0) throw UsageError("--photons must be at least 1");
  if (o.directions < 1 || o.directions > 4096) throw UsageError("--directions must be 1 to 4096");
  if (!(o.texelsPerMetre > 0) || !std::isfinite(o.texelsPerMetre)) throw UsageError("--density must be a positive number of texels per metre");
  if (o.texelBudget == 0) throw UsageError("--texels must be at least 1");
  if (!(o.kernel.width >= 0.5 && o.kernel.width <= 16)) throw UsageError("--kernel-width must be 0.5 to 16 texels");
  if (o.threads < 0 || o.threads > 1024) throw UsageError("--threads must be 0 (all) to 1024");
  if (o.output.empty()) throw UsageError("-o OUT.dlm is missing");
}

}  // namespace lucarne
