#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/files.h"

namespace lucarne {
namespace {

namespace fs = std::filesystem;

/// A folder that is removed with all its contents when the scope ends.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const fs::path& target) : path_(temporarySibling(target)) {
    while (::mkdir(path_.c_str(), 0777) != 0) {
      if (errno != EEXIST) throwSystemError("write", target, errno);
      path_ = temporarySibling(target);
    }
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void syncTree(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_symlink() && (entry.is_regular_file() || entry.is_directory())) syncToDisk(entry.path());
  }
  syncToDisk(folder);
}

/// True when something is at `target` that may be replaced, false when nothing is there.
bool replaces(const fs::path& target, const fs::path& path, const std::function<bool(const fs::path&)>& mayReplace) {
  if (!fs::exists(fs::symlink_status(target))) return false;
  if (fs::is_directory(target) && mayReplace(target)) return true;
  throw Error(ExitCode::failed, "will not replace " + path.string() +
                                    ": something else than earlier output is there; remove it or name another");
}

/// Both names exist afterwards with their contents exchanged, or (where the file system cannot exchange) after a moment
/// in which `target` was missing.
void exchange(const fs::path& fresh, const fs::path& target) {
  if (::renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) throwSystemError("replace", target, errno);
  const fs::path aside = temporarySibling(target);
  if (::rename(target.c_str(), aside.c_str()) != 0) throwSystemError("replace", target, errno);
  if (::rename(fresh.c_str(), target.c_str()) != 0) {
    const int code = errno;
    if (::rename(aside.c_str(), target.c_str()) != 0) throwSystemError("put back", target, errno);
    throwSystemError("replace", target, code);
  }
  if (::rename(aside.c_str(), fresh.c_str()) != 0) throwSystemError("remove", aside, errno);
}

}  // namespace

void writeFolderAtomically(const fs::path& path, const std::function<bool(const fs::path&)>& mayReplace,
                           const std::function<void(const fs::path&)>& fill) {
  const fs::path target = resolveTarget(path);
  replaces(target, path, mayReplace);  // refuse before the work, not only after it
  const TemporaryFolder temporary(target);
  fill(temporary.path());
  try {
    syncTree(temporary.path());
    if (replaces(target, path, mayReplace)) {
      exchange(temporary.path(), target);  // the old contents go with the temporary folder
    } else if (::rename(temporary.path().c_str(), target.c_str()) != 0) {
      throwSystemError("write", path, errno);
    }
  } catch (const fs::filesystem_error& error) {
    throwSystemError("write", path, error.code().value());
  }
  syncToDisk(target.parent_path());
}

}  // namespace lucarne
