#include "player/stored_light.h"

#include <algorithm>
#include <array>

#include "base/error.h"

namespace lucarne {
namespace {

/// Two texels, and how much the second counts.
struct Between {
  int first, count;
  double share;
  Between(double position, int size) {
    const double p = std::clamp(position - 0.5, 0.0, size - 1.0);
    first = static_cast<int>(p);
    count = std::min(2, size - first);
    share = p - first;
  }
};

}  // namespace

std::vector<Rgbd> storedLight(const GpuMaps& gpu, const LightMaps& maps, std::uint32_t index, Vec2d st) {
  const SideMaps& side = maps.sides[index];
  const auto stored = std::count_if(side.directions.begin(), side.directions.end(), [](const auto& d) { return d.stored(); });
  const Between x(st.x, side.width), y(st.y, side.height);
  const auto at = [&](int column, int row) {
    return (column == 0 ? 1 - x.share : x.share) * (row == 0 ? 1 - y.share : y.share);
  };
  std::vector<Rgbd> light;
  std::vector<Rgb> texels;
  for (int first = 0; first < stored; first += gpu.layersPerStrip) {
    const int layers = std::min(static_cast<int>(stored) - first, gpu.layersPerStrip);
    const LayeredPlace place = placeOf(gpu.places[index], gpu.layersPerStrip, first, side.width);
    texels.resize(static_cast<std::size_t>(x.count * y.count * layers));
    glGetTextureSubImage(gpu.directional.get(), 0, place.x + x.first, place.y + y.first, place.layer, x.count, y.count, layers,
                         GL_RGB, GL_FLOAT, static_cast<GLsizei>(texels.size() * sizeof(Rgb)), texels.data());
    const Rgb* texel = texels.data();
    for (int layer = 0; layer < layers; ++layer) {
      Rgbd sum{};
      for (int row = 0; row < y.count; ++row) {
        for (int column = 0; column < x.count; ++column) sum += Rgbd(*texel++) * at(column, row);
      }
      light.push_back(sum * static_cast<double>(gpu.mapUnit));
    }
  }
  return light;
}

}  // namespace lucarne
