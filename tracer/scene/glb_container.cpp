#include "tracer/scene/glb_container.h"

#include <algorithm>

namespace lucarne {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67, kJson = 0x4e4f534a, kBin = 0x004e4942;  // "glTF", "JSON", "BIN\0"

std::uint32_t readWord(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= std::uint32_t{bytes[at + i]} << (8 * i);
  return word;
}

void putWord(std::vector<std::uint8_t>& out, std::uint64_t word) {
  for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
}

void putChunk(std::vector<std::uint8_t>& out, std::uint32_t type, std::span<const std::uint8_t> data,
              std::uint8_t pad) {
  const std::uint64_t padded = (data.size() + 3) / 4 * 4;
  putWord(out, padded);
  putWord(out, type);
  out.insert(out.end(), data.begin(), data.end());
  out.insert(out.end(), padded - data.size(), pad);
}

void takeChunk(GlbChunks& chunks, std::uint32_t type, std::span<const std::uint8_t> data, bool first,
               const Place& file) {
  if (first != (type == kJson)) {
    file.fail(first ? "the first chunk of the GLB file is not JSON" : "the GLB file has two JSON chunks");
  }
  if (type == kJson) {
    if (data.empty()) file.fail("the JSON chunk of the GLB file is empty");
    chunks.json = std::string_view(reinterpret_cast<const char*>(data.data()), data.size());
  } else if (type == kBin) {
    if (chunks.hasBin) file.fail("the GLB file has two BIN chunks");
    chunks.hasBin = true;
    chunks.bin = data;
  }
}

}  // namespace

bool isGlb(std::span<const std::uint8_t> bytes) { return bytes.size() >= 4 && readWord(bytes, 0) == kMagic; }

GlbChunks parseGlb(std::span<const std::uint8_t> bytes, const Place& file) {
  if (!isGlb(bytes)) file.fail("is not a GLB file");
  if (bytes.size() < 12) file.fail("the GLB header is cut short");
  if (readWord(bytes, 4) != 2) {
    file.fail("is GLB of version " + std::to_string(readWord(bytes, 4)) + "; export it as glTF 2.0");
  }
  const std::size_t length = readWord(bytes, 8);
  if (length > bytes.size()) {
    file.fail("has " + std::to_string(bytes.size()) + " bytes of the " + std::to_string(length) +
              " that its header declares; it was cut short");
  }
  GlbChunks chunks;
  std::size_t at = 12;
  while (at < length) {
    if (length - at < 8) file.fail("a chunk header of the GLB file is cut short");
    const std::size_t size = readWord(bytes, at);
    if (size % 4 != 0) file.fail("a chunk of the GLB file is not a multiple of 4 bytes long");
    if (size > length - at - 8) file.fail("a chunk of the GLB file is longer than the file");
    takeChunk(chunks, readWord(bytes, at + 4), bytes.subspan(at + 8, size), at == 12, file);
    at += 8 + size;
  }
  if (chunks.json.empty()) file.fail("the GLB file has no JSON chunk");
  return chunks;
}

std::vector<std::uint8_t> packGlb(const std::string& json, std::span<const std::uint8_t> bin) {
  const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  const std::uint64_t length = 12 + 8 + padded(json.size()) + (bin.empty() ? 0 : 8 + padded(bin.size()));
  if (length > 0xffffffffu)
    throw Error(ExitCode::failed, "the scene takes more than the 4 GiB that a GLB file can hold");
  std::vector<std::uint8_t> out;
  out.reserve(length);
  putWord(out, kMagic);
  putWord(out, 2);
  putWord(out, length);
  putChunk(out, kJson, {reinterpret_cast<const std::uint8_t*>(json.data()), json.size()}, ' ');
  if (!bin.empty()) putChunk(out, kBin, bin, 0);
  return out;
}

}  // namespace lucarne
