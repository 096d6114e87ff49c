// The hash of what light touches: it changes with everything that a photon could notice, and with nothing else.
#include "tracer/scene/light_hash.h"

#include <gtest/gtest.h>

#include "tests/support/changed_scene.h"
#include "tests/support/scene_builder.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne::light_hash_test {
namespace {

Scene read(const std::function<void(Json&)>& change) { return readGlb(test::changedCornellBox(change), "box"); }

Hash128 hashOf(const std::function<void(Json&)>& change) { return lightHash(read(change)); }

TEST(LightHash, DoesNotNoticeCamerasNamesExtrasAndUnusedMaterials) {
  const Hash128 before = hashOf([](Json&) {});
  EXPECT_EQ(hashOf([](Json& j) { test::changeWhatLightDoesNotTouch(j); }), before);
  EXPECT_EQ(hashOf([](Json& j) { j["materials"].push_back(j["materials"][2]); }), before);
  EXPECT_EQ(hashOf([](Json& j) { j["asset"]["generator"] = "another exporter"; }), before);
}

TEST(LightHash, NoticesWhatTheFileSaysOfLight) {
  const Hash128 before = hashOf([](Json&) {});
  const std::function<void(Json&)> changes[] = {
      [](Json& j) {
        j["nodes"][6]["translation"] = {0.001, 0, 0};
      },
      [](Json& j) { j["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][1] = 0.7; },
      [](Json& j) { j["materials"][0]["doubleSided"] = true; },
      [](Json& j) { j["materials"][1]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 17001; },
      [](Json& j) { j["meshes"][4]["primitives"][0]["material"] = 3; },
      [](Json& j) {
        j["nodes"][0]["extras"] = {{"lucarne.texels_per_metre", 64}};
      },
      [](Json& j) { j["scenes"][0]["nodes"].erase(7); }};
  for (std::size_t i = 0; i < std::size(changes); ++i) EXPECT_NE(hashOf(changes[i]), before) << "change " << i;
}

TEST(LightHash, NoticesEveryPropertyOfAMaterial) {
  const Material plain;
  const Scene scene;
  const Hash128 before = lightHash(scene, plain);
  const std::function<void(Material&)> changes[] = {
      [](Material& m) { m.baseColor.y = 0.5f; },     [](Material& m) { m.alphaMode = AlphaMode::mask; },
      [](Material& m) { m.alpha = 0.5f; },           [](Material& m) { m.alphaCutoff = 0.25f; },
      [](Material& m) { m.unlit = true; },           [](Material& m) { m.metallic = 0; },
      [](Material& m) { m.roughness = 0; },          [](Material& m) { m.emissive.z = 1; },
      [](Material& m) { m.normalScale = 2; },        [](Material& m) { m.specular = 0; },
      [](Material& m) { m.specularColor.x = 0; },    [](Material& m) { m.ior = 1.4f; },
      [](Material& m) { m.transmission = 1; },       [](Material& m) { m.solid = true; },
      [](Material& m) { m.attenuationColor.x = 0; }, [](Material& m) { m.attenuationDistance = 1; },
      [](Material& m) { m.doubleSided = true; }};
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    Material changed = plain;
    changes[i](changed);
    EXPECT_NE(lightHash(scene, changed), before) << "property " << i;
  }
  Material named = plain;
  named.name = "other";
  EXPECT_EQ(lightHash(scene, named), before);
}

TEST(LightHash, NoticesPixelsAndPlaceOfEveryTextureAndNotItsNumber) {
  Scene scene;
  scene.images = {Image{1, 1, {1, 2, 3, 4}}, Image{1, 1, {1, 2, 3, 5}}, Image{1, 1, {1, 2, 3, 4}}};
  scene.textures = {Texture{0}, Texture{1}, Texture{2}, Texture{0, Wrap::clampToEdge}};
  constexpr TextureUse Material::*kUses[] = {&Material::baseColorTexture,   &Material::metallicRoughnessTexture,
                                             &Material::emissiveTexture,    &Material::normalTexture,
                                             &Material::specularTexture,    &Material::specularColorTexture,
                                             &Material::transmissionTexture};
  for (const auto use : kUses) {
    const auto hashWith = [&](std::uint32_t texture, float shift) {
      Material m;
      (m.*use).texture = texture;
      (m.*use).offset.x = shift;
      return lightHash(scene, m);
    };
    EXPECT_NE(hashWith(0, 0), lightHash(scene, Material{}));
    EXPECT_NE(hashWith(0, 0), hashWith(1, 0)) << "one byte of the picture";
    EXPECT_EQ(hashWith(0, 0), hashWith(2, 0)) << "the same picture twice";
    EXPECT_NE(hashWith(0, 0), hashWith(3, 0)) << "wrapping";
    EXPECT_NE(hashWith(0, 0), hashWith(0, 0.5f));
  }
}

TEST(LightHash, NoticesEveryPropertyOfALightButItsName) {
  const Light plain;
  const std::function<void(Light&)> changes[] = {
      [](Light& l) { l.kind = LightKind::spot; }, [](Light& l) { l.intensity.x = 2; },
      [](Light& l) { l.position.z = 1; },         [](Light& l) { l.direction = {0, -1, 0}; },
      [](Light& l) { l.cosInner = 0.9; },         [](Light& l) { l.cosOuter = 0.1; }};
  for (const auto& change : changes) {
    Light changed = plain;
    change(changed);
    EXPECT_NE(lightHash(changed), lightHash(plain));
  }
  Light named = plain;
  named.name = "sun";
  EXPECT_EQ(lightHash(named), lightHash(plain));
}

}  // namespace
}  // namespace lucarne::light_hash_test
