// Light maps to be shown: the texels of their directional maps are in memory, or still in their file.
#pragma once

#include <functional>

#include "dlm/dlm_reader_steps.h"
#include "player/layered_pack.h"
#include "player/render_options.h"

namespace lucarne {

struct MapSource {
  MapSource(const LightMaps& inMemory) : maps(inMemory) {}  // NOLINT: they are one
  MapSource(const LightMaps& sides, const DirectionalFile& file) : maps(sides), directional(&file) {}

  const LightMaps& maps;
  const DirectionalFile* directional = nullptr;  // none: in memory
  /// Told while the file is read which share of it is done, on the thread that uploads. What it throws ends that.
  std::function<void(double share)> progress;
};

/// The directional maps go from the file to the GPU page by page, which saves memory and time, unless their values must
/// be seen first: exact formats, whose range is not known, mean directions, and what has to lose directions to fit into
/// `memory` (bytes of the GPU; 0: not known). Those are read into opened.dlm.maps.
MapSource sourceOf(OpenedDlm& opened, LightMapFormat format, std::uint64_t memory, const TextureLimits& limits);

}  // namespace lucarne
