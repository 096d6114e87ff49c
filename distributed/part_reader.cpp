#include <cstring>

#include "base/json.h"
#include "distributed/part_file.h"

namespace lucarne {
namespace {

constexpr std::uint64_t kFirstLook = std::uint64_t{1} << 16;

/// Reads a block at a time while the system fetches the next ones; every byte is hashed once, in order.
class SequentialReader {
 public:
  explicit SequentialReader(const InputFile& file) : file_(file) {}

  /// Valid until the next call. Fewer bytes only at the end of the file.
  std::span<const std::byte> take(std::size_t count) {
    if (end_ - at_ < count) refill(count);
    const auto bytes = std::span<const std::byte>(buffer_).subspan(at_, std::min(count, end_ - at_));
    at_ += bytes.size();
    hasher_.add(bytes);
    return bytes;
  }
  Hash128 hash() const { return hasher_.finish(); }

 private:
  void refill(std::size_t count) {
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(at_), buffer_.begin() + static_cast<std::ptrdiff_t>(end_),
              buffer_.begin());
    end_ -= at_;
    at_ = 0;
    if (buffer_.size() < std::max(count, kBlock)) buffer_.resize(std::max(count, kBlock));
    const std::size_t got = file_.read(offset_, buffer_.data() + end_, buffer_.size() - end_);
    offset_ += got;
    end_ += got;
    file_.prefetch(offset_, kAhead);
  }

  static constexpr std::size_t kBlock = std::size_t{1} << 18, kAhead = std::size_t{8} << 20;
  const InputFile& file_;
  std::vector<std::byte> buffer_;
  std::size_t at_ = 0, end_ = 0;  // of what is in the buffer and not yet taken
  std::uint64_t offset_ = 0;
  Hasher hasher_;
};

[[noreturn]] void failAltered(const std::filesystem::path& path) {
  throw PartError(path.string() + " was altered since it was written; copy it again, or bake its photons again");
}

/// Walks through the rows of a part and hands them on.
class PartStream {
 public:
  PartStream(const InputFile& file, const PartHeader& header, const ExrRows& rows, const PartReader::Sink& sink)
      : path_(file.path()), reader_(file), header_(header), rows_(rows), sink_(sink) {}

  void run() {
    expect(rows_.head());
    scene();
    for (const PartTallies& at : partTallies(header_)) tallies(at);
    const std::string seal = partSeal(reader_.hash());
    expect(seal);
    if (content_.finish() != header_.content || sceneHash_.finish() != header_.sceneFile) failAltered(path_);
  }

 private:
  std::span<const std::byte> take(std::uint64_t count) {
    const auto bytes = reader_.take(count);
    if (bytes.size() < count) failAltered(path_);
    return bytes;
  }
  void expect(const std::string& bytes) {
    const auto here = take(bytes.size());
    if (std::memcmp(here.data(), bytes.data(), bytes.size()) != 0) failAltered(path_);
  }
  template <class F>
  void forRows(std::size_t index, F&& f) {
    for (int y = 0; y < rows_.layers()[index].height; ++y) {
      expect(rows_.rowHead(index, y));
      f(static_cast<std::uint64_t>(y), take(rows_.rowBytes(index)));
    }
  }

