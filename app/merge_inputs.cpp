#include <algorithm>
#include <sstream>

#include "app/merge.h"
#include "base/error.h"
#include "base/files.h"

namespace lucarne {
namespace {

namespace fs = std::filesystem;

void addFolder(const fs::path& folder, std::vector<fs::path>& files) {
  std::vector<fs::path> found;
  std::error_code error, none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".part" && !entry.is_directory(none)) found.push_back(entry.path());
  if (error) throw InputError("cannot read " + folder.string() + ": " + error.message());
  if (found.empty()) throw InputError(folder.string() + " holds no .part files");
  std::sort(found.begin(), found.end());
  files.insert(files.end(), found.begin(), found.end());
}

void addInput(const std::string& input, std::vector<fs::path>& files);

/// A path a line, from where the list lies; empty lines and those that begin with # are passed over.
void addList(const fs::path& list, std::vector<fs::path>& files) {
  const std::vector<std::uint8_t> bytes = readFile(list);
  std::istringstream lines(std::string(bytes.begin(), bytes.end()));
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with('\r')) line.pop_back();
    if (std::any_of(line.begin(), line.end(), [](unsigned char c) { return c < 32; })) {
      throw InputError(list.string() + " is not a list of paths, one a line");
    }
    if (line.empty() || line.starts_with('#')) continue;
    if (line.starts_with('@')) throw InputError(list.string() + ": a list may not name a list: " + line);
    try {
      addInput((list.parent_path() / line).string(), files);
    } catch (const InputError& error) {
      throw InputError(list.string() + ": " + error.what());
    }
  }
}

void addInput(const std::string& input, std::vector<fs::path>& files) {
  if (input.starts_with('@')) return addList(input.substr(1), files);
  std::error_code error;
  const fs::file_status status = fs::status(input, error);
  if (status.type() == fs::file_type::not_found) throw InputError("'" + input + "': no such file or folder");
  if (error) throw InputError("cannot read " + input + ": " + error.message());
  if (status.type() != fs::file_type::directory) {
    files.emplace_back(input);
  } else if (holdsLightMaps(input)) {
    throw InputError(input + " is a folder of finished light maps, which cannot be merged; merge the .part files");
  } else {
    addFolder(input, files);
  }
}

}  // namespace

std::vector<fs::path> partFiles(const std::vector<std::string>& inputs) {
  std::vector<fs::path> files;
  for (const std::string& input : inputs) addInput(input, files);
  return files;
}

}  // namespace lucarne
