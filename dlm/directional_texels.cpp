// Directional maps out of their file into memory.
#include "base/error.h"
#include "base/huge_advice.h"
#include "dlm/direction_set_cells.h"
#include "dlm/directional_file.h"
#include "dlm/mean_direction.h"
#include "dlm/texel_rows.h"

namespace lucarne {
namespace {

template <class T>
void makeRoom(std::vector<T>& texels, std::uint64_t count) {
  texels.reserve(count);
  askForHugePages(texels.data(), count * sizeof(T));
  texels.resize(count);
}

/// In lx.
void readMap(const DecodedPage& page, const PlacedMap& map, const DirectionalFile& file, Rgb* to) {
  const auto width = static_cast<std::size_t>(map.width);
  bool finite = true;
  for (int y = 0; y < map.height; ++y, to += width) {
    const std::byte* row = page.row(map, y);
    if (page.kind == TexelKind::code && file.format() == MapFormat::ldr8) {
      for (std::size_t x = 0; x < width; ++x) to[x] = unpackLdr8(texelAt<std::uint32_t>(row + 4 * x), map.scale);
    } else {
      forEachValue(page.kind, row, width, [&](std::size_t x, Rgb value) { to[x] = Rgb(Rgbd(value) * file.scale()); });
    }
    for (std::size_t x = 0; x < width; ++x) finite &= isFinite(to[x]);
  }
  if (!finite) throw InputError(file.path().string() + ": its values times the scale of the manifest are not finite");
}

void readMeans(const DirectionalFile& file, LightMaps& maps) {
  const std::vector<Vec3d> psis = spreadDirections(maps.directionCount);
  const float reach = meanReach(maps.directionCount, maps.directionFilter);
  const auto readMap = [&](const DecodedPage& page, const PlacedMap& map) {
    const Vec3f psi(psis[map.psi]);
    Vec3f* to = &maps.meanDirections[map.first];
    for (int y = 0; y < map.height; ++y) {
      const std::byte* row = page.row(map, y);
      for (std::size_t x = 0; x < static_cast<std::size_t>(map.width); ++x) {
        const auto code = texelAt<std::uint32_t>(row + 4 * x);
        if (!isMeanCode(code)) throw InputError(file.meansPath().string() + ": holds a number that is no mean direction");
        *to++ = unpackMean(code, psi, reach);
      }
    }
  };
  file.readMeans({[&] { makeRoom(maps.meanDirections, file.texels()); }, [&](const DecodedPage& page) {
                    for (const PlacedMap& map : page.maps) readMap(page, map);
                  }});
}

}  // namespace

void readInto(const DirectionalFile& file, LightMaps& maps) {
  file.read({[&] { makeRoom(maps.directional, file.texels()); }, [&](const DecodedPage& page) {
               for (const PlacedMap& map : page.maps) readMap(page, map, file, &maps.directional[map.first]);
             }});
  if (file.hasMeans()) readMeans(file, maps);
}

}  // namespace lucarne
