#include "base/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace lucarne::canvas_test {
namespace {

constexpr DisplayColour kBlack{0, 0, 0}, kRed{255, 0, 0};

int countOf(const Canvas& canvas, DisplayColour colour) {
  int n = 0;
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) n += canvas.at(x, y) == colour;
  }
  return n;
}

TEST(Canvas, FillsWhatLiesInside) {
  Canvas canvas(20, 10, kBlack);
  canvas.fill(3, 2, 4, 5, kRed);
  EXPECT_EQ(countOf(canvas, kRed), 20);
  canvas.fill(-5, -5, 7, 6, kRed);     // 2 × 1 of it
  canvas.fill(18, 8, 100, 100, kRed);  // 2 × 2
  canvas.fill(30, 30, 5, 5, kRed);
  canvas.fill(5, 5, -3, 4, kRed);
  EXPECT_EQ(countOf(canvas, kRed), 20 + 2 + 4);
}

TEST(Canvas, LettersAreDrawnWithinTheirWidthAndDifferFromEachOther) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789%(),.-:";
  std::vector<std::vector<std::uint8_t>> seen;
  for (const char letter : letters) {
    Canvas canvas(30, 14, kBlack);
    canvas.write(2, 1, std::string(1, letter), kRed);
    EXPECT_GT(countOf(canvas, kRed), 0) << letter;
    Canvas right = canvas;
    right.fill(0, 0, 2 + textWidth(std::string(1, letter)), 14, kBlack);
    EXPECT_EQ(countOf(right, kRed), 0) << letter;
    EXPECT_EQ(std::find(seen.begin(), seen.end(), canvas.bytes()), seen.end()) << letter;
    seen.push_back(canvas.bytes());
  }
}

TEST(Canvas, TextScalesAndIsCutAtTheBorder) {
  Canvas once(200, 30, kBlack), twice(400, 60, kBlack), cut(10, 5, kBlack);
  once.write(0, 0, "room.dlm", kRed);
  twice.write(0, 0, "room.dlm", kRed, 2);
  EXPECT_EQ(4 * countOf(once, kRed), countOf(twice, kRed));
  EXPECT_EQ(2 * textWidth("room.dlm"), textWidth("room.dlm", 2));
  cut.write(-3, -3, "room.dlm", kRed, 3);
}

TEST(Canvas, LettersThatTheFontDoesNotKnowBecomeQuestionMarks) {
  Canvas a(100, 14, kBlack), b(100, 14, kBlack);
  a.write(0, 0, "x\xc3\xb1\n\x7fy", kRed);
  b.write(0, 0, "x????y", kRed);
  EXPECT_EQ(a.bytes(), b.bytes());
}

}  // namespace
}  // namespace lucarne::canvas_test
