// Damaged, altered and made-up .dlm folders: every one is refused by an InputError that names the file at fault.
#include <fstream>

#include "base/files.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"
#include "tests/dlm/dlm_file_fixture.h"

namespace lucarne::dlm_file_hostile_test {
namespace {

using nlohmann::json;
using test::smallBakedScene;

constexpr const char* kFiles[] = {"manifest.json", "scene.glb", "irradiance.exr", "directional.exr"};

class HostileDlm : public ::testing::Test {
 protected:
  HostileDlm() { smallBakedScene().write(path_, {MapFormat::float32, ExrCompression::none}); }

  void expectRefused(const std::string& fileAtFault) {
    const std::string text = errorOf(ExitCode::badInput, [&] { readDlm(path_); });
    EXPECT_NE(text.find(fileAtFault), std::string::npos) << text;
  }

  json manifest() const { return readManifest(path_); }
  void setManifest(const json& manifest) { writeFileAtomically(path_ / "manifest.json", manifest.dump()); }
  /// The files are no longer checked against their hashes, so that their contents must hold up.
  void breakSeal() {
    json open = manifest();
    open.erase("files");
    setManifest(open);
  }
  template <class Spoil>
  void spoilLayers(const std::string& name, Spoil spoil) {
    std::vector<ExrLayer> layers = readExr(path_ / name);
    spoil(layers);
    writeExr(path_ / name, layers, ExrCompression::none);
  }

