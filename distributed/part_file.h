// Writing and reading .part files, in one pass and a few rows of memory beside the tallies.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "base/input_file.h"
#include "distributed/part_layout.h"
#include "dlm/tally.h"

namespace lucarne {

/// Written aside, flushed, renamed. Fills in header.sceneBytes, sceneFile, lightEntries, texels, momentEntries and content
/// from what it is given.
/// Throws Error as AtomicFile does, and a std::logic_error when a tally is negative (it has overflowed).
void writePart(const std::filesystem::path& path, PartHeader header, std::span<const std::uint8_t> scene,
               const Tallies& tallies);

/// The tallies that a layer holds; `tallies` have the set that it is of.
inline std::span<std::int64_t> talliesOf(PartLayer layer, const Tallies& tallies) {
  const bool direct = layer >= PartLayer::directLight;
  const Tallies& set = direct ? *tallies.direct() : tallies;
  if (isLight(layer)) return set.light();
  const bool statistics = layer == PartLayer::statistics || layer == PartLayer::directStatistics;
  return statistics ? set.statistics() : set.moments();
}

/// A part opened for reading. The header is believed for its form; that the file is whole and unaltered is known only
/// when stream() has come to its end. All failures are PartErrors that name the file; a file that cannot be read at all
/// is an InputError.
class PartReader {
 public:
  explicit PartReader(const std::filesystem::path& path);
  const PartHeader& header() const { return header_; }
  const std::filesystem::path& path() const { return file_.path(); }

  /// What stream() hands over, in this order: bytes of the scene, then rows of tallies. `first` counts values, in the
  /// order of Tallies::light(), statistics() and moments().
  struct Sink {
    std::function<void(std::span<const std::uint8_t>)> scene;
    std::function<void(PartLayer, std::uint64_t first, std::span<const std::int64_t>)> tallies;
  };
  /// Reads the whole file once and checks every byte of it.
  void stream(const Sink& sink) const;

 private:
  PartHeader readHeader() const;

  InputFile file_;
  PartHeader header_;
  ExrRows rows_;
};

/// Adds the tallies of a part. Throws Error(outOfResource) where a sum would pass 63 bits, and PartError for a negative
/// tally or when the two are of different sizes. What was added stays added. `scene`, where given, receives the part's scene.
void addPart(const PartReader& part, Tallies& tallies, std::vector<std::uint8_t>* scene = nullptr);

/// True for a file that begins as a part does, whatever follows.
bool isPart(const std::filesystem::path& path);

}  // namespace lucarne
