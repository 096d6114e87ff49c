#include "base/files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/input_file.h"

namespace lucarne {

std::vector<std::uint8_t> readFile(const std::filesystem::path& path, std::uint64_t limit) {
  const InputFile file(path);
  if (file.size() > limit) {
    throw InputError("cannot read " + path.string() + ": it has " + std::to_string(file.size()) + " bytes, more than " +
                     std::to_string(limit));
  }
  std::vector<std::uint8_t> bytes(file.size());
  bytes.resize(file.read(0, bytes.data(), bytes.size()));
  return bytes;
}

void writeFileAtomically(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

void writeFileAtomically(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

void copyFileAtomically(const std::filesystem::path& from, const std::filesystem::path& to) {
  const InputFile source(from);
  AtomicFile target(to);
  std::vector<char> block(std::size_t{1} << 20);
  std::uint64_t offset = 0;
  while (const std::size_t n = source.read(offset, block.data(), block.size())) {
    target.write(block.data(), n);
    offset += n;
  }
  target.commit();
}

void checkWritable(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) {
    if (::access(path.c_str(), W_OK) != 0) throwSystemError("write", path, errno);
    return;
  }
  const std::filesystem::path target = resolveTarget(path);
  if (::stat(target.parent_path().c_str(), &status) != 0) {
    throw Error(ExitCode::failed, "cannot write " + path.string() + ": the folder " + target.parent_path().string() +
                                      " is not there; create it or name another");
  }
  // Permission bits do not tell about read-only mounts, quotas and network shares; making something does. A folder,
  // because both a file and a folder can be put where a folder can.
  const std::filesystem::path probe = temporarySibling(target);
  if (::mkdir(probe.c_str(), 0777) != 0) throwSystemError("write", path, errno);
  ::rmdir(probe.c_str());
}

}  // namespace lucarne
