#include "app/bake_ranks.h"

#include <algorithm>

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

int threadsOfRank(const MpiJob& mpi, const BakeOptions& options) {
  if (options.threads > 0) return options.threads;
  const int usable = threadCount();
  return usable < machineThreadCount() ? usable : std::max(1, usable / mpi.localSize());
}

void joinMakers(MpiJob& mpi, PartHeader& header) {
  const std::vector<std::string> all = mpi.gather(toJson(header).dump());
  mpi.agree([&] {
    for (std::size_t rank = 1; rank < all.size(); ++rank) {
      const std::string name = "rank " + std::to_string(rank);
      const nlohmann::json json = nlohmann::json::parse(all[rank]), first = nlohmann::json::parse(all[0]);
      const PartHeader other = partHeaderFrom(JsonView(json, name)), root = partHeaderFrom(JsonView(first, "rank 0"));
      std::string what = difference(root.identity, other.identity, true);
      const std::string &build = root.makers.begin()->build, &otherBuild = other.makers.begin()->build;
      if (build != otherBuild) what = "build: " + build + " and " + otherBuild;
      if (!what.empty()) throw Error(ExitCode::failed, "ranks 0 and " + std::to_string(rank) + " differ in " + what + "; start one program on all");
      header.makers.insert(other.makers.begin(), other.makers.end());
      header.makers.insert(root.makers.begin(), root.makers.end());
    }
  });
  if (const std::string warning = makersWarning(header.makers); !warning.empty()) logWarning(warning);
}

}  // namespace lucarne
