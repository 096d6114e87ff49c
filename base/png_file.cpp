#include <stb/stb_image_write.h>

#include <climits>

#include "base/error.h"
#include "base/files.h"
#include "base/image_file.h"
#include "base/png_encode.h"

namespace lucarne {

std::vector<std::uint8_t> encodePng(int width, int height, std::span<const std::uint8_t> rgb) {
  LUCARNE_CHECK_LT(0, width);
  LUCARNE_CHECK_LT(0, height);
  LUCARNE_CHECK_EQ(rgb.size(), std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  constexpr std::size_t kLargest = INT_MAX / 2;  // the encoder counts bytes in int
  if (rgb.size() > kLargest) throw Error(ExitCode::failed, "a picture is too large for a PNG");
  std::vector<std::uint8_t> encoded;
  const auto append = [](void* context, void* data, int size) {
    const std::uint8_t* bytes = static_cast<const std::uint8_t*>(data);
    static_cast<std::vector<std::uint8_t>*>(context)->insert(static_cast<std::vector<std::uint8_t>*>(context)->end(),
                                                             bytes, bytes + size);
  };
  if (stbi_write_png_to_func(append, &encoded, width, height, 3, rgb.data(), 3 * width) == 0)
    throw Error(ExitCode::outOfResource, "not enough memory for a PNG");
  return encoded;
}

void writePng(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb) {
  std::vector<std::uint8_t> encoded;
  try {
    encoded = encodePng(width, height, rgb);
  } catch (const Error& error) {
    throw Error(error.code(), "cannot write " + path.string() + ": " + error.what());
  }
  writeFileAtomically(path, encoded);
}

}  // namespace lucarne
