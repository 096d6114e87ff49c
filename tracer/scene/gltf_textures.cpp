#include "tracer/scene/gltf_textures.h"

#include <algorithm>

#include "base/math.h"

namespace lucarne {
namespace {


/// KHR_texture_transform, but for its texCoord.
void readTransform(const Json& transform, const Place& place, TextureUse& use) {
  const auto offset = numbersOf<2>(transform, "offset", {0, 0}, place);
  const auto scale = numbersOf<2>(transform, "scale", {1, 1}, place);
  const double turn = numberOf(transform, "rotation", 0, place) / kPiD;
  const double c = cosPi(turn), s = sinPi(turn);
  // offset · rotation · scale; the rotation is counter-clockwise as seen, and v points down.
  const std::array<double, 6> m = {c * scale[0], s * scale[1], -s * scale[0], c * scale[1], offset[0], offset[1]};
  if (std::any_of(m.begin(), m.end(), [](double x) { return !(std::fabs(x) < 1e30); })) place.fail("is too large");
  const auto row = [&](std::size_t i) { return Vec2f{static_cast<float>(m[i]), static_cast<float>(m[i + 1])}; };
  use.rowU = row(0);
  use.rowV = row(2);
  use.offset = row(4);
}

Wrap wrapOf(const Json& sampler, const char* key, const Place& place) {
  switch (countOf(sampler, key, 10497, place)) {
    case 10497:
      return Wrap::repeat;
    case 33071:
      return Wrap::clampToEdge;
    case 33648:
      return Wrap::mirroredRepeat;
    default:
      place.in(key).fail("is none of 10497, 33071 and 33648");
  }
}

}  // namespace

Texture readTexture(const GltfSource& source, std::uint32_t index) {
  const Json& json = source.list("textures")[index];
  const Place place = source.place().in("textures", index);
  Texture texture;
  const std::uint32_t image = indexOf(json, "source", kNone, place);
  if (image < source.list("images").size()) texture.image = image;
  const Json& samplers = source.list("samplers");
  const std::uint32_t s = indexOf(json, "sampler", samplers.size(), place);
  if (s == kNone) return texture;
  const Place at = source.place().in("samplers", s);
  texture.wrapS = wrapOf(samplers[s], "wrapS", at);
  texture.wrapT = wrapOf(samplers[s], "wrapT", at);
  texture.nearest = countOf(samplers[s], "magFilter", 9729, at) == 9728;
  return texture;
}

TextureUse TextureUseReader::read(const Json& parent, const char* key, const Place& place) {
  TextureUse use;
  const Json* info = findObject(parent, key, place);
  if (info == nullptr) return use;
  const Place where = place.in(key);
  use.texture = requiredIndex(*info, "index", textures_, where);
  std::uint64_t set = countOf(*info, "texCoord", 0, where);
  const Json* transform = findExtension(*info, "KHR_texture_transform", where);
  if (transform != nullptr) {
    const Place at = where.in("KHR_texture_transform");
    set = countOf(*transform, "texCoord", set, at);
    readTransform(*transform, at, use);
  }
  use.uvSet = slotOf(set);
  return use;
}

std::uint8_t TextureUseReader::slotOf(std::uint64_t set) {
  if (set == 0) return 0;
  const int known = static_cast<int>(std::min<std::uint64_t>(set, 1u << 30));
  if (otherSet_ >= 0 && otherSet_ != known) {
    thirdUvSet_ = true;
    return 1;
  }
  otherSet_ = known;
  slots_[1] = static_cast<std::uint32_t>(known);
  return 1;
}

}  // namespace lucarne
