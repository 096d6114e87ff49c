#include "player/folder_watch.h"

#include <sys/stat.h>

namespace lucarne {
namespace {

constexpr std::int64_t kGone = -1;

}  // namespace

FolderWatch::Signature FolderWatch::look() const {
  struct stat folder {
  }, manifest{};
  if (::stat(folder_.c_str(), &folder) != 0 || ::stat((folder_ / "manifest.json").c_str(), &manifest) != 0)
    return {kGone};
  return {static_cast<std::int64_t>(folder.st_dev),
          static_cast<std::int64_t>(folder.st_ino),
          static_cast<std::int64_t>(manifest.st_ino),
          manifest.st_mtim.tv_sec,
          manifest.st_mtim.tv_nsec,
          static_cast<std::int64_t>(manifest.st_size)};
}

bool FolderWatch::changed() {
  const Signature now = look();
  const bool settled = now == last_;
  last_ = now;
  if (!settled || now == seen_ || now[0] == kGone) return false;
  seen_ = now;
  return true;
}

}  // namespace lucarne
