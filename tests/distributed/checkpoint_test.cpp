// States of a bake on disk: two are kept, the newest whole one wins, and nothing of anybody else's is touched.
#include "distributed/checkpoint.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"
#include "tests/distributed/part_fixture.h"

namespace lucarne::checkpoint_test {
namespace {

namespace fs = std::filesystem;
using test::MadeUpPart;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

void acceptAll(const PartHeader&, const std::string&) {}

class Checkpoints : public ::testing::Test {
 protected:
  Checkpoints() : path_(temp_ / "room.checkpoint") {}

  static MadeUpPart state(std::uint64_t generation) {
    return test::madeUpPart({0, 10 * generation}, 10, 7, 100, generation);
  }
  static void save(CheckpointFolder& folder, std::uint64_t generation) {
    const MadeUpPart s = state(generation);
    folder.save(s.header, s.scene, s.tallies);
  }
  /// A folder with that many states saved.
  void saveAll(std::uint64_t generations) {
    CheckpointFolder folder(path_);
    folder.open();
    for (std::uint64_t g = 1; g <= generations; ++g) save(folder, g);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& entry : fs::directory_iterator(path_)) list.push_back(entry.path().filename().string());
    std::sort(list.begin(), list.end());
    return list;
  }
  /// What load() finds is this generation, to the last bit; 0: nothing, and tallies of zero.
  void expectLoads(std::uint64_t generation) {
    CheckpointFolder folder(path_);
    Tallies tallies(10, 7);
    const std::optional<PartHeader> header = folder.load(tallies, acceptAll);
    EXPECT_EQ(header.has_value(), generation > 0);
    const Tallies expected = generation > 0 ? state(generation).tallies : Tallies(10, 7);
    EXPECT_EQ(tallies.contentHash(), expected.contentHash());
    if (!header) return;
    EXPECT_EQ(header->content, expected.contentHash());
    EXPECT_EQ(header->photons.count(), 10 * generation);
  }
  void flipByte(const std::string& name, std::size_t at) const {
    std::string bytes = test::bytesOf(path_ / name);
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    test::setBytes(path_ / name, bytes);
  }

