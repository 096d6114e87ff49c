// The bytes of an OpenEXR file of uncompressed 32-bit layers, known before the first pixel is written.
//
// A part is read and written in one pass, row by row, while its hash is taken; all that is not pixels follows from the
// sizes and the text in the header. So the writer never seeks, and a reader compares byte for byte what it expects.
// (ASWF, "OpenEXR File Layout", multi-part scanline files.)
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lucarne {

struct ExrRowsLayer {
  std::string name;
  std::vector<std::string> channels;  // UINT, in alphabetical order
  int height = 1;
};

/// All layers are `width` pixels wide.
class ExrRows {
 public:
  /// `text` is kept in a string attribute of the first layer.
  ExrRows(int width, std::vector<ExrRowsLayer> layers, const std::string& attribute, const std::string& text);

  int width() const { return width_; }
  const std::vector<ExrRowsLayer>& layers() const { return layers_; }
  /// Magic, headers, and the tables of offsets.
  const std::string& head() const { return head_; }
  std::uint64_t fileBytes() const { return fileBytes_; }
  /// Bytes of pixels in one row of a layer; they follow rowHead().
  std::uint64_t rowBytes(std::size_t layer) const;
  /// Layer number, y, and length: what stands before each row. 12 bytes.
  std::string rowHead(std::size_t layer, int y) const;

  static constexpr std::uint64_t kRowHeadBytes = 12;

 private:
  std::string header(const ExrRowsLayer& layer, int displayHeight) const;

  int width_;
  std::vector<ExrRowsLayer> layers_;
  std::string head_;
  std::uint64_t fileBytes_ = 0;
};

/// The text attribute `name` of the first header in `bytes`, the beginning of a file. Empty when there is none, or when
/// the bytes end before it does: `needed` is then how many bytes to come back with (0: never).
std::string exrTextAttribute(const std::string& bytes, const std::string& name, std::uint64_t& needed);

}  // namespace lucarne
