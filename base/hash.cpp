#include "base/hash.h"

#include <bit>
#include <new>

#define XXH_STATIC_LINKING_ONLY  // the size of the streaming state, so that it can be a member
#include <xxhash.h>

namespace lucarne {

static_assert(std::endian::native == std::endian::little, "numbers are hashed as little-endian bytes");

struct Hasher::State {
  XXH3_state_t xxh;
};

std::string Hash128::hex() const {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint64_t half : {hi, lo}) {
    for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[half >> shift & 15];
  }
  return text;
}

std::optional<Hash128> Hash128::parse(std::string_view hex) {
  if (hex.size() != 32) return std::nullopt;
  std::uint64_t halves[2] = {0, 0};
  for (std::size_t i = 0; i < hex.size(); ++i) {
    const char c = hex[i];
    const bool isDigit = c >= '0' && c <= '9';
    if (!isDigit && !(c >= 'a' && c <= 'f')) return std::nullopt;
    halves[i / 16] = halves[i / 16] << 4 | static_cast<std::uint64_t>(isDigit ? c - '0' : c - 'a' + 10);
  }
  return Hash128{halves[0], halves[1]};
}

Hash128 hashBytes(std::span<const std::uint8_t> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.high64, hash.low64};
}

Hasher::Hasher() : state_(std::make_unique<State>()) { XXH3_128bits_reset(&state_->xxh); }
Hasher::~Hasher() = default;
Hasher::Hasher(Hasher&&) noexcept = default;
Hasher& Hasher::operator=(Hasher&&) noexcept = default;

void Hasher::add(std::span<const std::byte> bytes) {
  if (!bytes.empty()) XXH3_128bits_update(&state_->xxh, bytes.data(), bytes.size());
}

void Hasher::addNumber(std::uint64_t number) { add(std::as_bytes(std::span(&number, 1))); }

void Hasher::addText(std::string_view text) {
  addNumber(text.size());
  add(std::as_bytes(std::span(text)));
}

Hash128 Hasher::finish() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(&state_->xxh);
  return {hash.high64, hash.low64};
}

}  // namespace lucarne
