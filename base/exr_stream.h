// The file streams that OpenEXR reads from and writes to.
#pragma once

#include <OpenEXR/ImfIO.h>

#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/input_file.h"

namespace lucarne {

/// The library's text about a failure, without the file's name (our own text has it), line ends and the last full stop.
std::string exrReason(const std::exception& error, const std::string& name);

/// Throws Iex::InputExc at the end of the file.
class ExrInputStream final : public OPENEXR_IMF_NAMESPACE::IStream {
 public:
  explicit ExrInputStream(const InputFile& file);
  bool read(char into[], int count) override;
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }
  void clear() override {}

 private:
  const InputFile& file_;
  std::uint64_t position_ = 0;
  std::uint64_t bufferStart_ = 0;
  std::vector<char> buffer_;
};

/// OpenEXR writes its tables of offsets in a destructor and swallows what goes wrong there; the first failure is kept
/// here.
class ExrOutputStream final : public OPENEXR_IMF_NAMESPACE::OStream {
 public:
  explicit ExrOutputStream(AtomicFile& file, const std::string& name) : OStream(name.c_str()), file_(file) {}
  void write(const char bytes[], int count) override;
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override;
  /// To be called when the writer is gone.
  void rethrowFailure() const;

 private:
  AtomicFile& file_;
  std::exception_ptr failure_;
};

}  // namespace lucarne
