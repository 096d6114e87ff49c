// The bake in memory: a scene in, light maps out, no files. What programs that embed the libraries call.
#pragma once

#include <functional>

#include "app/bake_contacts.h"
#include "app/bake_plan.h"
#include "distributed/part_header.h"
#include "distributed/photon_run.h"
#include "dlm/atlas.h"
#include "dlm/drop_maps.h"
#include "dlm/light_maps.h"
#include "dlm/resolve.h"
#include "dlm/seam_fit.h"

namespace lucarne {

struct Baked {
  Ledger ledger;
  DirectPart direct;                   // nothing where direct light is not gathered
  double seconds = 0;                  // of tracing
  double emittedFlux = 0;              // lm, mean over channels: the scale of the ledger and the tallies
  SharedContacts contacts;  // that the maps were made with, by side
  LightMaps maps;
  SeamReport seams;
  KernelBias kernelBias;  // of adaptive kernels
  DroppedMaps dropped;
  AtlasUv uv;           // into maps' irradiance atlas
  Hash128 contentHash;  // of the tallies
};

/// Gathers direct light where the options say so, traces options.photons photons and resolves them. `progress` as in
/// runPhotons; stopping early gives a whole, noisier result.
Baked bakeScene(const PhotonScene& scene, const BakePlan& plan, const BakeOptions& options,
                const std::function<bool(const RunProgress&)>& progress);

/// Maps of the tallies that `header` is of (no photons, no samples: black): what resolving, the layout and the kernel
/// of `options` decide. Fills in all but the seconds. `contacts`: where they are known already, with
/// this kernel.
Baked resolveBake(const Scene& scene, const BakePlan& plan, const BakeOptions& options, const PartHeader& header,
                  const Tallies& tallies, SharedContacts contacts = nullptr);

/// Where the options leave it to the scene: how many directions.
void settleDirections(const Scene& scene, BakeOptions& options);

/// Gives the scene its emission guides, where the options want them and a pilot finds them worth it, and the options
/// the hashes of what photons depend on. Takes the threads of the options.
void prepareEmission(PhotonScene& scene, BakeOptions& options);

/// What tracing needs to know of the options.
PhotonRunOptions runOptions(const BakeOptions& options);

/// As typed, or all of the machine's.
int threadCount(const BakeOptions& options);

}  // namespace lucarne
