#include "tracer/scene/gltf_materials.h"

#include <algorithm>

#include "base/math.h"

namespace lucarne {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Reads one material; what many materials may share is collected in `clamped`.
class MaterialReader {
 public:
  MaterialReader(const GltfSource& source, std::uint32_t index)
      : json_(source.list("materials")[index]),
        place_(source.place().in("materials", index)),
        textures_(source.list("textures").size()) {}

  Material read();
  UvSlots slots() const { return slots_; }
  bool clamped() const { return clamped_; }
  bool thirdUvSet() const { return thirdUvSet_; }

 private:
  void readMetallicRoughness();
  void readEmission();
  void readSpecular();
  void readSpecularGlossiness(const Json& gloss, const Place& place);
  TextureUse textureUse(const Json& parent, const char* key, const Place& place);
  std::uint8_t slotOf(std::uint64_t set);
  double unitNumber(const Json& object, const char* key, double fallback, const Place& place);
  double inUnit(double value);
  Rgb color(const std::array<double, 3>& c, const Place& place) const;

  const Json& json_;
  Place place_;
  std::size_t textures_;
  Material material_;
  UvSlots slots_{0, 1};
  int otherSet_ = -1;  // the set other than 0 that slot 1 holds
  bool clamped_ = false, thirdUvSet_ = false;
};

Material MaterialReader::read() {
  material_.name = textOf(json_, "name", "", place_);
  material_.doubleSided = flagOf(json_, "doubleSided", false, place_);
  readMetallicRoughness();
  const Json* gloss = findExtension(json_, "KHR_materials_pbrSpecularGlossiness", place_);
  if (gloss != nullptr) {
    readSpecularGlossiness(*gloss, place_.in("KHR_materials_pbrSpecularGlossiness"));
  } else {
    readSpecular();
  }
  readEmission();
  return material_;
}

void MaterialReader::readMetallicRoughness() {
  const Json* pbr = findObject(json_, "pbrMetallicRoughness", place_);
  if (pbr == nullptr) return;
  const Place place = place_.in("pbrMetallicRoughness");
  const auto c = numbersOf<4>(*pbr, "baseColorFactor", {1, 1, 1, 1}, place);
  material_.baseColor = Rgb(Rgbd{inUnit(c[0]), inUnit(c[1]), inUnit(c[2])});
  material_.baseColorTexture = textureUse(*pbr, "baseColorTexture", place);
  material_.metallic = static_cast<float>(unitNumber(*pbr, "metallicFactor", 1, place));
  material_.roughness = static_cast<float>(unitNumber(*pbr, "roughnessFactor", 1, place));
  material_.metallicRoughnessTexture = textureUse(*pbr, "metallicRoughnessTexture", place);
}

void MaterialReader::readEmission() {
  auto factor = numbersOf<3>(json_, "emissiveFactor", {0, 0, 0}, place_);
  const Json* strong = findExtension(json_, "KHR_materials_emissive_strength", place_);
  const double strength =
      strong == nullptr ? 1 : numberOf(*strong, "emissiveStrength", 1, place_.in("KHR_materials_emissive_strength"));
  for (double& f : factor) f *= strength;
  if (strength < 0) place_.in("emissiveStrength").fail("is negative");
  material_.emissive = color(factor, place_.in("emissiveFactor"));
  material_.emissiveTexture = textureUse(json_, "emissiveTexture", place_);
}

void MaterialReader::readSpecular() {
  const Json* specular = findExtension(json_, "KHR_materials_specular", place_);
  if (specular != nullptr) {
    const Place place = place_.in("KHR_materials_specular");
    material_.specular = static_cast<float>(unitNumber(*specular, "specularFactor", 1, place));
    material_.specularColor =
        color(numbersOf<3>(*specular, "specularColorFactor", {1, 1, 1}, place), place.in("specularColorFactor"));
  }
  const Json* refraction = findExtension(json_, "KHR_materials_ior", place_);
  if (refraction == nullptr) return;
  const double ior = numberOf(*refraction, "ior", 1.5, place_.in("KHR_materials_ior"));
  // 0 stands for an infinite index (full reflection); nothing else below 1 exists.
  const bool valid = ior == 0 || (ior >= 1 && ior <= 1e6);
  clamped_ |= !valid;
  material_.ior = static_cast<float>(valid ? ior : std::clamp(ior, 1.0, 1e6));
}

/// Diffuse colour over a dielectric of the named reflectance at normal incidence: with ior 1.5 that is 0.04 ·
/// specularColor. A texture of the reflectance is not read, and then the usual 0.04 is a better guess than the factor
/// alone.
void MaterialReader::readSpecularGlossiness(const Json& gloss, const Place& place) {
  const auto diffuse = numbersOf<4>(gloss, "diffuseFactor", {1, 1, 1, 1}, place);
  material_.baseColor = Rgb(Rgbd{inUnit(diffuse[0]), inUnit(diffuse[1]), inUnit(diffuse[2])});
  material_.baseColorTexture = textureUse(gloss, "diffuseTexture", place);
  material_.metallic = 0;
  material_.roughness = static_cast<float>(1 - unitNumber(gloss, "glossinessFactor", 1, place));
  material_.metallicRoughnessTexture = {};
  if (findMember(gloss, "specularGlossinessTexture") != nullptr) return;
  const auto specular = numbersOf<3>(gloss, "specularFactor", {1, 1, 1}, place);
  material_.specularColor = Rgb(Rgbd{inUnit(specular[0]), inUnit(specular[1]), inUnit(specular[2])} / 0.04);
}

TextureUse MaterialReader::textureUse(const Json& parent, const char* key, const Place& place) {
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
    const auto offset = numbersOf<2>(*transform, "offset", {0, 0}, at);
    const auto scale = numbersOf<2>(*transform, "scale", {1, 1}, at);
    const double turn = numberOf(*transform, "rotation", 0, at) / kPi;
    const double c = cosPi(turn), s = sinPi(turn);
    // offset · rotation · scale; the rotation is counter-clockwise as seen, and v points down.
    const std::array<double, 6> m = {c * scale[0], s * scale[1], -s * scale[0], c * scale[1], offset[0], offset[1]};
    if (std::any_of(m.begin(), m.end(), [](double x) { return !(std::fabs(x) < 1e30); })) at.fail("is too large");
    const auto row = [&](std::size_t i) { return Vec2f{static_cast<float>(m[i]), static_cast<float>(m[i + 1])}; };
    use.rowU = row(0);
    use.rowV = row(2);
    use.offset = row(4);
  }
  use.uvSet = slotOf(set);
  return use;
}

