// JSON in and out: hostile text in, stable text out.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace lucarne {

/// Two spaces of indentation, keys in order, a newline at the end; the same value gives the same text. std::logic_error
/// for a number that is not finite, naming its place. Text that is not UTF-8 (a file name may be anything) gets U+FFFD.
std::string dumpJson(const nlohmann::json& value);

inline constexpr std::size_t kMaxJsonBytes = std::size_t{256} << 20;
inline constexpr int kMaxJsonDepth = 128;

/// InputError with `name`, line and column on bad syntax, and for text that is too long or too deeply nested.
nlohmann::json parseJson(std::span<const std::uint8_t> bytes, const std::string& name);

/// A place in a document that was read. Every getter throws InputError naming the file and the place when what is there
/// is missing or of another type: "a.json: settings.seed must be a whole number".
class JsonView {
 public:
  /// `root` must outlive the view; `file` is for the messages.
  JsonView(const nlohmann::json& root, std::string file) : JsonView(root, std::move(file), "") {}

  bool has(const std::string& key) const;
  JsonView at(const std::string& key) const;
  JsonView at(std::size_t index) const;
  /// Of an array.
  std::size_t size() const;

  double number() const;
  std::int64_t integer(std::int64_t lowest, std::int64_t highest) const;
  std::uint64_t count() const;
  bool flag() const;
  std::string text() const;
  /// An array of exactly `size` numbers.
  std::vector<double> numbers(std::size_t size) const;

  const nlohmann::json& json() const { return value_; }
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  JsonView(const nlohmann::json& value, std::string file, std::string place)
      : value_(value), file_(std::move(file)), place_(std::move(place)) {}

  const nlohmann::json& value_;
  std::string file_, place_;
};

}  // namespace lucarne
