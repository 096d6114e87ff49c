#include "base/files.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"

namespace lucarne::files_test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

std::string textOf(const fs::path& path) {
  const std::vector<std::uint8_t> bytes = readFile(path);
  return {bytes.begin(), bytes.end()};
}

const auto always = [](const fs::path&) { return true; };
const auto never = [](const fs::path&) { return false; };

auto fillWith(const std::string& text) {
  return [text](const fs::path& folder) {
    fs::create_directory(folder / "inner");
    writeFileAtomically(folder / "inner" / "a.txt", text);
  };
}

TEST(ReadFile, GivesBackEveryByteThatWasWritten) {
  const TempFolder folder;
  std::vector<std::uint8_t> bytes(3'000'001);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 7919 >> 3);
  writeFileAtomically(folder / "data", bytes);
  EXPECT_EQ(readFile(folder / "data"), bytes);
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(ReadFile, RefusesWhatIsMissingOrNoFileOrTooLong) {
  const TempFolder folder;
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readFile(folder / "none"); }), HasSubstr((folder / "none").string()));
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readFile(folder.path()); }), HasSubstr("folder"));
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readFile("/dev/zero"); }), HasSubstr("regular"));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readFile(folder / "pipe"); }), HasSubstr("regular"));
  writeFileAtomically(folder / "five", std::string("12345"));
  EXPECT_EQ(readFile(folder / "five", 5).size(), 5u);
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readFile(folder / "five", 4); }), HasSubstr("5 bytes"));
}

TEST(WriteFile, ReplacesAndKeepsThePermissions) {
  const TempFolder folder;
  writeFileAtomically(folder / "f", std::string("old"));
  ASSERT_EQ(::chmod((folder / "f").c_str(), 0640), 0);
  writeFileAtomically(folder / "f", std::string("new"));
  EXPECT_EQ(textOf(folder / "f"), "new");
  EXPECT_EQ(fs::status(folder / "f").permissions(), fs::perms{0640});
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(WriteFile, FollowsASymbolicLinkInsteadOfReplacingIt) {
  const TempFolder folder;
  writeFileAtomically(folder / "real", std::string("old"));
  fs::create_symlink("real", folder / "link");
  writeFileAtomically(folder / "link", std::string("new"));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(textOf(folder / "real"), "new");
}

TEST(WriteFile, TellsAFullDiskFromOtherFailures) {
  const TempFolder folder;
  EXPECT_THAT(errorOf(ExitCode::outOfResource, [] { writeFileAtomically("/dev/full", std::string("x")); }),
              HasSubstr("/dev/full"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  writeFileAtomically("/dev/null", std::string("x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  writeFileAtomically(folder / "file", std::string("x"));
  for (const fs::path& bad : {folder / "file/below", folder / "missing/file", folder.path(), fs::path()}) {
    errorOf(ExitCode::failed, [&] { writeFileAtomically(bad, std::string("x")); });
  }
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(WriteFolder, AppearsWholeAndIsReplacedWhole) {
  const TempFolder folder;
  writeFolderAtomically(folder / "out.dlm", never, fillWith("first"));
  EXPECT_EQ(textOf(folder / "out.dlm" / "inner" / "a.txt"), "first");
  writeFolderAtomically(folder / "out.dlm/", always,
                        [](const fs::path& fresh) { writeFileAtomically(fresh / "b.txt", std::string("second")); });
  EXPECT_EQ(textOf(folder / "out.dlm" / "b.txt"), "second");
  EXPECT_FALSE(fs::exists(folder / "out.dlm" / "inner"));
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(WriteFolder, LeavesTheOldOneWhenFillingFails) {
  const TempFolder folder;
  writeFolderAtomically(folder / "out.dlm", always, fillWith("first"));
  const auto failing = [](const fs::path& fresh) {
    writeFileAtomically(fresh / "half.txt", std::string("half"));
    throw Error(ExitCode::outOfResource, "disk full");
  };
  errorOf(ExitCode::outOfResource, [&] { writeFolderAtomically(folder / "out.dlm", always, failing); });
  EXPECT_EQ(textOf(folder / "out.dlm" / "inner" / "a.txt"), "first");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(WriteFolder, ReplacesNothingThatItMayNotAndDoesNotFillThen) {
  const TempFolder folder;
  fs::create_directory(folder / "photos");
  writeFileAtomically(folder / "file", std::string("mine"));
  bool filled = false;
  const auto fill = [&](const fs::path&) { filled = true; };
  EXPECT_THAT(errorOf(ExitCode::failed, [&] { writeFolderAtomically(folder / "photos", never, fill); }),
              HasSubstr("photos"));
  errorOf(ExitCode::failed, [&] { writeFolderAtomically(folder / "file", always, fill); });
  errorOf(ExitCode::failed, [&] { writeFolderAtomically(folder / "file/below", always, fill); });
  errorOf(ExitCode::failed, [&] { writeFolderAtomically(folder / "missing/below", always, fill); });
  EXPECT_FALSE(filled);
  EXPECT_EQ(textOf(folder / "file"), "mine");
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(CheckWritable, AgreesWithWritingAndLeavesNoTrace) {
  const TempFolder folder;
  writeFileAtomically(folder / "file", std::string("mine"));
  checkWritable(folder / "new");
  checkWritable(folder / "file");
  checkWritable("/dev/null");
  EXPECT_EQ(folder.entries(), 1u);
  EXPECT_EQ(textOf(folder / "file"), "mine");
  EXPECT_THAT(errorOf(ExitCode::failed, [&] { checkWritable(folder / "missing/new"); }), HasSubstr("missing"));
  errorOf(ExitCode::failed, [&] { checkWritable(folder / "file/new"); });
  errorOf(ExitCode::failed, [] { checkWritable("/proc/new"); });
}

}  // namespace
}  // namespace lucarne::files_test
