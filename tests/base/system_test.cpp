#include "base/system.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <vector>

#include "base/memory.h"

namespace lucarne::system_test {
namespace {

TEST(Memory, PeakGrowsWithWhatIsTouched) {
  constexpr std::size_t kBytes = std::size_t{64} << 20;
  const std::uint64_t before = peakMemoryBytes();
  const std::vector<char> touched(kBytes, 1);
  EXPECT_GE(peakMemoryBytes(), kBytes);
  EXPECT_GE(peakMemoryBytes(), before);
  EXPECT_EQ(touched[kBytes / 2], 1);
}

TEST(Memory, AvailableIsSomethingAndAtMostAll) {
  EXPECT_GT(availableMemoryBytes(), std::uint64_t{1} << 20);
  EXPECT_LE(availableMemoryBytes(), totalMemoryBytes());
}

TEST(System, DescriptionHasNoHostName) {
  const HostDescription host = describeHost();
  EXPECT_GE(host.threads, 1);
  EXPECT_EQ(host.threads, threadCount());
  EXPECT_EQ(host.memoryBytes, totalMemoryBytes());
  EXPECT_FALSE(host.cpu.empty());
  std::array<char, 256> name{};
  ASSERT_EQ(::gethostname(name.data(), name.size() - 1), 0);
  if (name[0] == '\0') GTEST_SKIP() << "this host has no name";
  EXPECT_EQ((host.cpu + "|" + host.system).find(name.data()), std::string::npos);
}

}  // namespace
}  // namespace lucarne::system_test
