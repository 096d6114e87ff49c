#include "player/map_fit.h"

#include <epoxy/gl.h>

#include <array>

#include "base/error.h"
#include "base/units.h"
#include "player/coarser_directions.h"
#include "player/map_tables.h"
#include "player/map_upload.h"

namespace lucarne {
namespace {

const char* nameOf(LightMapFormat format) {
  return format == LightMapFormat::float32 ? "float" : format == LightMapFormat::half ? "half" : "rgb9e5";
}

}  // namespace

MapFit fitMaps(const LightMaps& maps, LightMapFormat wanted, std::uint64_t memory, const TextureLimits& limits) {
  MapFit fit{wanted, std::nullopt, ""};
  if (memory == 0) return fit;
  const auto bytes = [&] { return mapTextureBytes(fit.fewer ? *fit.fewer : maps, fit.format, limits); };
  const std::uint64_t asked = bytes();
  if (asked <= memory) return fit;
  constexpr std::array kSmaller = {LightMapFormat::half, LightMapFormat::rgb9e5};
  for (const LightMapFormat format : kSmaller) {
    if (bytesPerTexel(format) < bytesPerTexel(fit.format) && bytes() > memory) fit.format = format;
  }
  for (int count = maps.directionCount / 2; bytes() > memory && count >= 1; count /= 2)
    fit.fewer = withFewerDirections(maps, count);
  if (bytes() > memory) {
    throw Error(ExitCode::outOfResource, "the light maps take " + formatBytes(bytes()) +
                                             " of GPU memory even with one direction, and " + formatBytes(memory) +
                                             " are there; bake with a lower --density");
  }
  fit.note = "the light maps would take " + formatBytes(asked) + " of GPU memory, and " + formatBytes(memory) +
             " are there: shown as " + nameOf(fit.format);
  if (fit.fewer) {
    fit.note += " with " + std::to_string(fit.fewer->directionCount) + " of " + std::to_string(maps.directionCount) +
                " directions";
  }
  return fit;
}

std::uint64_t freeGpuMemory() {
  constexpr GLenum kFreeNvidia = 0x9049,
                   kFreeTexturesAti = 0x87fc;  // GL_NVX_gpu_memory_info, GL_ATI_meminfo; kilobytes
  GLint kilobytes[4] = {};
  if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info")) {
    glGetIntegerv(kFreeNvidia, kilobytes);
  } else if (epoxy_has_gl_extension("GL_ATI_meminfo")) {
    glGetIntegerv(kFreeTexturesAti, kilobytes);
  }
  return kilobytes[0] > 0 ? static_cast<std::uint64_t>(kilobytes[0]) * 1024 : 0;
}

}  // namespace lucarne
