// The lines and covers of a chart side by the texels that they are in, and what a step from place to place crosses.
#pragma once

#include <cstdint>
#include <span>

#include "dlm/contact_lines.h"

namespace lucarne {

class ContactBins {
 public:
  /// `lines` must outlive this.
  ContactBins(int width, int height, const SideLines& lines);

  /// Texels with a line or a cover, ascending.
  const std::vector<std::uint32_t>& touched() const { return texels_; }
  /// Index of a texel in touched(), or kNone.
  std::uint32_t indexOf(std::size_t texel) const { return index_[texel]; }
  bool hasLine(std::size_t texel) const { return index_[texel] != kNone && !linesOf(index_[texel]).empty(); }

  /// A line of a touched texel lies between two places (or touches one).
  bool crossedIn(std::uint32_t touched, Vec2d p, Vec2d q) const;
  /// A line of any texel does.
  bool crossed(Vec2d p, Vec2d q) const;
  /// A cover of a touched texel is over a place.
  bool covered(std::uint32_t touched, Vec2d p) const;

 private:
  struct Entry {
    std::uint32_t texel, item;
    friend auto operator<=>(const Entry&, const Entry&) = default;
  };
  std::vector<Entry> enterLines() const;
  std::vector<Entry> enterCovers() const;
  std::span<const Entry> linesOf(std::uint32_t touched) const {
    return std::span(lines_).subspan(firstLine_[touched], firstLine_[touched + 1] - firstLine_[touched]);
  }

  int width_, height_;
  const SideLines& all_;
  std::vector<Entry> lines_, covers_;  // by texel
  std::vector<std::uint32_t> texels_, index_;
  std::vector<std::size_t> firstLine_, firstCover_;  // of each touched texel, and one past the last
};

}  // namespace lucarne
