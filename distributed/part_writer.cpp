#include "base/atomic_file.h"
#include "base/error.h"
#include "distributed/part_file.h"

namespace lucarne {
namespace {

/// Bytes go to the file and into its seal.
class SealedFile {
 public:
  explicit SealedFile(const std::filesystem::path& path) : file_(path) {}
  void write(const void* data, std::size_t size) {
    file_.write(data, size);
    hasher_.add(std::span(static_cast<const std::byte*>(data), size));
  }
  void write(const std::string& bytes) { write(bytes.data(), bytes.size()); }
  void commit() {
    const std::string seal = partSeal(hasher_.finish());
    file_.write(seal.data(), seal.size());
    file_.commit();
  }

 private:
  AtomicFile file_;
  Hasher hasher_;
};

void writeScene(const ExrRows& rows, std::span<const std::uint8_t> scene, SealedFile& file) {
  constexpr std::size_t kLayer = 0;
  const std::size_t rowBytes = rows.rowBytes(kLayer);
  for (int y = 0; y < rows.layers()[kLayer].height; ++y) {
    const auto bytes = scene.subspan(std::min(scene.size(), static_cast<std::size_t>(y) * rowBytes));
    std::vector<std::uint8_t> row(bytes.begin(),
                                  bytes.begin() + static_cast<std::ptrdiff_t>(std::min(rowBytes, bytes.size())));
    row.resize(rowBytes);
    file.write(rows.rowHead(kLayer, y));
    file.write(row.data(), row.size());
  }
}

void writeTallies(const ExrRows& rows, const PartTallies& at, std::span<const std::int64_t> values, SealedFile& file) {
  const std::size_t index = at.index;
  const std::size_t perRow = kPartWidth * kPartChannels;
  std::vector<std::uint32_t> row(rows.rowBytes(index) / 4);
  for (int y = 0; y < rows.layers()[index].height; ++y) {
    const auto left = values.subspan(std::min(values.size(), static_cast<std::size_t>(y) * perRow));
    const auto here = left.first(std::min(perRow, left.size()));
    std::int64_t signs = 0;
    for (const std::int64_t v : here) signs |= v;
    LUCARNE_CHECK_LE(std::int64_t{0}, signs);
    if (here.size() < perRow) std::fill(row.begin(), row.end(), 0);
    splitRow(at.layer, here, row);
    file.write(rows.rowHead(index, y));
    file.write(row.data(), row.size() * 4);
  }
}

}  // namespace

void writePart(const std::filesystem::path& path, PartHeader header, std::span<const std::uint8_t> scene,
               const Tallies& tallies) {
  header.sceneBytes = scene.size();
  header.sceneFile = hashBytes(scene);
  header.lightEntries = tallies.light().size() / kLightChannels;
  header.texels = tallies.statistics().size() / kStatisticsChannels;
  header.momentEntries = tallies.moments().size() / kMomentChannels;
  header.content = tallies.contentHash();
  LUCARNE_CHECK_EQ(header.direct.has_value(), tallies.direct() != nullptr);
  const ExrRows rows = partRows(header, path.string());
  SealedFile file(path);
  file.write(rows.head());
  writeScene(rows, scene, file);
  for (const PartTallies& at : partTallies(header)) writeTallies(rows, at, talliesOf(at.layer, tallies), file);
  file.commit();
}

}  // namespace lucarne
