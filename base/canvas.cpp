#include "base/canvas.h"

#include <stb/stb_easy_font.h>

#include <algorithm>

namespace lucarne {
namespace {

/// The font's own corner of a quad.
struct FontVertex {
  float x, y, z;
  unsigned char colour[4];
};
static_assert(sizeof(FontVertex) == 16);

/// The font knows no other letters, and looks for them in tables without asking. It wants the text writable.
std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

}  // namespace

Canvas::Canvas(int width, int height, DisplayColour background)
    : width_(width), height_(height), bytes_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  fill(0, 0, width, height, background);
}

DisplayColour Canvas::at(int x, int y) const {
  const std::uint8_t* p =
      &bytes_[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x))];
  return {p[0], p[1], p[2]};
}

void Canvas::fill(int x, int y, int width, int height, DisplayColour colour) {
  const int x0 = std::max(x, 0), x1 = std::min(x + width, width_), y1 = std::min(y + height, height_);
  for (int row = std::max(y, 0); row < y1; ++row) {
    std::uint8_t* p = bytes_.data() + 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                                           static_cast<std::size_t>(x0));
    for (int column = x0; column < x1; ++column, p += 3) std::copy(colour.begin(), colour.end(), p);
  }
}

// The font is made of horizontal and vertical strokes, one font pixel thick: rectangles with whole corners.
void Canvas::write(int x, int y, const std::string& text, DisplayColour colour, int scale) {
  constexpr std::size_t kQuadsPerLetter = 24, kQuadBytes = 4 * sizeof(FontVertex);
  std::string copy = printable(text);
  std::vector<FontVertex> vertices(4 * kQuadsPerLetter * std::max<std::size_t>(1, copy.size()));
  const int room = static_cast<int>(kQuadsPerLetter * kQuadBytes * std::max<std::size_t>(1, copy.size()));
  const int quads = stb_easy_font_print(0, 0, copy.data(), nullptr, vertices.data(), room);
  for (std::size_t q = 0; q < static_cast<std::size_t>(quads); ++q) {
    const FontVertex &from = vertices[4 * q], &to = vertices[4 * q + 2];
    const int left = static_cast<int>(from.x), top = static_cast<int>(from.y);
    fill(x + left * scale, y + top * scale, (static_cast<int>(to.x) - left) * scale,
         (static_cast<int>(to.y) - top) * scale, colour);
  }
}

int textWidth(const std::string& text, int scale) {
  std::string copy = printable(text);
  return stb_easy_font_width(copy.data()) * scale;
}

}  // namespace lucarne
