// XXH3-128, the hash of contents, scenes and settings. For catching damage and telling things apart; not for secrets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

namespace lucarne {

struct Hash128 {
  std::uint64_t hi = 0, lo = 0;
  /// 32 lowercase digits, highest first: XXH128's canonical form, as `xxhsum -H2` prints it.
  std::string hex() const;
  /// The reverse of hex(); nothing for any other text.
  static std::optional<Hash128> parse(std::string_view hex);
  friend bool operator==(const Hash128&, const Hash128&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Hash128& hash) { return out << hash.hex(); }
};

Hash128 hashBytes(std::span<const std::uint8_t> bytes);

/// The same hash in pieces: how the bytes are cut does not matter. Numbers are hashed as they lie in memory,
/// little-endian.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(Hasher&&) noexcept;
  Hasher& operator=(Hasher&&) noexcept;

  void add(std::span<const std::byte> bytes);  // std::as_bytes of any numbers
  void add(std::span<const std::uint8_t> bytes) { add(std::as_bytes(bytes)); }
  void addNumber(std::uint64_t number);
  /// Its length first, so that ("ab", "c") and ("a", "bc") differ.
  void addText(std::string_view text);
  /// Of all that was added so far; more may follow.
  Hash128 finish() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lucarne
