#include "player/map_upload.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "base/error.h"
#include "dlm/mean_direction.h"
#include "player/lobe.h"
#include "player/map_stream.h"
#include "player/texel_coding.h"
#include "player/texel_formats.h"

namespace lucarne {
namespace {

/// A rectangle of one layer: the texels of one ψ of one side.
struct Rectangle {
  std::uint64_t first = 0;  // of the texels, into LightMaps::directional
  std::uint16_t psi = 0;
  LayeredPlace place;
  int width = 0, height = 0;
};

/// Everything that lies in each layer.
std::vector<std::vector<Rectangle>> rectanglesByLayer(const LightMaps& maps, const MapTables& tables) {
  std::vector<std::vector<Rectangle>> layers(static_cast<std::size_t>(tables.directional.layers));
  for (std::size_t i = 0; i < maps.sides.size(); ++i) {
    const SideMaps& side = maps.sides[i];
    if (!side.lit) continue;
    int rank = 0;
    for (const SideDirection& d : side.directions) {
      if (!d.stored()) continue;
      const LayeredPlace place = placeOf(tables, i, rank, side.width);
      layers[static_cast<std::size_t>(place.layer)].push_back(
          {d.first, d.psi, place, side.width, side.height});
      ++rank;
    }
  }
  return layers;
}

/// The rectangles of a layer, coded, where they lie in it; the rest is zero. `codeRow(rectangle, first texel, to)` codes a
/// row.
template <class CodeRow>
void codeLayer(const std::vector<Rectangle>& rectangles, std::size_t texelBytes, const CodeRow& codeRow, std::size_t pitch,
               std::span<std::byte> layer) {
  std::fill(layer.begin(), layer.end(), std::byte{0});
  for (const Rectangle& r : rectangles) {
    const auto width = static_cast<std::size_t>(r.width);
    for (int y = 0; y < r.height; ++y) {
      std::byte* to = layer.data() + static_cast<std::size_t>(r.place.y + y) * pitch +
                      static_cast<std::size_t>(r.place.x) * texelBytes;
      codeRow(r, r.first + static_cast<std::size_t>(y) * width, to);
    }
  }
}

/// Slice by slice: the layers of one are coded by all threads, then sent. `codeRow(rectangle, first texel, to)`.
template <class CodeRow>
GlTexture uploadPages(const LightMaps& maps, const MapTables& tables, const PixelCoding& coding, const CodeRow& codeRow) {
  constexpr std::size_t kSliceBytes = std::size_t{32} << 20;
  const LayeredPacking& packing = tables.directional;
  GlTexture texture =
      makeTexture({GL_TEXTURE_2D_ARRAY, coding.internal, 1, packing.width, packing.height, packing.layers});
  const std::size_t pitch = static_cast<std::size_t>(packing.width) * coding.bytes;
  const std::size_t layerBytes = pitch * static_cast<std::size_t>(packing.height);
  const auto layers = rectanglesByLayer(maps, tables);
  const std::size_t perSlice = std::clamp(kSliceBytes / layerBytes, std::size_t{1}, layers.size());
  std::vector<std::byte> slice(layerBytes * perSlice);
  for (std::size_t first = 0; first < layers.size(); first += perSlice) {
    const std::size_t count = std::min(perSlice, layers.size() - first);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      codeLayer(layers[first + i], coding.bytes, codeRow, pitch, std::span(slice).subspan(i * layerBytes, layerBytes));
    });
    glTextureSubImage3D(texture.get(), 0, 0, 0, static_cast<GLint>(first), packing.width, packing.height,
                        static_cast<GLsizei>(count), coding.layout, coding.type, slice.data());
  }
  return texture;
}

GlTexture uploadDirectional(const LightMaps& maps, const MapTables& tables, LightMapFormat format, float scale) {
  const TexelCoding coding = codingOf(format);
  return uploadPages(maps, tables, coding, [&](const Rectangle& r, std::uint64_t first, std::byte* to) {
    coding.writeRow({&maps.directional[first], static_cast<std::size_t>(r.width)}, scale, to);
  });
}

GlTexture uploadMeans(const LightMaps& maps, const MapTables& tables, const DirectionSet& set) {
  const float reach = meanReach(maps.directionCount, maps.directionFilter);
  const PixelCoding coding{GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, kMeanBytes};
  return uploadPages(maps, tables, coding, [&](const Rectangle& r, std::uint64_t first, std::byte* to) {
    const Vec3f psi(set.direction(r.psi));
    for (std::size_t x = 0; x < static_cast<std::size_t>(r.width); ++x, to += kMeanBytes) {
      const std::uint32_t code = packMean(maps.meanDirections[first + x], psi, reach);
      std::memcpy(to, &code, sizeof code);
    }
  });
}

/// One value a texel of the lit sides; `layout` is that of the floats at `texelsOf(side)`.
template <class TexelsOf>
GlTexture uploadSides(const LightMaps& maps, const LayeredPacking& packing, GLenum format, GLenum layout,
                      const TexelsOf& texelsOf) {
  GlTexture texture = makeTexture({GL_TEXTURE_2D_ARRAY, format, 1, packing.width, packing.height, packing.layers});
  glClearTexImage(texture.get(), 0, layout, GL_FLOAT, nullptr);
  for (std::size_t i = 0; i < maps.sides.size(); ++i) {
    const SideMaps& side = maps.sides[i];
    if (!side.lit) continue;
    const LayeredPlace& place = packing.places[i];
    glTextureSubImage3D(texture.get(), 0, place.x, place.y, place.layer, side.width, side.height, 1, layout, GL_FLOAT,
                        texelsOf(side));
  }
  return texture;
}