  void scene() {
    std::uint64_t left = header_.sceneBytes;
    forRows(0, [&](std::uint64_t, std::span<const std::byte> row) {
      const auto bytes = row.first(std::min<std::uint64_t>(left, row.size()));
      left -= bytes.size();
      sceneHash_.add(bytes);
      if (sink_.scene) sink_.scene({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    });
  }

  void tallies(const PartTallies& at) {
    const auto [layer, index, pixels] = at;
    std::vector<std::uint32_t> words(rows_.rowBytes(index) / 4);
    std::vector<std::int64_t> values(kPartWidth * kPartChannels);
    forRows(index, [&, layer = layer, pixels = pixels](std::uint64_t y, std::span<const std::byte> row) {
      std::memcpy(words.data(), row.data(), row.size());
      const std::uint64_t first = y * kPartWidth;
      const auto here =
          std::span(values).first(kPartChannels * std::min<std::uint64_t>(kPartWidth, pixels - std::min(pixels, first)));
      joinRow(layer, words, here);
      content_.add(std::as_bytes(here));
      if (sink_.tallies) sink_.tallies(layer, first * kPartChannels, here);
    });
  }

  const std::filesystem::path& path_;
  SequentialReader reader_;
  const PartHeader& header_;
  const ExrRows& rows_;
  const PartReader::Sink& sink_;
  Hasher content_, sceneHash_;
};

std::string headerText(const InputFile& file) {
  if (file.size() == 0) throw PartError(file.path().string() + " is empty");
  std::uint64_t needed = kFirstLook;
  std::string text;
  while (needed > 0 && text.empty()) {
    if (needed > kMaxJsonBytes) break;
    std::string bytes(std::min(needed, file.size()), '\0');
    bytes.resize(file.read(0, bytes.data(), bytes.size()));
    const std::uint64_t before = needed;
    text = exrTextAttribute(bytes, "lucarne", needed);
    if (text.empty() && needed > 0 && (needed > file.size() || needed <= before)) {
      throw PartError(file.path().string() + " is cut short: it ends within its header");
    }
  }
  if (text.empty()) throw PartError(file.path().string() + " is not a part of a bake");
  return text;
}

}  // namespace

PartHeader PartReader::readHeader() const {
  const std::string text = headerText(file_), name = file_.path().string();
  try {
    const nlohmann::json json = parseJson({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, name);
    return partHeaderFrom(JsonView(json, name));
  } catch (const PartError&) {
    throw;
  } catch (const InputError& error) {
    throw PartError(error.what());
  }
}

PartReader::PartReader(const std::filesystem::path& path) : file_(path), header_(readHeader()), rows_(0, {}, "", "") {
  // Before anything of that size is made: a layer takes at least its bytes in the file.
  const std::uint64_t size = file_.size();
  if (header_.sceneBytes > size || header_.lightEntries > size / 24 || header_.texels > size / 24 ||
      header_.momentEntries > size / 24) {
    throw PartError(path.string() + " is cut short: it has " + std::to_string(size) +
                    " bytes, fewer than its tallies take");
  }
  rows_ = partRows(header_, path.string());
  const std::uint64_t whole = rows_.fileBytes() + kSealBytes;
  if (size < whole) {
    throw PartError(path.string() + " is cut short: it has " + std::to_string(size) + " of " + std::to_string(whole) +
                    " bytes");
  }
  if (size > whole) {
    throw PartError(path.string() + " was altered: it has " + std::to_string(size - whole) + " bytes too many");
  }
}

void PartReader::stream(const Sink& sink) const { PartStream(file_, header_, rows_, sink).run(); }

namespace {

/// Adds rows of tallies, and remembers the signs of what it added and of what came out: two numbers of 63 bits add up
/// to one of 64, so no sum that is too large goes unseen.
class TallyAdder {
 public:
  explicit TallyAdder(Tallies& tallies) : tallies_(tallies) {}
  void add(PartLayer layer, std::uint64_t first, std::span<const std::int64_t> values) {
    std::int64_t* sum = talliesOf(layer, tallies_).data() + first;
    std::int64_t negative = 0, overflow = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum[i] = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum[i]) + static_cast<std::uint64_t>(values[i]));
      negative |= values[i];
      overflow |= sum[i];
    }
    negative_ |= negative;
    overflow_ |= overflow;
  }
  bool metNegative() const { return negative_ < 0; }
  bool overflowed() const { return overflow_ < 0; }

 private:
  Tallies& tallies_;
  std::int64_t negative_ = 0, overflow_ = 0;
};

}  // namespace

void addPart(const PartReader& part, Tallies& tallies, std::vector<std::uint8_t>* scene) {
  if (tallies.light().size() != part.header().lightEntries * kLightChannels ||
      tallies.statistics().size() != part.header().texels * kStatisticsChannels ||
      tallies.moments().size() != part.header().momentEntries * kMomentChannels ||
      (tallies.direct() != nullptr) != part.header().direct.has_value()) {
    throw PartError(part.path().string() + " was altered: its tallies are of another size than its layout");
  }
  TallyAdder adder(tallies);
  PartReader::Sink sink;
  sink.tallies = [&](PartLayer layer, std::uint64_t first, std::span<const std::int64_t> values) {
    adder.add(layer, first, values);
  };
  if (scene != nullptr) {
    sink.scene = [scene](std::span<const std::uint8_t> bytes) {
      scene->insert(scene->end(), bytes.begin(), bytes.end());
    };
  }
  part.stream(sink);
  if (adder.metNegative()) throw PartError(part.path().string() + " was altered: a tally is negative");
  if (adder.overflowed()) {
    throw Error(ExitCode::outOfResource,
                "tallies are full: " + part.path().string() + " does not fit on top of the others; merge fewer parts");
  }
}

bool isPart(const std::filesystem::path& path) {
  try {
    return !headerText(InputFile(path)).empty();
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace lucarne
