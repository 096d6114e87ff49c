#include "dlm/atlas.h"

#include "dlm/pack.h"

namespace lucarne {

AtlasUv placeInAtlas(const ChartSet& charts, const TexelLayout& layout, LightMaps& maps) {
  std::vector<RectSize> sizes;
  for (const MapChart& c : maps.charts) sizes.push_back({c.width, c.height});
  PackOptions options;
  options.singlePage = true;
  const Packing packing = packRectangles(sizes, options);
  maps.atlasWidth = packing.pageWidth;
  maps.atlasHeight = packing.pageHeight;
  for (std::size_t c = 0; c < maps.charts.size(); ++c) {
    maps.charts[c].atlasX = packing.places[c].x;
    maps.charts[c].atlasY = packing.places[c].y;
  }
  AtlasUv uv;
  uv.chartOfTriangle = charts.chartOfTriangle;
  uv.corner.resize(charts.chartOfTriangle.size());
  for (std::size_t t = 0; t < uv.corner.size(); ++t) {
    const std::uint32_t c = charts.chartOfTriangle[t];
    if (c == kNone) continue;
    const Vec2d scale = layout.charts[c].texelsPerLocal;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2f p = charts.cornerUv[t][k];
      uv.corner[t][k] = {static_cast<float>((maps.charts[c].atlasX + static_cast<double>(p.x) * scale.x) / maps.atlasWidth),
                         static_cast<float>((maps.charts[c].atlasY + static_cast<double>(p.y) * scale.y) / maps.atlasHeight)};
    }
  }
  return uv;
}

}  // namespace lucarne