std::uint8_t MaterialReader::slotOf(std::uint64_t set) {
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

double MaterialReader::inUnit(double value) {
  clamped_ |= value < 0 || value > 1;
  return std::clamp(value, 0.0, 1.0);
}

double MaterialReader::unitNumber(const Json& object, const char* key, double fallback, const Place& place) {
  return inUnit(numberOf(object, key, fallback, place));
}

Rgb MaterialReader::color(const std::array<double, 3>& c, const Place& place) const {
  for (const double x : c) {
    if (x < 0) place.fail("is negative");
    if (!(x <= 1e30)) place.fail("is too large");
  }
  return Rgb(Rgbd{c[0], c[1], c[2]});
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

/// Textures without an image in the file that a material uses: white.
void listMissingImages(const GltfMaterials& all, std::vector<std::string>& leftOut) {
  std::size_t missing = 0;
  for (const Material& m : all.materials) {
    for (const TextureUse* use : {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.emissiveTexture}) {
      missing += *use && all.textures[use->texture].image == kNone;
    }
  }
  if (missing > 0) leftOut.push_back("textures without a PNG or JPEG image: white stands in");
}

}  // namespace

GltfMaterials readMaterials(const GltfSource& source, std::vector<std::string>& leftOut) {
  GltfMaterials all;
  bool clamped = false;
  for (std::uint32_t i = 0; i < source.list("textures").size(); ++i) all.textures.push_back(readTexture(source, i));
  for (std::uint32_t i = 0; i < source.list("materials").size(); ++i) {
    MaterialReader reader(source, i);
    all.materials.push_back(reader.read());
    all.uvSlots.push_back(reader.slots());
    clamped |= reader.clamped();
    if (reader.thirdUvSet()) {
      leftOut.push_back("third set of texture coordinates of material " + std::to_string(i) +
                        ": its second one is used");
    }
  }
  all.materials.emplace_back().name = "default";
  all.uvSlots.push_back({0, 1});
  if (clamped) leftOut.push_back("material factors outside their range: brought into it");
  listMissingImages(all, leftOut);
  return all;
}

}  // namespace lucarne
