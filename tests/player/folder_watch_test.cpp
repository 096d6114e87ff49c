#include "player/folder_watch.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace lucarne::folder_watch_test {
namespace {

namespace fs = std::filesystem;

class FolderWatched : public testing::Test {
 protected:
  FolderWatched()
      : base_(fs::path(testing::TempDir()) / ("lucarne_watch_" + std::to_string(::getpid()) + "_" +
                                              testing::UnitTest::GetInstance()->current_test_info()->name())),
        folder_(base_ / "room.dlm") {
    fs::create_directories(base_);
    put("one");
  }
  ~FolderWatched() override { fs::remove_all(base_); }

  /// Replaces the folder as a bake does.
  void put(const std::string& text) {
    const fs::path made = base_ / "made";
    fs::create_directories(made);
    std::ofstream(made / "manifest.json") << text;
    fs::remove_all(folder_);
    fs::rename(made, folder_);
  }
  static int changes(FolderWatch& watch) {
    int count = 0;
    for (int i = 0; i < 5; ++i) count += watch.changed() ? 1 : 0;
    return count;
  }
  fs::path base_, folder_;
};

TEST_F(FolderWatched, EachReplacementIsToldOnce) {
  FolderWatch watch(folder_);
  EXPECT_EQ(changes(watch), 0);
  put("two");
  EXPECT_EQ(changes(watch), 1);
  put("longer than two");
  EXPECT_EQ(changes(watch), 1);
  EXPECT_EQ(changes(watch), 0);
}

TEST_F(FolderWatched, WhatStillChangesIsNotTold) {
  FolderWatch watch(folder_);
  for (int i = 1; i < 5; ++i) {
    put(std::string(static_cast<std::size_t>(10 * i), 'x'));
    EXPECT_FALSE(watch.changed());
  }
  EXPECT_TRUE(watch.changed());
}

TEST_F(FolderWatched, GoneIsNoChangeAndBackIsOne) {
  FolderWatch watch(folder_);
  fs::remove_all(folder_);
  EXPECT_EQ(changes(watch), 0);
  put("back again");
  EXPECT_EQ(changes(watch), 1);
}

TEST_F(FolderWatched, WhatIsForgottenIsKnown) {
  FolderWatch watch(folder_);
  put("two and more");
  watch.forget();
  EXPECT_EQ(changes(watch), 0);
}

}  // namespace
}  // namespace lucarne::folder_watch_test
