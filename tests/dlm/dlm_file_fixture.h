// A small scene with hand-made light maps, as a bake would leave them.
#pragma once

#include <gtest/gtest.h>

#include <random>

#include "dlm/direction_set.h"
#include "dlm/dlm_reader.h"
#include "dlm/dlm_writer.h"
#include "dlm/mean_direction.h"
#include "tests/support/scene_builder.h"

namespace lucarne::test {

/// Charts are added with the scene's quads, one a quad; texels are canonical: as a reader numbers them.
class BakedScene {
 public:
  explicit BakedScene(int directionCount) { maps_.directionCount = directionCount; }

  SceneBuilder builder;

  /// The next quad's chart: width × height texels over its corners (0,0) (0,h) (w,h) (w,0), at a place of the atlas.
  MapChart& addChart(std::uint32_t material, Vec3f normal, int width, int height, int atlasX, int atlasY,
                     double texelSize) {
    MapChart chart;
    chart.material = material;
    chart.normal = normal;
    chart.width = width;
    chart.height = height;
    chart.atlasX = atlasX;
    chart.atlasY = atlasY;
    chart.texelSize = texelSize;
    maps_.charts.push_back(chart);
    const auto index = static_cast<std::uint32_t>(maps_.charts.size() - 1);
    stOfTriangle_.push_back({Vec2d{0, 0}, Vec2d{0, 1.0 * height}, Vec2d{1.0 * width, 1.0 * height}});
    stOfTriangle_.push_back({Vec2d{0, 0}, Vec2d{1.0 * width, 1.0 * height}, Vec2d{1.0 * width, 0}});
    uv_.chartOfTriangle.insert(uv_.chartOfTriangle.end(), 2, index);
    return maps_.charts.back();
  }

  void addTriangleWithoutChart() {
    stOfTriangle_.push_back({});
    uv_.chartOfTriangle.push_back(kNone);
  }

  /// A side of the chart added last. `value(x, y)` is its irradiance.
  template <class Value>
  SideMaps& addSide(bool back, Value value) {
    MapChart& chart = maps_.charts.back();
    SideMaps side;
    side.chart = static_cast<std::uint32_t>(maps_.charts.size() - 1);
    side.back = back;
    side.lit = true;
    side.width = chart.width;
    side.height = chart.height;
    side.firstTexel = maps_.irradiance.size();
    (back ? chart.backSide : chart.frontSide) = static_cast<std::uint32_t>(maps_.sides.size());
    for (int y = 0; y < side.height; ++y) {
      for (int x = 0; x < side.width; ++x) {
        maps_.irradiance.push_back(value(x, y));
        maps_.photons.push_back(static_cast<float>(maps_.photons.size() % 97));
        maps_.relativeError.push_back(0.01f * static_cast<float>(maps_.relativeError.size() % 13));
        maps_.standardError.push_back(0.1f * static_cast<float>(maps_.standardError.size() % 11));
      }
    }
    maps_.sides.push_back(side);
    return maps_.sides.back();
  }

  SideMaps& addUnlitSide(bool back) {
    SideMaps& side = addSide(back, [](int, int) { return Rgb{}; });
    const std::size_t texels = side.firstTexel;
    maps_.irradiance.resize(texels);
    maps_.photons.resize(texels);
    maps_.relativeError.resize(texels);
    maps_.standardError.resize(texels);
    side.firstTexel = 0;
    side.lit = false;
    return side;
  }

  /// A stored direction of the side added last.
  template <class Value>
  void addDirection(int psi, Value value) {
    SideMaps& side = maps_.sides.back();
    side.directions.push_back({static_cast<std::uint16_t>(psi), maps_.directional.size()});
    for (int y = 0; y < side.height; ++y) {
      for (int x = 0; x < side.width; ++x) maps_.directional.push_back(value(x, y));
    }
  }
  void addEmptyDirection(int psi) {
    maps_.sides.back().directions.push_back({static_cast<std::uint16_t>(psi), SideDirection::kEmptyMap});
  }

