#include "player/map_source.h"

#include "player/map_tables.h"

namespace lucarne {
namespace {

/// The GPU gets the values of the file as they are, times its scale in the shader.
bool goesAsItIs(const DirectionalFile& file) {
  constexpr double kLeast = 0x1p-100, kMost = 0x1p100;  // products with halves are ordinary floats
  const bool bounded = file.format() == MapFormat::half || file.format() == MapFormat::rgb9e5;
  return bounded && !file.hasMeans() && file.scale() >= kLeast && file.scale() <= kMost;
}

}  // namespace

MapSource sourceOf(OpenedDlm& opened, LightMapFormat format, std::uint64_t memory, const TextureLimits& limits) {
  const LightMaps& maps = opened.dlm.maps;
  if (!opened.directional) return maps;
  const LightMapFormat smallest = LightMapFormat::rgb9e5;
  const bool fits = memory == 0 || mapTextureBytes(maps, format, limits) <= memory ||
                    mapTextureBytes(maps, smallest, limits) <= memory;
  if (goesAsItIs(*opened.directional) && fits) return {maps, *opened.directional};
  readInto(*opened.directional, opened.dlm.maps);
  opened.directional.reset();
  return maps;
}

}  // namespace lucarne
