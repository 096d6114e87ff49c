// A display without a screen, for tests of windows: Xvfb, and xdotool to press its keys.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/image_file.h"
#include "tests/cli/driver_leaks.h"
#include "tests/cli/program.h"

namespace lucarne::test {

/// Patient: many tests share a machine. True as soon as `done` is.
inline bool soon(const std::function<bool()>& done, double seconds = 240) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    ::usleep(50'000);
  }
  return true;
}

class DisplayTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    for (const char* program : {"Xvfb", "xdotool"}) {
      if (shell(std::string("command -v ") + program).code != 0) GTEST_SKIP() << program << " is not installed";
    }
    xvfb_.emplace(folder_,
                  "Xvfb -displayfd 3 -screen 0 800x600x24 -nolisten tcp -fbdir '" + folder_.string() + "' 3>display");
    ASSERT_TRUE(soon([&] { return slurp(folder_ / "display").ends_with("\n") || !xvfb_->running(); }));
    const std::string number = slurp(folder_ / "display");
    if (number.empty()) GTEST_SKIP() << "Xvfb does not start here: " << slurp(folder_ / "log");
    display_ = ":" + number.substr(0, number.find('\n'));
  }
  void TearDown() override {
    program_.reset();
    xvfb_.reset();
    ProgramTest::TearDown();
  }

  /// Starts the program on the display.
  void start(const std::string& arguments) {
    program_.emplace(folder_, "env DISPLAY=" + display_ + " \"$LUCARNE\" " + arguments);
  }
  /// True when the window is there.
  bool findWindow(const std::string& name) {
    return soon([&] {
             window_ = shell("DISPLAY=" + display_ + " xdotool search --name '" + name + "' | head -n 1").out;
             while (!window_.empty() && window_.back() == '\n') window_.pop_back();
             return !window_.empty() || !program_->running();
           }) &&
           !window_.empty();
  }
  /// Words for xdotool, WINDOW standing for the window. True when it could do them.
  bool tries(std::string words) {
    for (std::size_t at; (at = words.find("WINDOW")) != std::string::npos;) words.replace(at, 6, window_);
    return shell("DISPLAY=" + display_ + " xdotool " + words).code == 0;
  }
  void tool(const std::string& words) { ASSERT_TRUE(tries(words)) << words; }

  /// A part of the screen.
  struct Part {
    int x, y, width, height;
  };
  /// Xvfb keeps the screen in a file, an X window dump whose header is big-endian words. 0xRRGGBB, row by row.
  std::vector<std::uint32_t> screen(Part part) const {
    std::ifstream dump(folder_ / "Xvfb_screen0", std::ios::binary);
    std::uint8_t header[100] = {};
    dump.read(reinterpret_cast<char*>(header), sizeof header);
    const auto word = [&](std::size_t i) {
      const std::uint8_t* b = header + 4 * i;
      return std::streamoff{b[0]} << 24 | std::streamoff{b[1]} << 16 | std::streamoff{b[2]} << 8 | std::streamoff{b[3]};
    };
    const std::streamoff start = word(0) + word(19) * 12, row = word(12);
    std::vector<std::uint32_t> pixels(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
    for (int y = 0; y < part.height; ++y) {
      dump.seekg(start + (part.y + y) * row + 4 * part.x);
      dump.read(reinterpret_cast<char*>(&pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(part.width)]),
                4 * part.width);
    }
    if (!dump) ADD_FAILURE() << "no picture of the display";
    for (std::uint32_t& p : pixels) p &= 0xffffffu;
    return pixels;
  }
  /// Share of pixels that differ plainly: the automatic exposure creeps for a while.
  static double difference(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    constexpr int kPlainly = 16;  // of 255
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      int largest = 0;
      for (const int shift : {0, 8, 16})
        largest =
            std::max(largest, std::abs(static_cast<int>(a[i] >> shift & 255) - static_cast<int>(b[i] >> shift & 255)));
      count += largest > kPlainly ? 1 : 0;
    }
    return static_cast<double>(count) / static_cast<double>(a.size());
  }

  DriverLeaksAllowed driverLeaks_;
  std::optional<Background> xvfb_, program_;
  std::string display_, window_;
};

}  // namespace lucarne::test