  /// Mean directions of all that is stored, anywhere within half the reach of their ψ.
  void addMeans() {
    const DirectionSet set(maps_.directionCount);
    std::mt19937 rng(9);
    std::uniform_real_distribution<float> uniform(-0.5f, 0.5f);
    maps_.meanDirections.resize(maps_.directional.size());
    for (const SideMaps& side : maps_.sides) {
      for (const SideDirection& d : side.directions) {
        for (std::uint64_t t = 0; d.stored() && t < side.texelCount(); ++t) {
          const Vec3f offset = Vec3f{uniform(rng), uniform(rng), uniform(rng)} * meanReach(maps_.directionCount);
          maps_.meanDirections[d.first + t] = boundedMean(Vec3f(set.direction(d.psi)) + offset);
        }
      }
    }
  }

  void setAtlas(int width, int height) {
    maps_.atlasWidth = width;
    maps_.atlasHeight = height;
  }

  const LightMaps& maps() const { return maps_; }

  AtlasUv uv() const {
    AtlasUv uv = uv_;
    for (std::size_t t = 0; t < stOfTriangle_.size(); ++t) {
      std::array<Vec2f, 3> corners{};
      if (uv.chartOfTriangle[t] != kNone) {
        const MapChart& chart = maps_.charts[uv.chartOfTriangle[t]];
        for (std::size_t k = 0; k < 3; ++k) {
          corners[k] = {static_cast<float>((chart.atlasX + stOfTriangle_[t][k].x) / maps_.atlasWidth),
                        static_cast<float>((chart.atlasY + stOfTriangle_[t][k].y) / maps_.atlasHeight)};
        }
      }
      uv.corner.push_back(corners);
    }
    return uv;
  }

  void write(const std::filesystem::path& folder, const DlmFormat& format = {},
             const nlohmann::json& provenance = nlohmann::json::object()) const {
    writeDlm(folder, builder.build(), uv(), maps_, provenance, format);
  }

  /// What reading it again gives, by way of a folder.
  Dlm reread(const std::filesystem::path& folder) const {
    write(folder, {MapFormat::float32, ExrCompression::none});
    return readDlm(folder);
  }

 private:
  LightMaps maps_;
  AtlasUv uv_;
  std::vector<std::array<Vec2d, 3>> stOfTriangle_;
};

inline Material doubleSidedMaterial() {
  Material material = diffuseMaterial(Rgb{0.5f});
  material.doubleSided = true;
  return material;
}

/// A two-sided floor lit on both sides with directions, a one-sided wall with irradiance only, a one-sided box lid that
/// no light reached, and a triangle without area. `brightness` scales all light.
inline BakedScene smallBakedScene(float brightness = 1, int directionCount = 14) {
  BakedScene scene(directionCount);
  scene.builder.addMaterial(doubleSidedMaterial());
  scene.builder.addDiffuse(Rgb{0.8f});
  std::mt19937 rng(3);
  std::uniform_real_distribution<float> uniform(0.001f, 100);
  const auto random = [&](int, int) { return Rgb{uniform(rng), uniform(rng), uniform(rng)} * brightness; };

  scene.builder.addQuad({0, 0, 0}, {0, 0, 3}, {4, 0, 3}, {4, 0, 0}, 0);
  scene.addChart(0, {0, 1, 0}, 4, 3, 1, 1, 1);
  scene.addSide(false, random);
  scene.addDirection(0, random);
  scene.addEmptyDirection(2);
  scene.addDirection(directionCount - 1, random);
  scene.addSide(true, random);
  scene.addDirection(1, random);

  scene.builder.addQuad({0, 5, 0}, {0, 0, 0}, {2, 0, 0}, {2, 5, 0}, 1);
  scene.addChart(1, {0, 0, 1}, 2, 5, 7, 1, 1);
  scene.addSide(false, random);

  scene.builder.addTriangle({1, 1, 1}, {1, 1, 1}, {2, 1, 1}, 1);
  scene.addTriangleWithoutChart();

  scene.builder.addQuad({9, 3, 0}, {9, 3, 1}, {10, 3, 1}, {10, 3, 0}, 1);
  scene.addChart(1, {0, 1, 0}, 1, 1, 14, 10, 1);
  scene.addUnlitSide(false);
  scene.setAtlas(16, 12);
  return scene;
}

}  // namespace lucarne::test
