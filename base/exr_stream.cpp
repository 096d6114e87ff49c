#include "base/exr_stream.h"

#include <OpenEXR/Iex.h>

#include <algorithm>
#include <cstring>

namespace lucarne {
namespace {
constexpr std::size_t kReadAhead = std::size_t{1} << 16;
}

std::string exrReason(const std::exception& error, const std::string& name) {
  std::string reason = error.what();
  const std::string quoted = "\"" + name + "\". ";
  if (const std::size_t at = reason.rfind(quoted); at != std::string::npos) reason.erase(0, at + quoted.size());
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  while (reason.ends_with('.') || reason.ends_with(' ')) reason.pop_back();
  return reason;
}

ExrInputStream::ExrInputStream(const InputFile& file) : IStream(file.path().c_str()), file_(file) {}

bool ExrInputStream::read(char into[], int count) {
  const std::size_t wanted = static_cast<std::size_t>(std::max(count, 0));
  if (position_ > file_.size() || wanted > file_.size() - position_) {
    throw IEX_NAMESPACE::InputExc("the file is cut short");
  }
  const bool buffered = position_ >= bufferStart_ && position_ + wanted <= bufferStart_ + buffer_.size();
  if (!buffered) {
    buffer_.resize(std::max(kReadAhead, wanted));
    bufferStart_ = position_;
    buffer_.resize(file_.read(position_, buffer_.data(), buffer_.size()));
    if (buffer_.size() < wanted) throw IEX_NAMESPACE::InputExc("the file is cut short");
  }
  if (wanted > 0) std::memcpy(into, buffer_.data() + (position_ - bufferStart_), wanted);
  position_ += wanted;
  return position_ < file_.size();
}

void ExrOutputStream::write(const char bytes[], int count) {
  if (failure_) std::rethrow_exception(failure_);
  try {
    file_.write(bytes, static_cast<std::size_t>(count));
  } catch (...) {
    failure_ = std::current_exception();
    throw;
  }
}

void ExrOutputStream::seekp(std::uint64_t position) {
  if (failure_) std::rethrow_exception(failure_);
  try {
    file_.seek(position);
  } catch (...) {
    failure_ = std::current_exception();
    throw;
  }
}

void ExrOutputStream::rethrowFailure() const {
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace lucarne