  TempFolder temp_;
  fs::path path_;
};

TEST_F(Checkpoints, TheLastTwoStatesAreKept) {
  saveAll(1);
  EXPECT_THAT(names(), ElementsAre("lock", "state-000001.part"));
  CheckpointFolder folder(path_);
  folder.open();
  for (std::uint64_t g = 2; g <= 6; ++g) save(folder, g);
  EXPECT_THAT(names(), ElementsAre("lock", "state-000005.part", "state-000006.part"));
  EXPECT_EQ(folder.peek()->photons.count(), 60u);
}

TEST_F(Checkpoints, TheNewestStateWins) {
  saveAll(3);
  expectLoads(3);
  fs::remove(path_ / "state-000003.part");
  expectLoads(2);
}

TEST_F(Checkpoints, NamesCountOnPastSixDigits) {
  saveAll(1);
  fs::rename(path_ / "state-000001.part", path_ / "state-999999.part");
  CheckpointFolder folder(path_);
  folder.open();
  save(folder, 2);
  EXPECT_THAT(names(), ElementsAre("lock", "state-1000000.part", "state-999999.part"));
  expectLoads(2);
  save(folder, 3);
  EXPECT_THAT(names(), ElementsAre("lock", "state-1000000.part", "state-1000001.part"));
  expectLoads(3);
}

TEST_F(Checkpoints, OtherNamesAreNoStates) {
  saveAll(1);
  for (const char* name : {"state-.part", "state-x.part", "state-1.part.bak", "mystate-5.part", "state--1.part",
                           "state-9999999999999999999.part"})
    fs::copy_file(path_ / "state-000001.part", path_ / name);
  CheckpointFolder folder(path_);
  folder.open();
  save(folder, 2);
  save(folder, 3);
  EXPECT_EQ(names().size(), 9u) << "six of others, two states, the lock";
  expectLoads(3);
}

TEST_F(Checkpoints, ATruncatedStateFallsBackToTheOneBefore) {
  for (const std::uint64_t size : {std::uint64_t{0}, std::uint64_t{100}, std::uint64_t{3000}, std::uint64_t{50'000}}) {
    saveAll(2);
    fs::resize_file(path_ / "state-000002.part", size);
    expectLoads(1);
    fs::remove_all(path_);
  }
}

TEST_F(Checkpoints, AnAlteredStateFallsBackToTheOneBeforeWithItsTallies) {
  saveAll(2);
  const std::size_t size = test::bytesOf(path_ / "state-000002.part").size();
  for (const std::size_t at : {std::size_t{0}, std::size_t{200}, size / 3, size - 20'000, size - 1}) {
    flipByte("state-000002.part", at);
    expectLoads(1);
    flipByte("state-000002.part", at);
    expectLoads(2);
  }
}

TEST_F(Checkpoints, AStateThatLiesAboutItsSizeFallsBackToTheOneBefore) {
  saveAll(2);
  const std::string name = "state-000002.part";
  // 10 → 11 entries, 7 → 6 texels: the file is as long as such a one would be.
  for (const std::string member : {"\"light_entries\":10", "\"texels\":7"}) {
    flipByte(name, test::bytesOf(path_ / name).find(member) + member.size() - 1);
    EXPECT_NO_THROW(expectLoads(1)) << member;
    flipByte(name, test::bytesOf(path_ / name).find(member.substr(0, member.size() - 1)) + member.size() - 1);
  }
  expectLoads(2);
}

TEST_F(Checkpoints, TwoDamagedStatesAreNone) {
  saveAll(2);
  fs::resize_file(path_ / "state-000002.part", 3000);
  flipByte("state-000001.part", 60'000);
  expectLoads(0);
  EXPECT_TRUE(CheckpointFolder(path_).peek().has_value()) << "of the older one only the tallies are damaged";
  fs::resize_file(path_ / "state-000001.part", 10);
  EXPECT_FALSE(CheckpointFolder(path_).peek().has_value());
}

TEST_F(Checkpoints, WhereNothingIsNothingIsFoundOrMade) {
  CheckpointFolder folder(path_);
  EXPECT_FALSE(folder.peek().has_value());
  expectLoads(0);
  folder.remove();
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(Checkpoints, AStateThatIsRefusedEndsTheSearch) {
  saveAll(2);
  Tallies tallies(10, 7);
  std::vector<std::string> asked;
  const auto refuse = [&](const PartHeader&, const std::string& file) {
    asked.push_back(file);
    throw Error(ExitCode::mergeRefused, "another bake");
  };
  CheckpointFolder folder(path_);
  errorOf(ExitCode::mergeRefused, [&] { folder.load(tallies, refuse); });
  EXPECT_THAT(asked, ElementsAre((path_ / "state-000002.part").string()));
}

TEST_F(Checkpoints, OpeningRemovesWhatKilledWritersLeft) {
  saveAll(1);
  for (const char* name : {".state-000002.part.123-0.tmp", ".state-000001.part.lucarne-tmp"})
    test::setBytes(path_ / name, "half");
  test::setBytes(path_ / ".hidden", "mine");
  CheckpointFolder folder(path_);
  folder.open();
  EXPECT_THAT(names(), ElementsAre(".hidden", "lock", "state-000001.part"));
  expectLoads(1);
}

TEST_F(Checkpoints, TwoBakesCannotHoldOneFolder) {
  CheckpointFolder first(path_);
  first.open();
  CheckpointFolder second(path_);
  EXPECT_THAT(errorOf(ExitCode::failed, [&] { second.open(); }),
              HasSubstr("another bake is writing to " + path_.string()));
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      CheckpointFolder(path_).open();
      ::_exit(0);
    } catch (const Error&) {
      ::_exit(1);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status;
}

TEST_F(Checkpoints, ABakeThatIsRefusedLeavesTheOneThatHoldsTheFolderAlone) {
  CheckpointFolder first(path_);
  first.open();
  {
    CheckpointFolder second(path_);
    errorOf(ExitCode::failed, [&] { second.open(); });
  }
  EXPECT_TRUE(fs::exists(path_ / "lock"));
  EXPECT_NO_THROW(save(first, 1));
  CheckpointFolder third(path_);
  errorOf(ExitCode::failed, [&] { third.open(); });
}

TEST_F(Checkpoints, AFolderWithoutAStateIsNotLeftBehind) {
  { CheckpointFolder(path_).open(); }
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(Checkpoints, AFolderIsFreeWhenItsHolderIsGone) {
  { CheckpointFolder(path_).open(); }
  CheckpointFolder second(path_);
  EXPECT_NO_THROW(second.open());
}

TEST_F(Checkpoints, PublishingMovesTheNewestState) {
  saveAll(2);
  const std::string newest = test::bytesOf(path_ / "state-000002.part");
  test::setBytes(temp_ / "room.part", "old");
  CheckpointFolder folder(path_);
  folder.open();
  folder.publish(temp_ / "room.part");
  EXPECT_TRUE(test::bytesOf(temp_ / "room.part") == newest);
  EXPECT_THAT(names(), ElementsAre("lock", "state-000001.part"));
  folder.remove();
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(Checkpoints, PublishingFollowsALink) {
  saveAll(1);
  fs::create_directory(temp_ / "real");
  test::setBytes(temp_ / "real" / "far.part", "old");
  fs::create_symlink(temp_ / "real" / "far.part", temp_ / "room.part");
  CheckpointFolder(path_).publish(temp_ / "room.part");
  EXPECT_TRUE(fs::is_symlink(temp_ / "room.part"));
  EXPECT_TRUE(isPart(temp_ / "real" / "far.part"));
}

TEST_F(Checkpoints, PublishingReachesOtherFileSystems) {
  const fs::path memory = "/dev/shm";
  struct stat here {
  }, there{};
  if (::stat(temp_.path().c_str(), &here) != 0 || ::stat(memory.c_str(), &there) != 0 || here.st_dev == there.st_dev ||
      ::access(memory.c_str(), W_OK) != 0)
    GTEST_SKIP() << "no second file system at " << memory;
  const fs::path target = memory / ("lucarne-" + std::to_string(::getpid()) + ".part");
  saveAll(2);
  EXPECT_NO_THROW(CheckpointFolder(path_).publish(target));
  EXPECT_EQ(test::refusalOf(target), "");
  EXPECT_THAT(names(), ElementsAre("lock", "state-000001.part"));
  fs::remove(target);
}

TEST_F(Checkpoints, RemovingLeavesWhatOthersPutThere) {
  saveAll(2);
  test::setBytes(path_ / "notes.txt", "mine");
  test::setBytes(path_ / "other.part", "mine");
  CheckpointFolder folder(path_);
  folder.open();
  folder.remove();
  EXPECT_THAT(names(), ElementsAre("notes.txt", "other.part"));
  EXPECT_EQ(test::bytesOf(path_ / "notes.txt"), "mine");
}

TEST_F(Checkpoints, MovingAsideKeepsTheStatesUnderAnotherName) {
  saveAll(2);
  CheckpointFolder folder(path_);
  folder.open();
  const fs::path old = folder.moveAside();
  EXPECT_EQ(old.string(), path_.string() + ".old");
  EXPECT_FALSE(fs::exists(path_));
  Tallies tallies(10, 7);
  EXPECT_TRUE(CheckpointFolder(old).load(tallies, acceptAll).has_value());
  EXPECT_EQ(tallies.contentHash(), state(2).tallies.contentHash());
  folder.open();
  save(folder, 3);
  EXPECT_THAT(names(), ElementsAre("lock", "state-000001.part"));
}

TEST_F(Checkpoints, MovingAsideTwiceKeepsTheLaterOne) {
  for (const std::uint64_t generations : {2u, 3u}) {
    saveAll(generations);
    CheckpointFolder folder(path_);
    folder.open();
    folder.moveAside();
  }
  EXPECT_EQ(CheckpointFolder(path_.string() + ".old").peek()->photons.count(), 30u);
}

TEST_F(Checkpoints, MovingAsideNeverRemovesWhatOthersPutThere) {
  saveAll(1);
  const fs::path old = path_.string() + ".old";
  fs::create_directory(old);
  test::setBytes(old / "notes.txt", "mine");
  CheckpointFolder folder(path_);
  folder.open();
  EXPECT_THAT(errorOf(ExitCode::failed, [&] { folder.moveAside(); }), HasSubstr(path_.string()));
  EXPECT_EQ(test::bytesOf(old / "notes.txt"), "mine");
  expectLoads(1);
}

TEST_F(Checkpoints, AFolderThatCannotBeMadeIsAnErrorThatNamesIt) {
  test::setBytes(temp_ / "file", "mine");
  CheckpointFolder inFile(temp_ / "file" / "x.checkpoint"), missing(temp_ / "no" / "x.checkpoint"),
      file(temp_ / "file");
  EXPECT_THAT(errorOf(ExitCode::failed, [&] { inFile.open(); }), HasSubstr("x.checkpoint"));
  EXPECT_THAT(errorOf(ExitCode::failed, [&] { missing.open(); }), HasSubstr("x.checkpoint"));
  EXPECT_THAT(errorOf(ExitCode::failed, [&] { file.open(); }), HasSubstr("file"));
  EXPECT_EQ(test::bytesOf(temp_ / "file"), "mine");
}

using Clock = CheckpointClock::Clock;

Clock::time_point after(double seconds) {
  return Clock::time_point() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

TEST(CheckpointClock, IsDueAfterEachInterval) {
  CheckpointClock clock(10, after(100));
  EXPECT_FALSE(clock.due(after(100)));
  EXPECT_FALSE(clock.due(after(109.9)));
  EXPECT_TRUE(clock.due(after(110.1)));
  EXPECT_TRUE(clock.due(after(1000)));
  clock.saved(0.01, after(120));
  EXPECT_FALSE(clock.due(after(129)));
  EXPECT_TRUE(clock.due(after(130.1)));
}

TEST(CheckpointClock, SavingTakesAFiftiethOfTheTimeAtMost) {
  CheckpointClock clock(10, after(0));
  clock.saved(2, after(12));
  EXPECT_EQ(clock.interval(), 100);
  EXPECT_FALSE(clock.due(after(111)));
  EXPECT_TRUE(clock.due(after(112.1)));
  clock.saved(0.1, after(113));
  EXPECT_EQ(clock.interval(), 10);
}

TEST(CheckpointClock, ZeroIsNever) {
  CheckpointClock clock(0, after(0));
  EXPECT_FALSE(clock.due(after(0)));
  EXPECT_FALSE(clock.due(after(1e9)));
  clock.saved(1, after(1e9));
  EXPECT_FALSE(clock.due(after(2e9)));
}

}  // namespace
}  // namespace lucarne::checkpoint_test
