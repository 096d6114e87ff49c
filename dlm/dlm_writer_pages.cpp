#include "dlm/dlm_writer_pages.h"

#include <cstdio>

namespace lucarne {

namespace {

constexpr const char* kRgb[3] = {"R", "G", "B"};

ExrChannel channel(const std::string& name, ChannelType type, std::size_t pixels) {
  ExrChannel result;
  result.name = name;
  result.type = type;
  result.floats.resize(pixels);
  return result;
}

ExrLayer layer(const std::string& name, int width, int height, std::initializer_list<const char*> channels,
               ChannelType type) {
  ExrLayer result;
  result.name = name;
  result.width = width;
  result.height = height;
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (const char* c : channels) result.channels.push_back(channel(c, type, pixels));
  return result;
}

std::size_t pixelAt(const ExrLayer& page, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(page.width) + static_cast<std::size_t>(x);
}

// Texels around the charts' rectangles, and the nearest texel of a rectangle for each.
struct GutterTexel {
  std::size_t target, source;
};

class GutterFinder {
 public:
  GutterFinder(const LightMaps& maps, const ExrLayer& page)
      : maps_(maps),
        page_(page),
        taken_(static_cast<std::size_t>(page.width) * static_cast<std::size_t>(page.height)) {}

  // Ring by ring over all charts, so that a texel goes to a rectangle of those nearest to it.
  std::vector<GutterTexel> find() {
    constexpr int kRings = 4;
    for (const MapChart& chart : maps_.charts) {
      for (int y = 0; y < chart.height; ++y) {
        for (int x = 0; x < chart.width; ++x) taken_[pixelAt(page_, chart.atlasX + x, chart.atlasY + y)] = true;
      }
    }
    for (int ring = 1; ring <= kRings; ++ring) {
      for (const MapChart& chart : maps_.charts) addRing(chart, ring);
    }
    return std::move(found_);
  }

 private:
  void addRing(const MapChart& chart, int ring) {
    for (int x = -ring; x < chart.width + ring; ++x) {
      addTexel(chart, x, -ring);
      addTexel(chart, x, chart.height + ring - 1);
    }
    for (int y = 1 - ring; y < chart.height + ring - 1; ++y) {
      addTexel(chart, -ring, y);
      addTexel(chart, chart.width + ring - 1, y);
    }
  }

  void addTexel(const MapChart& chart, int x, int y) {
    const int px = chart.atlasX + x, py = chart.atlasY + y;
    if (px < 0 || py < 0 || px >= page_.width || py >= page_.height || taken_[pixelAt(page_, px, py)]) return;
    taken_[pixelAt(page_, px, py)] = true;
    const int nearX = std::clamp(x, 0, chart.width - 1), nearY = std::clamp(y, 0, chart.height - 1);
    found_.push_back({pixelAt(page_, px, py), pixelAt(page_, chart.atlasX + nearX, chart.atlasY + nearY)});
  }

  const LightMaps& maps_;
  const ExrLayer& page_;
  std::vector<bool> taken_;
  std::vector<GutterTexel> found_;
};

// Calls use(texel of the maps, pixel of the page) for every texel of the lit sides of one kind.
template <class Use>
void forEachTexel(const LightMaps& maps, bool back, const ExrLayer& page, Use use) {
  for (const SideMaps& side : maps.sides) {
    if (!side.lit || side.back != back) continue;
    const MapChart& chart = maps.charts[side.chart];
    std::size_t texel = side.firstTexel;
    for (int y = 0; y < side.height; ++y) {
      for (int x = 0; x < side.width; ++x) use(texel++, pixelAt(page, chart.atlasX + x, chart.atlasY + y));
    }
  }
}

void addSide(const LightMaps& maps, bool back, std::vector<ExrLayer>& layers) {
  const std::string name = back ? "back" : "front";
  const int width = std::max(1, maps.atlasWidth), height = std::max(1, maps.atlasHeight);  // a scene may have no charts
  ExrLayer light = layer(name, width, height, {kRgb[0], kRgb[1], kRgb[2]}, ChannelType::float32);
  ExrLayer statistics =
      layer(name + dlm_file::kStatistics, width, height, {"photons", "relative_error", "standard_error"}, ChannelType::float32);
  forEachTexel(maps, back, light, [&](std::size_t texel, std::size_t pixel) {
    for (int c = 0; c < 3; ++c) light.channels[static_cast<std::size_t>(c)].floats[pixel] = maps.irradiance[texel][c];
    statistics.channels[0].floats[pixel] = maps.photons[texel];
    statistics.channels[1].floats[pixel] = maps.relativeError[texel];
    statistics.channels[2].floats[pixel] = maps.standardError[texel];
  });
  light.attributes["units"] = "lx";
  layers.push_back(std::move(light));
  layers.push_back(std::move(statistics));
}

}  // namespace

std::vector<ExrLayer> irradianceLayers(const LightMaps& maps) {
  std::vector<ExrLayer> layers;
  addSide(maps, false, layers);
  if (hasLitBack(maps)) addSide(maps, true, layers);
  const std::vector<GutterTexel> gutter = GutterFinder(maps, layers.front()).find();
  for (std::size_t i = 0; i < layers.size(); i += 2) {
    for (ExrChannel& c : layers[i].channels) {
      for (const GutterTexel& texel : gutter) c.floats[texel.target] = c.floats[texel.source];
    }
  }
  return layers;
}

double directionalScale(const LightMaps& maps) {
  float largest = 0;
  for (const Rgb& texel : maps.directional) {
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(texel[c]));
  }
  if (!(largest > 0)) return 1;
  int exponent = 0;
  std::frexp(static_cast<double>(largest), &exponent);  // largest = m · 2^exponent, m in [½, 1)
  return std::ldexp(1.0, exponent - 15);
}

}  // namespace lucarne
