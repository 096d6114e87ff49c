// Every way to spoil a part or a merge that we could think of, and what the program says to it.
#include "tests/cli/merge_fixture.h"

namespace lucarne::merge_spoiled_test {
namespace {

namespace fs = std::filesystem;

class SpoiledMerge : public test::MergeTest {};

void replace(std::string& bytes, const std::string& what, const std::string& with) {
  const std::size_t at = bytes.find(what);
  ASSERT_NE(at, std::string::npos) << what;
  bytes.replace(at, what.size(), with);
}

/// The text of the header, after its length of 4 bytes.
constexpr std::size_t kTextAt = 8 + sizeof("lucarne") + sizeof("string") + 4;

std::uint32_t textLength(const std::string& bytes) {
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + kTextAt - 4, sizeof(length));
  return length;
}

void setText(std::string& bytes, const std::string& text) {
  bytes.replace(kTextAt, textLength(bytes), text);
  const auto length = static_cast<std::uint32_t>(text.size());
  std::memcpy(bytes.data() + kTextAt - 4, &length, sizeof(length));
}

void replaceInText(std::string& bytes, const std::string& what, const std::string& with) {
  std::string text = bytes.substr(kTextAt, textLength(bytes));
  replace(text, what, with);
  setText(bytes, text);
}

using Spoil = void (*)(std::string&);

template <std::size_t at>
void flip(std::string& bytes) {
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
}
template <std::size_t fromEnd>
void flipBack(std::string& bytes) {
  char& byte = bytes[bytes.size() - fromEnd];
  byte = static_cast<char>(byte ^ 1);
}
template <std::size_t size>
void cutTo(std::string& bytes) {
  bytes.resize(size);
}
template <std::size_t count>
void cutOff(std::string& bytes) {
  bytes.resize(bytes.size() - count);
}

struct Damage {
  const char* what;
  Spoil spoil;
  const char* words;
};

// A row of statistics or of light has 49164 bytes, one of the scene 8204; the seal 24.
constexpr Damage kDamages[] = {
    {"empty", cutTo<0>, "x.part"},
    {"cut within the first word", cutTo<3>, "cut short"},
    {"cut within the header", cutTo<500>, "cut short: it ends within its header"},
    {"cut within the description of the image", cutTo<2700>, "cut short"},
    {"cut in the scene", cutTo<7000>, "cut short: it has 7000 "},
    {"cut in the tallies", cutOff<20'000>, "cut short"},
    {"cut before the seal", cutOff<24>, "cut short"},
    {"one byte short", cutOff<1>, "cut short"},
    {"one byte too long", [](std::string& b) { b += 'x'; }, "1 bytes too many"},
    {"itself behind itself", [](std::string& b) { b += b; }, "bytes too many"},
    {"first byte flipped", flip<0>, "not a part"},
    {"name of the attribute flipped", flip<9>, "not a part"},
    {"brace of the header flipped", flip<27>, "JSON"},
    {"key of the header flipped", [](std::string& b) { replace(b, "scene_hash", "scene_hasi"); },
     "scene_hash is missing"},
    {"name in the header changed", [](std::string& b) { replace(b, "cornell_box.glb", "Cornell_box.glb"); }, "altered"},
    {"hash in the header changed", [](std::string& b) { b[b.find("content_hash") + 15] ^= 1; }, "x.part"},
    {"channel renamed", [](std::string& b) { replace(b, "r.hi", "R.hi"); }, "altered"},
    {"offset of the last row flipped", [](std::string& b) { b[b.find("scanlineimage", b.find("m2.lo")) + 15] ^= 1; },
     "altered"},
    {"scene flipped", [](std::string& b) { replace(b, "\"primitives\"", "\"Primitives\""); }, "altered"},
    {"row head of the statistics flipped", flipBack<24 + 49164 - 4>, "altered"},
    {"a count flipped", flipBack<24 + 49152 - 8192>, "altered"},
    {"a light tally flipped", flipBack<24 + 49164 + 49152 - 8192>, "altered"},
    {"padding flipped", flipBack<25>, "altered"},
    {"mark of the seal flipped", flipBack<24>, "altered"},
    {"hash of the seal flipped", flipBack<1>, "altered"},
    {"text", [](std::string& b) { b = "this is no part\n"; }, "not a part"},
    {"zeros", [](std::string& b) { b.assign(b.size(), '\0'); }, "not a part"},
    {"header of no text", [](std::string& b) { setText(b, ""); }, "not a part"},
    {"header of no object", [](std::string& b) { setText(b, "[]"); }, "must be an object"},
    {"header nested deeply", [](std::string& b) { setText(b, std::string(1'000'000, '[')); }, "nested"},
    {"header that claims to be long", [](std::string& b) { b[kTextAt - 1] = '\x7f'; }, "cut short"},
    {"another version", [](std::string& b) { replace(b, "\"version\":4", "\"version\":9"); },
     "version is one that this program does not know"},
    {"another kind of tallies", [](std::string& b) { replace(b, "\"name\":\"photons\"", "\"name\":\"moments\""); },
     "does not know"},
    {"a setting changed", [](std::string& b) { replace(b, "\"directions\":14", "\"directions\":15"); },
     "settings was altered"},
    {"huge light", [](std::string& b) { replaceInText(b, "\"light_entries\":", "\"light_entries\":9999999999999"); },
     "cut short"},
    {"huge texels", [](std::string& b) { replaceInText(b, "\"texels\":", "\"texels\":99999999999"); }, "cut short"},
    {"huge scene", [](std::string& b) { replaceInText(b, "\"scene_bytes\":", "\"scene_bytes\":99999999999"); },
     "cut short"},
    {"more than 64 bits of texels",
     [](std::string& b) { replaceInText(b, "\"texels\":", "\"texels\":99999999999999999999"); }, "texels must be"},
    {"photons in reverse", [](std::string& b) { replace(b, "[[1000,2000]]", "[[2000,1000]]"); },
     "ranges[0] must be a range"},
    {"other photons", [](std::string& b) { replace(b, "[[1000,2000]]", "[[1000,3000]]"); },
     "another number of photons"},
};

TEST_F(SpoiledMerge, EveryDamageIsNamedByAnyMergeInAnyOrder) {
  const std::string good = read("b.part");
  for (const Damage& d : kDamages) {
    SCOPED_TRACE(d.what);
    std::string bytes = good;
    d.spoil(bytes);
    ASSERT_NE(bytes, good);
    write("x.part", bytes);
    expectRefused("merge a.part x.part -o out.dlm", 4, {"x.part", d.words});
    expectRefused("merge x.part a.part -o out.part", 4, {"x.part", d.words});
    expectRefused("merge a.part x.part --verify", 4, {"x.part", d.words});
  }
}

TEST_F(SpoiledMerge, InfoNamesEveryDamage) {
  const std::string good = read("b.part");
  for (const Damage& d : kDamages) {
    SCOPED_TRACE(d.what);
    std::string bytes = good;
    d.spoil(bytes);
    write("x.part", bytes);
    expectRefused("info x.part", 3, {"x.part"});
  }
}

TEST_F(SpoiledMerge, PartsOfOtherSettingsAreRefusedWithTheFieldNamed) {
  const std::pair<const char*, const char*> rows[] = {{"--seed 1", "seed: 0 and 1"},
                                                      {"--directions 15", "directions: 14 and 15"},
                                                      {"--density 3", "texels_per_metre: 2.0 and 3.0"},
                                                      {"--texels 500k", "texel_budget: 1000000 and 500000"},
                                                      {"--light direct", "light: \"all\" and \"direct\""},
                                                      {"--light indirect", "light: \"all\" and \"indirect\""},
                                                      {"--kernel box", "kernel: \"adaptive\" and \"box\""},
                                                      {"--kernel-width 2", "kernel_width: 4.5 and 2.0"}};
  for (const auto& [option, words] : rows) {
    mustRun(std::string("bake") + test::kQuickScene + "--photons 2k --quiet -o x.part --part 2/2 " + option +
            (std::string(option).starts_with("--density") ? "" : " --density 2"));
    expectRefused("merge a.part x.part -o out.dlm", 4, {"a.part and x.part differ in " + std::string(words)});
    expectRefused("merge a.part x.part --verify", 4, {"a.part and x.part differ in " + std::string(words)});
  }
}

TEST_F(SpoiledMerge, PartsOfOtherScenesAreRefused) {
  const std::string rest = std::string(test::MergeTest::kTiny) + "-o x.part --part 2/2";
  mustRun("bake '" LUCARNE_SOURCE_DIR "/scenes/two_lamps.glb' --keep-all-directions" + rest);
  expectRefused("merge a.part x.part -o out.dlm", 4, {"a.part and x.part differ in scene: "});
  mustRun("bake '" LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb'" + rest);
  expectRefused("merge a.part x.part -o out.dlm", 4,
                {"a.part and x.part differ in keep_all_directions: true and false"});
}

TEST_F(SpoiledMerge, PartsOfOtherKernelsAreTakenWhenTheKernelIsGiven) {
  mustRun(std::string("bake") + test::kQuickScene + test::MergeTest::kTiny +
          "-o x.part --part 2/2 --kernel box --kernel-width 2");
  expectRefused("merge a.part x.part -o out.dlm", 4, {"differ in kernel: "});
  mustRun("merge a.part x.part -o one.dlm --kernel box --kernel-width 2 --quiet");
  mustRun("merge x.part a.part -o two.dlm --kernel box --kernel-width 2 --quiet");
  mustRun(std::string("bake") + test::kQuickScene + test::MergeTest::kTiny +
          "-o whole.dlm --kernel box --kernel-width 2");
  EXPECT_TRUE(same("one.dlm", "whole.dlm"));
  EXPECT_TRUE(same("two.dlm", "whole.dlm"));
}

TEST_F(SpoiledMerge, AKernelGivenByHalvesDoesNotDependOnTheOrder) {
  mustRun(std::string("bake") + test::kQuickScene + test::MergeTest::kTiny +
          "-o x.part --part 2/2 --kernel box --kernel-width 2");
  const int one = run("merge a.part x.part -o one.dlm --kernel box --quiet").code;
  const int two = run("merge x.part a.part -o two.dlm --kernel box --quiet").code;
  EXPECT_EQ(one, two);
  if (one == 0 && two == 0) {
    EXPECT_TRUE(same("one.dlm", "two.dlm")) << "kernel_width is that of whichever part comes first";
  }
}

TEST_F(SpoiledMerge, PhotonsAreNeverCountedTwice) {
  fs::create_directory(folder_ / "parts");
  fs::copy_file(folder_ / "a.part", folder_ / "parts" / "a.part");
  fs::create_symlink("a.part", folder_ / "link.part");
  fs::create_directory_symlink("parts", folder_ / "folder");
  bake("-o o.part --photon-range 999:1001");
  mustRun("merge a.part b.part -o all.part --quiet");
  const std::vector<std::pair<std::string, std::string>> rows = {
      {"a.part a.part", "a.part and a.part both hold photons 0..1k"},
      {"a.part b.part a.part", "a.part and a.part both hold photons 0..1k"},
      {"parts parts/a.part", "parts/a.part and parts/a.part both hold photons 0..1k"},
      {"parts/a.part parts b.part", "parts/a.part and parts/a.part both hold"},
      {"parts folder", "parts/a.part and folder/a.part both hold"},
      {"a.part link.part", "a.part and link.part both hold"},
      {"a.part parts", "a.part and parts/a.part both hold"},
      {"a.part o.part", "a.part and o.part both hold photons 999..1k"},
      {"a.part b.part o.part", "a.part and o.part both hold photons 999..1k"},
      {"all.part b.part", "all.part and b.part both hold photons 1k..2k"},
      {"b.part all.part", "b.part and all.part both hold photons 1k..2k"}};
  for (const auto& [inputs, words] : rows) {
    expectRefused("merge " + inputs + " -o out.dlm", 4, {words});
    expectRefused("merge " + inputs + " --verify", 4, {words});
  }
}

}  // namespace
}  // namespace lucarne::merge_spoiled_test
