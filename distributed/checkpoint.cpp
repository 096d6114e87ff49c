#include "distributed/checkpoint.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/files.h"
#include "base/log.h"

namespace lucarne {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLock = "lock";
constexpr std::size_t kKept = 2;

/// The number of a state's file name, or nothing for other names.
std::optional<std::uint64_t> numberOf(const fs::path& file) {
  const std::string name = file.filename().string(), before = "state-", after = ".part";
  if (!name.starts_with(before) || !name.ends_with(after)) return std::nullopt;
  const std::string digits = name.substr(before.size(), name.size() - before.size() - after.size());
  const bool plain =
      !digits.empty() && digits.size() <= 18 && digits.find_first_not_of("0123456789") == std::string::npos;
  return plain ? std::optional(std::stoull(digits)) : std::nullopt;
}

/// True while the open file is the one that has this name.
bool isFile(int descriptor, const fs::path& path) {
  struct stat here {}, there {};
  return descriptor >= 0 && ::fstat(descriptor, &here) == 0 && ::stat(path.c_str(), &there) == 0 &&
         here.st_dev == there.st_dev && here.st_ino == there.st_ino;
}

std::string stateName(std::uint64_t number) {
  const std::string digits = std::to_string(number);
  return "state-" + std::string(6 - std::min<std::size_t>(6, digits.size()), '0') + digits + ".part";
}

}  // namespace

CheckpointFolder::~CheckpointFolder() {
  if (lock_ < 0) return;
  if (states().empty()) remove();  // a bake that failed before its first state leaves nothing
  ::close(lock_);
}

void CheckpointFolder::open() {
  const fs::path lock = folder_ / kLock;
  // Again when a bake that ended removed the folder between two of our steps: a lock that nobody can find locks nothing.
  do {
    if (lock_ >= 0) ::close(std::exchange(lock_, -1));
    if (::mkdir(folder_.c_str(), 0777) != 0 && errno != EEXIST) throwSystemError("write", folder_, errno);
    lock_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0 && errno == ENOENT) continue;
    if (lock_ < 0) throwSystemError("write", lock, errno);
    // Network file systems without locks say something else than EWOULDBLOCK; there the user has to take care.
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(std::exchange(lock_, -1));  // the folder is not ours
      throw Error(ExitCode::failed,
                  "another bake is writing to " + folder_.string() + "; wait for it, or name another output");
    }
  } while (!isFile(lock_, lock));
  removeLeftovers();
}

/// A killed writer's file has the name of the state that it was to become.
void CheckpointFolder::removeLeftovers() const {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored))
    if (entry.path().filename().string().starts_with(".state-")) fs::remove(entry.path(), ignored);
}

std::vector<fs::path> CheckpointFolder::states() const {
  std::vector<fs::path> found;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, none))
    if (numberOf(entry.path())) found.push_back(entry.path());
  std::sort(found.begin(), found.end(),
            [](const fs::path& a, const fs::path& b) { return *numberOf(a) > *numberOf(b); });
  return found;
}

std::optional<PartHeader> CheckpointFolder::load(
    Tallies& tallies, const std::function<void(const PartHeader&, const std::string& file)>& check) {
  for (const fs::path& file : states()) {
    try {
      const PartReader part(file);
      check(part.header(), file.string());
      addPart(part, tallies);
      return part.header();
    } catch (const PartError& error) {
      // Its mend, after the semicolon, is for parts that can be had again.
      const std::string what = error.what();
      logWarning(what.substr(0, what.find(';')) + "; going back to the state before it");
      tallies.clear();
    }
  }
  return std::nullopt;
}

std::optional<PartHeader> CheckpointFolder::peek() const {
  for (const fs::path& file : states()) {
    try {
      return PartReader(file).header();
    } catch (const InputError&) {
      continue;
    }
  }
  return std::nullopt;
}

void CheckpointFolder::write(const PartHeader& header, std::span<const std::uint8_t> scene,
                             const Tallies& tallies) const {
  const std::vector<fs::path> before = states();
  const std::uint64_t number = before.empty() ? 1 : *numberOf(before.front()) + 1;
  writePart(folder_ / stateName(number), header, scene, tallies);
  removeBut(kKept);
}

void CheckpointFolder::removeBut(std::size_t kept) const {
  const std::vector<fs::path> all = states();
  std::error_code ignored;
  for (std::size_t i = kept; i < all.size(); ++i) fs::remove(all[i], ignored);
}

std::uint64_t CheckpointFolder::bytes() const {
  std::uint64_t sum = 0;
  std::error_code none;
  for (const fs::path& file : states()) {
    const std::uintmax_t size = fs::file_size(file, none);
    if (!none) sum += size;
  }
  return sum;
}

void CheckpointFolder::save(const PartHeader& header, std::span<const std::uint8_t> scene, const Tallies& tallies) {
  if (!isFile(lock_, folder_ / kLock)) open();
  try {
    write(header, scene, tallies);
  } catch (const Error& error) {
    if (error.code() != ExitCode::outOfResource || states().size() < kKept) throw;
    keepNewest();
    write(header, scene, tallies);
  }
}

void CheckpointFolder::publish(const fs::path& target) {
  const std::vector<fs::path> found = states();
  LUCARNE_CHECK_EQ(found.empty(), false);
  const fs::path place = resolveTarget(target);
  if (::rename(found.front().c_str(), place.c_str()) == 0) {
    syncToDisk(place.parent_path());
  } else if (errno == EXDEV) {  // the target is a link to another disk
    copyFileAtomically(found.front(), target);
    fs::remove(found.front());
  } else {
    throwSystemError("write", target, errno);
  }
}

void CheckpointFolder::remove() {
  std::error_code ignored;
  removeLeftovers();
  for (const fs::path& file : states()) fs::remove(file, ignored);
  fs::remove(folder_ / kLock, ignored);
  fs::remove(folder_, ignored);  // fails, and should, when something else is in it
}

fs::path CheckpointFolder::moveAside() {
  const fs::path old = folder_.string() + ".old";
  std::error_code ignored;
  CheckpointFolder(old).remove();
  if (::rename(folder_.c_str(), old.c_str()) != 0) throwSystemError("move aside", folder_, errno);
  if (lock_ >= 0) ::close(lock_);
  lock_ = -1;
  return old;
}

}  // namespace lucarne