GlTexture uploadIrradiance(const LightMaps& maps, const LayeredPacking& packing) {
  return uploadSides(maps, packing, GL_RGBA32F, GL_RGB,
                     [&](const SideMaps& side) { return &maps.irradiance[side.firstTexel]; });
}

GlTexture uploadStatistics(const LightMaps& maps, const LayeredPacking& packing) {
  std::vector<Vec2f> texels(maps.irradiance.size());
  const bool known = maps.photons.size() == texels.size() && maps.relativeError.size() == texels.size();
  for (std::size_t i = 0; known && i < texels.size(); ++i) texels[i] = {maps.photons[i], maps.relativeError[i]};
  GlTexture texture =
      uploadSides(maps, packing, GL_RG32F, GL_RG, [&](const SideMaps& side) { return &texels[side.firstTexel]; });
  glTextureParameteri(texture.get(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.get(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

bool anyNeedsCellTable(const LightMaps& maps) {
  return std::any_of(maps.sides.begin(), maps.sides.end(), [&](const SideMaps& side) {
    return side.lit && !side.directions.empty() && needsCellTable(maps.charts[side.chart]);
  });
}

void uploadCellTable(const DirectionSet& set, const TextureLimits& limits, GpuMaps& gpu) {
  const CellTable table(set, limits.layers, gpu.hasMeans ? CellKind::mean : CellKind::direction);
  const int width = table.nodes() * table.tiles();
  gpu.cellTable = makeTexture({GL_TEXTURE_2D_ARRAY, GL_RGBA32F, 1, width, table.nodes(), table.layers()});
  glTextureSubImage3D(gpu.cellTable.get(), 0, 0, 0, 0, width, table.nodes(), table.layers(), GL_RGBA, GL_FLOAT,
                      table.texels().data());
  gpu.cellTableNodes = table.nodes();
  gpu.cellTableLayers = table.layers();
  gpu.textureBytes += table.texels().size() * sizeof(LobeTexel);
}

float largestValue(const std::vector<Rgb>& values) {
  float largest = 0;
  for (const Rgb& v : values) largest = std::max(largest, maxComponent(v));
  return largest;
}

template <class T>
GlBuffer storageBuffer(const std::vector<T>& values) {
  GLint64 limit = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  if (values.size() * sizeof(T) > static_cast<std::uint64_t>(limit)) {
    throw Error(ExitCode::outOfResource,
                "the lists of light directions are larger than OpenGL allows; bake with fewer --directions");
  }
  return makeBuffer(std::span<const T>(values));
}

}  // namespace

TextureLimits textureLimits() {
  TextureLimits limits;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limits.size);
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &limits.layers);
  return limits;
}

GpuMaps uploadMaps(const MapSource& source, LightMapFormat format) {
  const LightMaps& maps = source.maps;
  const DirectionSet set(maps.directionCount, maps.directionFilter);
  const TextureLimits limits = textureLimits();
  const MapTables tables =
      layOutMaps(maps, set, limits, source.directional != nullptr ? source.directional->texels() : maps.directional.size());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  GpuMaps gpu;
  if (source.directional != nullptr) {
    gpu.directional = streamDirectional(source, tables, format);
    gpu.mapUnit = static_cast<float>(source.directional->scale());
  } else {
    const float scale = format == LightMapFormat::float32 ? 1.f : halfScale(largestValue(maps.directional));
    gpu.directional = uploadDirectional(maps, tables, format, scale);
    gpu.mapUnit = 1.f / scale;
  }
  gpu.places = tables.directional.places;
  gpu.irradiance = uploadIrradiance(maps, tables.irradiance);
  gpu.statistics = uploadStatistics(maps, tables.irradiance);
  gpu.hasMeans = maps.hasMeans();
  gpu.meanReach = meanReach(maps.directionCount, maps.directionFilter);
  gpu.means =
      gpu.hasMeans ? uploadMeans(maps, tables, set) : makeTexture({GL_TEXTURE_2D_ARRAY, GL_RGB10_A2, 1, 1, 1, 1});
  gpu.lightMapBytes = tables.directional.texels() * (bytesPerTexel(format) + (gpu.hasMeans ? kMeanBytes : 0));
  gpu.textureBytes = gpu.lightMapBytes + tables.irradiance.texels() * kEvenBytesPerTexel;
  if (anyNeedsCellTable(maps)) {
    uploadCellTable(set, limits, gpu);
  } else {
    gpu.cellTable = makeTexture({GL_TEXTURE_2D_ARRAY, GL_RGBA32F, 1, 1, 1, 1});
  }
  gpu.sides = storageBuffer(tables.sides);
  gpu.cells = storageBuffer(tables.cells);
  gpu.directions = storageBuffer(tables.directions);
  gpu.memberBits = storageBuffer(tables.memberBits);
  gpu.layersPerStrip = tables.layersPerStrip;
  gpu.wordsPerSide = tables.wordsPerSide;
  gpu.cellSharpness = lightSharpness(maps);
  return gpu;
}

}  // namespace lucarne
