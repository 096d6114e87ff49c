// One bake cut into pieces, baked in any way and merged in any order, is the bake of one machine: every file, every
// bit.
#include <algorithm>
#include <random>

#include "tests/cli/program.h"

namespace lucarne::shared_bake_test {
namespace {

constexpr std::uint64_t kPhotons = 120'000;

using test::kQuickScene;

class SharedBake : public test::ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    mustRun(std::string("bake") + kQuickScene + "-o whole.dlm --density 20 --threads 2 --quiet --photons " +
            std::to_string(kPhotons));
  }

  /// Cuts the photons at random, bakes each piece with 1 to 3 threads; returns the parts in random order.
  std::vector<std::string> bakePieces(std::mt19937& random, int pieces) {
    std::vector<std::uint64_t> cuts{0, kPhotons};
    for (int i = 1; i < pieces; ++i)
      cuts.push_back(std::uniform_int_distribution<std::uint64_t>(1, kPhotons - 1)(random));
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    std::vector<std::string> parts;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const std::string name = "piece" + std::to_string(i) + ".part";
      mustRun(std::string("bake") + kQuickScene + "-o " + name + " --density 20 --quiet --photons " +
              std::to_string(kPhotons) + " --threads " + std::to_string(1 + random() % 3) + " --photon-range " +
              std::to_string(cuts[i]) + ":" + std::to_string(cuts[i + 1]));
      parts.push_back(name);
    }
    std::shuffle(parts.begin(), parts.end(), random);
    return parts;
  }

  /// Merges random handfuls into parts until one is left, which becomes merged.dlm.
  void mergeTree(std::mt19937& random, std::vector<std::string> parts) {
    for (int node = 0; parts.size() > 3; ++node) {
      std::shuffle(parts.begin(), parts.end(), random);
      const std::size_t taken = 2 + random() % (parts.size() - 2);
      std::string inputs;
      for (std::size_t i = 0; i < taken; ++i) inputs += " " + parts[i];
      parts.erase(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(taken));
      parts.push_back("node" + std::to_string(node) + ".part");
      mustRun("merge --quiet -o " + parts.back() + inputs);
    }
    std::string inputs;
    for (const std::string& part : parts) inputs += " " + part;
    mustRun("merge --quiet --complete -o merged.dlm" + inputs);
  }
};

class SharedBakeTrees : public SharedBake, public testing::WithParamInterface<unsigned> {};

TEST_P(SharedBakeTrees, AnySplitAndAnyTreeOfMergesGiveEveryFileBitForBit) {
  std::mt19937 random(GetParam());
  mergeTree(random, bakePieces(random, 2 + static_cast<int>(random() % 9)));
  EXPECT_EQ(contentHash("merged.dlm"), contentHash("whole.dlm"));
  EXPECT_TRUE(same("merged.dlm", "whole.dlm"));
}
INSTANTIATE_TEST_SUITE_P(Seeds, SharedBakeTrees, testing::Range(1u, 7u));

TEST_F(SharedBake, AnyNumberOfEqualPartsGivesEveryFileBitForBit) {
  for (const int n : {1, 2, 3, 7}) {
    std::string inputs;
    for (int k = 1; k <= n; ++k) {
      const std::string name = "p" + std::to_string(n) + "-" + std::to_string(k) + ".part";
      mustRun(std::string("bake") + kQuickScene + "-o " + name + " --density 20 --quiet --photons " +
              std::to_string(kPhotons) + " --part " + std::to_string(k) + "/" + std::to_string(n));
      inputs += " " + name;
    }
    mustRun("merge --quiet -o merged.dlm" + inputs);
    EXPECT_TRUE(same("merged.dlm", "whole.dlm")) << n << " parts";
  }
}

TEST_F(SharedBake, ManyPartsTakeTheMemoryOfTwo) {
  if (test::isSanitized()) GTEST_SKIP() << "the address sanitizer keeps what was freed";
  mustRun(std::string("bake") + kQuickScene + "-o p0.part --density 60 --quiet --photons 400k --photon-range 0:1k");
  std::string list = "p0.part\n";
  for (int i = 1; i < 60; ++i) {
    const std::string name = "p" + std::to_string(i) + ".part";
    mustRun(std::string("bake") + kQuickScene + "-o " + name + " --density 60 --quiet --photons 400k --photon-range " +
            std::to_string(i) + "k:" + std::to_string(i + 1) + "k");
    list += name + "\n";
  }
  std::ofstream(folder_ / "list") << list;
  mustRun("merge p0.part p1.part -o two.part --quiet --report two.json");
  mustRun("merge @list -o all.part --quiet --report all.json");
  const auto peak = [this](const std::string& report) {
    return nlohmann::json::parse(test::slurp(folder_ / report))["peak_memory_bytes"].get<double>();
  };
  EXPECT_LT(peak("all.json"), 1.05 * peak("two.json") + (2 << 20));
  EXPECT_EQ(nlohmann::json::parse(test::slurp(folder_ / "all.json"))["parts"], 60);
}

TEST_F(SharedBake, OldTalliesGiveNewMapsWithoutTracing) {
  mustRun(std::string("bake") + kQuickScene + "-o whole.part --density 20 --quiet --photons " +
          std::to_string(kPhotons));
  mustRun(std::string("bake") + kQuickScene +
          "-o box.dlm --density 20 --kernel box --kernel-width 2 --format float --quiet --photons " +
          std::to_string(kPhotons));
  mustRun("merge whole.part -o again.dlm --kernel box --kernel-width 2 --format float --quiet");
  EXPECT_TRUE(same("again.dlm", "box.dlm"));
}

}  // namespace
}  // namespace lucarne::shared_bake_test
