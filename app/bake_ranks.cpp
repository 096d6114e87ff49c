#include "app/bake_ranks.h"

#include <algorithm>

#include "app/bake_environment.h"
#include "base/log.h"
#include "base/system.h"
#include "distributed/merge.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne {

void shareScene(MpiJob& mpi, PackedScene& packed) {
  mpi.broadcast(packed.glb);
  mpi.agree([&] {
    if (mpi.rank() != 0) packed.scene = readGlb(packed.glb, "the scene");
  });
}

void shareSky(MpiJob& mpi, ImageRgb& sky) {
  std::vector<std::uint8_t> bytes = packSky(sky);
  mpi.broadcast(bytes);
  mpi.agree([&] {
    if (mpi.rank() != 0) sky = unpackSky(bytes);
  });
}

int threadsOfRank(const MpiJob& mpi, const BakeOptions& options) {
  if (options.threads > 0) return options.threads;
  const int usable = threadCount();
  return usable < machineThreadCount() ? usable : std::max(1, usable / mpi.localSize());
}

namespace {

PartHeader headerFrom(const std::string& text, const std::string& name) {
  const nlohmann::json json = nlohmann::json::parse(text);
  return partHeaderFrom(JsonView(json, name));
}

/// What two ranks differ in that makes their photons those of two bakes; empty where they agree.
std::string difference(const PartHeader& a, const PartHeader& b) {
  const std::string &buildA = a.makers.begin()->build, &buildB = b.makers.begin()->build;
  return buildA != buildB ? "build: " + buildA + " and " + buildB : lucarne::difference(a.identity, b.identity);
}

}  // namespace

void joinMakers(MpiJob& mpi, PartHeader& header) {
  const std::vector<std::string> all = mpi.gather(toJson(header).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  mpi.agree([&] {
    const PartHeader root = headerFrom(all[0], "rank 0");
    for (std::size_t rank = 0; rank < all.size(); ++rank) {
      const PartHeader other = headerFrom(all[rank], "rank " + std::to_string(rank));
      const std::string what = difference(root, other);
      if (!what.empty())
        throw Error(ExitCode::failed,
                    "ranks 0 and " + std::to_string(rank) + " differ in " + what + "; start one program on all");
      header.makers.insert(other.makers.begin(), other.makers.end());
    }
  });
  if (const std::string warning = makersWarning(header.makers); !warning.empty()) logWarning(warning);
}

}  // namespace lucarne
