// A picture to draw labels and blocks of colour on.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lucarne {

using DisplayColour = std::array<std::uint8_t, 3>;  // display codes

class Canvas {
 public:
  Canvas(int width, int height, DisplayColour background);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Three bytes a pixel, top row first.
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  DisplayColour at(int x, int y) const;

  /// What lies outside the canvas is cut off, here and below.
  void fill(int x, int y, int width, int height, DisplayColour colour);
  /// Printable ASCII in a font of 12 rows, each pixel of it `scale` pixels wide and high; (x, y) is the upper left
  /// corner.
  void write(int x, int y, const std::string& text, DisplayColour colour, int scale = 1);

 private:
  int width_, height_;
  std::vector<std::uint8_t> bytes_;
};

/// Pixels from the left end of a line of text to its right one.
int textWidth(const std::string& text, int scale = 1);

}  // namespace lucarne
