// Tells when a folder has been replaced, or its manifest.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

namespace lucarne {

class FolderWatch {
 public:
  explicit FolderWatch(const std::filesystem::path& folder) : folder_(folder), seen_(look()), last_(seen_) {}

  /// To be asked now and then: true once for each change, as soon as two looks in a row see the same, so that what is
  /// being written is not read. A folder that is gone is no change; one that comes back is.
  bool changed();
  /// What is there now is known.
  void forget() { seen_ = last_ = look(); }

 private:
  using Signature = std::array<std::int64_t, 6>;  // device, file number, and time of the folder and of its manifest
  Signature look() const;

  std::filesystem::path folder_;
  Signature seen_, last_;
};

}  // namespace lucarne
