#include "app/bake_rescue.h"

#include <thread>

#include "base/error.h"
#include "base/log.h"
#include "base/units.h"

namespace lucarne {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kPatience(3600), kPause(10);

std::string photonsOf(const BakeState& state) { return formatCount(state.header.photons.count()) + " photons"; }

/// Parts that may hold the state, best place first.
std::vector<fs::path> placesOf(const BakeOptions& options) {
  fs::path output = options.output;
  if (!output.has_filename()) output = output.parent_path();
  const fs::path name = fs::path(output.filename()).replace_extension(".rescued.part");
  std::vector<fs::path> places = {output.parent_path() / name};
  std::error_code none;
  for (const fs::path& folder : {fs::current_path(none), fs::temp_directory_path(none)})
    if (!folder.empty()) places.push_back(folder / name);
  return places;
}

/// What to tell, or nothing when the state could be saved nowhere.
std::optional<std::string> tryPlaces(const BakeSetup& setup, const BakeState& state, CheckpointFolder& folder) {
  const BakeOptions& options = setup.options;
  if (options.checkpointSeconds > 0) {
    try {
      folder.save(state.header, setup.packed.glb, state.tallies);
      return howToGoOn(state, folder.path().string());
    } catch (const Error&) {
    }
  }
  for (const fs::path& place : placesOf(options)) {
    if (fs::exists(place)) continue;  // of an earlier night
    try {
      writePart(place, state.header, setup.packed.glb, state.tallies);
      return photonsOf(state) + " are saved as " + place.string() + ": when there is room, move it to " +
             partPath(options).string() + " and go on with the same command and --resume";
    } catch (const Error&) {
    }
  }
  return std::nullopt;
}

}  // namespace

std::string howToGoOn(const BakeState& state, const std::string& place) {
  return photonsOf(state) + " are saved in " + place + ": go on with the same command and --resume";
}

std::string rescueState(const BakeSetup& setup, const BakeState& state, CheckpointFolder& folder) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  bool told = false;
  for (;;) {
    if (const auto saved = tryPlaces(setup, state, folder)) return *saved;
    if (setup.control.stop() || std::chrono::steady_clock::now() >= end) break;
    if (!std::exchange(told, true))  // also with --quiet: only its reader can help
      logError("neither the result nor the state of " + photonsOf(state) +
               " can be written anywhere: trying again for an hour; make room, or end it with a signal");
    for (auto waited = kPause - kPause; waited < kPause && !setup.control.stop(); waited += std::chrono::seconds(1))
      std::this_thread::sleep_for(std::chrono::seconds(1));
  }
  return photonsOf(state) + " could be saved nowhere and are lost";
}

}  // namespace lucarne
