#include "base/exr_open.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTileDescription.h>

#include "base/error.h"
#include "base/exr_stream.h"
#include "base/image_file.h"
#include "base/image_size.h"

namespace lucarne {
namespace {

namespace imf = OPENEXR_IMF_NAMESPACE;

/// Rows that the library decodes at once, and so allocates even for an image of one row.
std::int64_t rowsInChunk(imf::Compression compression) {
  switch (compression) {
    case imf::NO_COMPRESSION:
    case imf::RLE_COMPRESSION:
    case imf::ZIPS_COMPRESSION:
      return 1;
    case imf::ZIP_COMPRESSION:
    case imf::PXR24_COMPRESSION:
      return 16;
    case imf::DWAB_COMPRESSION:
      return 256;
    default:
      return 32;
  }
}

/// `size` ≥ 1 rounded up to a multiple of `chunk` ≥ 1, both below 2^32.
std::int64_t roundUp(std::int64_t size, std::int64_t chunk) { return (size + chunk - 1) / chunk * chunk; }

/// What the decoded channels of one layer take, checked against what the file can hold. Returns bytes.
std::uint64_t checkLayerSize(const std::string& name, const imf::Header& header, std::uint64_t fileBytes) {
  std::uint64_t channels = 0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    ++channels;
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1) {
      throw InputError(name + ": the channel \"" + it.name() + "\" is subsampled; save it as plain RGB");
    }
  }
  if (channels == 0) throw InputError(name + ": a layer has no channels");
  const WindowSize size = sizeOf(header.dataWindow());
  const auto check = [&](std::int64_t width, std::int64_t height) {
    checkImageSize(name, width, height, channels * sizeof(float), fileBytes);
  };
  check(size.width, size.height);
  check(size.width, roundUp(size.height, rowsInChunk(header.compression())));
  if (header.hasTileDescription()) {
    const imf::TileDescription& tile = header.tileDescription();
    if (tile.xSize < 1 || tile.ySize < 1) throw InputError(name + " is damaged: its tiles have no size");
    check(roundUp(size.width, tile.xSize), roundUp(size.height, tile.ySize));
  }
  return channels * sizeof(float) * static_cast<std::uint64_t>(size.width * size.height);
}

void checkSizes(const std::string& name, const imf::MultiPartInputFile& input, ExrTiles tiles,
                std::uint64_t fileBytes) {
  std::uint64_t total = 0;
  for (int part = 0; part < input.parts(); ++part) {
    const imf::Header& header = input.header(part);
    const bool isTiled = header.hasType() && header.type() == imf::TILEDIMAGE;
    if (header.hasType() && header.type() != imf::SCANLINEIMAGE && !(isTiled && tiles == ExrTiles::read)) {
      throw InputError(name + ": a layer is of the kind " + header.type() +
                       ", which is not read; save it as scanlines");
    }
    total += checkLayerSize(name, header, fileBytes);
  }
  if (total / 4 > kMaxPixels * 4) throw InputError(name + ": its layers have too many pixels together");
  checkImageSize(name, 1, static_cast<std::int64_t>(total / 4), sizeof(float), fileBytes);
}

}  // namespace

WindowSize sizeOf(const IMATH_NAMESPACE::Box2i& window) {
  return {std::int64_t{window.max.x} - window.min.x + 1, std::int64_t{window.max.y} - window.min.y + 1};
}

void withExr(const std::filesystem::path& path, ExrTiles tiles,
             const std::function<void(imf::MultiPartInputFile&, const InputFile& file)>& use) {
  const InputFile file(path);
  const std::string name = path.string();
  try {
    scanExrHeader(file, tiles);
    ExrInputStream stream(file);
    // No reconstruction of a missing table of offsets: an unfinished file is an error here.
    imf::MultiPartInputFile input(stream, 0, false);
    checkSizes(name, input, tiles, file.size());
    use(input, file);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ExitCode::outOfResource, "not enough memory to read " + name);
  } catch (const std::exception& error) {
    throw InputError(name + " is not a usable OpenEXR file: " + exrReason(error, name));
  }
}

}  // namespace lucarne