  TempFolder folder_;
  std::filesystem::path path_ = folder_ / "room.dlm";
};

TEST_F(HostileDlm, MissingFilesAreNamed) {
  for (const char* name : kFiles) {
    const std::filesystem::path aside = folder_ / "aside";
    std::filesystem::rename(path_ / name, aside);
    expectRefused(name);
    std::filesystem::rename(aside, path_ / name);
  }
  EXPECT_NO_THROW(readDlm(path_));
}

TEST_F(HostileDlm, WhatIsNoFolderOfOursIsNamed) {
  errorOf(ExitCode::badInput, [&] { readDlm(folder_ / "nothing.dlm"); });
  errorOf(ExitCode::badInput, [&] { readDlm(path_ / "scene.glb"); });
  errorOf(ExitCode::badInput, [&] { readDlm(folder_.path()); });
}

TEST_F(HostileDlm, TruncatedAndLengthenedFilesAreNamed) {
  for (const char* name : kFiles) {
    const std::vector<std::uint8_t> whole = readFile(path_ / name);
    for (const std::size_t size : {std::size_t{0}, whole.size() / 2, whole.size() - 2}) {
      writeFileAtomically(path_ / name, std::span(whole).first(size));
      expectRefused(name);
    }
    std::vector<std::uint8_t> longer = whole;
    longer.insert(longer.end(), 10, '{');
    writeFileAtomically(path_ / name, longer);
    expectRefused(name);
    writeFileAtomically(path_ / name, whole);
  }
  EXPECT_NO_THROW(readDlm(path_));
}

TEST_F(HostileDlm, OneAlteredByteOfAnImageOrSceneIsFound) {
  for (const char* name : {"scene.glb", "irradiance.exr", "directional.exr"}) {
    std::vector<std::uint8_t> bytes = readFile(path_ / name);
    bytes[bytes.size() - 3] ^= 1;
    writeFileAtomically(path_ / name, bytes);
    expectRefused(name);
    bytes[bytes.size() - 3] ^= 1;
    writeFileAtomically(path_ / name, bytes);
  }
}

TEST_F(HostileDlm, TheManifestCutAnywhereIsRefused) {
  const std::vector<std::uint8_t> whole = readFile(path_ / "manifest.json");
  for (std::size_t size = 0; size + 2 < whole.size(); size += 31) {
    writeFileAtomically(path_ / "manifest.json", std::span(whole).first(size));
    expectRefused("manifest.json");
  }
}

TEST_F(HostileDlm, ImagesCutAnywhereAreRefusedWithoutTheirHashes) {
  breakSeal();
  for (const char* name : {"irradiance.exr", "directional.exr"}) {
    const std::vector<std::uint8_t> whole = readFile(path_ / name);
    for (std::size_t size = 0; size < whole.size(); size += 211) {
      writeFileAtomically(path_ / name, std::span(whole).first(size));
      expectRefused(name);
    }
    writeFileAtomically(path_ / name, whole);
  }
}

TEST_F(HostileDlm, EditedNumbersOfTheManifestAreRefused) {
  const json huge = 1e300, tooLarge = std::uint64_t{1} << 63;
  const std::pair<const char*, json> edits[] = {
      {"/format", "other"},
      {"/version", 2},
      {"/version", -1},
      {"/version", nullptr},
      {"/directions/count", 0},
      {"/directions/count", 13},
      {"/directions/count", 70000},
      {"/directions/list/3", {0, 0, 1}},
      {"/directions/list/3", "x"},
      {"/directions", nullptr},
      {"/charts", json::array()},
      {"/charts/material/0", -1},
      {"/charts/material/0", 1},
      {"/charts/material/1", 5},
      {"/charts/smooth/0", 2},
      {"/charts/normal/1", 0},
      {"/charts/normal/1", huge},
      {"/charts/normal/1", "up"},
      {"/charts/texel_size/0", 0},
      {"/charts/texel_size/0", nullptr},
      {"/charts/rectangle/0", 13},  // out of the page
      {"/charts/rectangle/0", 4},   // over the next
      {"/charts/rectangle/0", 2},   // away from the scene's coordinates
      {"/charts/rectangle/2", 0},   // empty
      {"/charts/rectangle/2", 3},   // smaller than the scene's coordinates
      {"/charts/rectangle/2", tooLarge},
      {"/charts/rectangle", json::array({1, 2, 3})},
      {"/charts/front/0", 1},
      {"/charts/front/0", 77},
      {"/charts/front/0", -1},
      {"/charts/back/1", 0},
      {"/sides/chart/0", 1},
      {"/sides/chart/0", 3},
      {"/sides/back/0", 1},
      {"/sides/lit/0", 0},  // has stored directions
      {"/sides/members/0", 4},
      {"/sides/members/0", 15},
      {"/sides/members/3", 1},
      {"/sides/psi/0", 14},
      {"/sides/psi/0", -1},
      {"/sides/psi/0", 5},  // no longer ascending
      {"/sides/psi/0", 0.5},
      {"/sides/place/0", -2},
      {"/sides/place/0", 1 << 30},
      {"/sides/place/0", tooLarge},
      {"/irradiance/size/0", 15},
      {"/irradiance/size/0", 17},
      {"/irradiance/size", json::array({1 << 20, 1 << 20})},
      {"/irradiance/layers/0", "nose"},
      {"/irradiance/layers", 3},
      {"/directional/size/0", 4},
      {"/directional/size/1", 1 << 20},
      {"/directional/size", json::array({0, 8})},
      {"/directional/layers/0", "psi 007 page 0"},
      {"/directional/layers/0", 1},
      {"/directional/scale", 3},
      {"/directional/scale", 0},
      {"/directional/scale", -2},
      {"/directional", 1},
      {"/directional", nullptr},  // but maps are stored
      {"/files/scene.glb/bytes", 1},
      {"/files/scene.glb/xxh3_128", "00"},
  };
  const json original = manifest();
  for (const auto& [place, value] : edits) {
    SCOPED_TRACE(std::string(place) + " = " + value.dump());
    json edited = original;
    edited[json::json_pointer(place)] = value;
    setManifest(edited);
    expectRefused("room.dlm");
  }
  setManifest(original);
  EXPECT_NO_THROW(readDlm(path_));
}

TEST_F(HostileDlm, MissingMembersOfTheManifestAreRefused) {
  const json original = manifest();
  const auto expectNeeded = [&](const json::json_pointer& place) {
    SCOPED_TRACE(place.to_string());
    json edited = original;
    edited[place.parent_pointer()].erase(place.back());
    setManifest(edited);
    expectRefused("manifest.json");
  };
  for (const char* key : {"format", "version", "directions", "charts", "sides", "irradiance", "directional"}) {
    expectNeeded(json::json_pointer(std::string("/") + key));
  }
  for (const char* section : {"charts", "sides"}) {
    for (const auto& [key, value] : original[section].items()) {
      if (key != "count") expectNeeded(json::json_pointer("/" + std::string(section) + "/" + key));
    }
  }
}

TEST_F(HostileDlm, MapsOnTopOfEachOtherAreRefused) {
  json edited = manifest();
  edited["sides"]["place"][2] = edited["sides"]["place"][0];
  setManifest(edited);
  expectRefused("manifest.json");
}

TEST_F(HostileDlm, LayersOfOtherSizesAreRefused) {
  breakSeal();
  for (const char* name : {"irradiance.exr", "directional.exr"}) {
    spoilLayers(name, [](std::vector<ExrLayer>& layers) {
      for (ExrLayer& layer : layers) std::swap(layer.width, layer.height);
    });
    if (readExr(path_ / name)[0].width != readExr(path_ / name)[0].height) expectRefused(name);
    spoilLayers(name, [](std::vector<ExrLayer>& layers) {
      for (ExrLayer& layer : layers) std::swap(layer.width, layer.height);
    });
  }
}

TEST_F(HostileDlm, MissingLayersAndChannelsAreRefused) {
  breakSeal();
  for (const char* name : {"irradiance.exr", "directional.exr"}) {
    const std::vector<std::uint8_t> whole = readFile(path_ / name);
    const std::size_t count = readExr(path_ / name).size();
    for (std::size_t i = 0; i < count; ++i) {
      spoilLayers(
          name, [&](std::vector<ExrLayer>& layers) { layers.erase(layers.begin() + static_cast<std::ptrdiff_t>(i)); });
      expectRefused(name);
      writeFileAtomically(path_ / name, whole);
      spoilLayers(name, [&](std::vector<ExrLayer>& layers) { layers[i].channels[0].name = "Z"; });
      expectRefused(name);
      writeFileAtomically(path_ / name, whole);
    }
  }
}

TEST_F(HostileDlm, NumbersThatAreNotFiniteAreRefused) {
  breakSeal();
  for (const float bad : {std::nanf(""), HUGE_VALF, -HUGE_VALF}) {
    for (const char* name : {"irradiance.exr", "directional.exr"}) {
      const std::vector<std::uint8_t> whole = readFile(path_ / name);
      spoilLayers(name, [&](std::vector<ExrLayer>& layers) {
        std::vector<float>& values = layers.back().channels.back().floats;
        std::fill(values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4), values.end(), bad);
      });
      expectRefused(name);
      writeFileAtomically(path_ / name, whole);
    }
  }
}

TEST_F(HostileDlm, AnotherScaleThanTheImagesIsRefused) {
  smallBakedScene().write(path_);  // half, scaled
  json edited = manifest();
  edited["directional"]["scale"] = edited["directional"]["scale"].get<double>() * 2;
  setManifest(edited);
  expectRefused("directional.exr");
}

TEST_F(HostileDlm, DeepNestingIsRefusedAndNotFollowed) {
  for (const char* bracket : {"[", "{\"a\":"}) {
    std::string text = "{\"format\": \"lucarne-dlm\", \"deep\": ";
    for (int i = 0; i < 200000; ++i) text += bracket;
    writeFileAtomically(path_ / "manifest.json", text);
    expectRefused("manifest.json");
  }
}

TEST_F(HostileDlm, RandomlyAlteredManifestsAreReadOrRefused) {
  const std::vector<std::uint8_t> whole = readFile(path_ / "manifest.json");
  std::mt19937 rng(5);
  const std::string alphabet = "0123456789-+.eE,:[]{}\"\\ truefalsn\xff";
  int refused = 0;
  for (int i = 0; i < 600; ++i) {
    std::vector<std::uint8_t> bytes = whole;
    const int edits = 1 + static_cast<int>(rng() % 3);
    for (int k = 0; k < edits; ++k)
      bytes[rng() % bytes.size()] = static_cast<std::uint8_t>(alphabet[rng() % alphabet.size()]);
    std::ofstream(path_ / "manifest.json", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    try {
      readDlm(path_);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 250);
}

}  // namespace
}  // namespace lucarne::dlm_file_hostile_test
