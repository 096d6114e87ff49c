// What the ranks of an MPI bake must agree on before they trace.
#pragma once

#include "app/bake_options.h"
#include "base/image_file.h"
#include "distributed/mpi_job.h"
#include "distributed/part_header.h"
#include "tracer/scene/gltf_packer.h"

namespace lucarne {

/// Rank 0's scene to all ranks, so that only it needs the file. Collective.
void shareScene(MpiJob& mpi, PackedScene& packed);

/// Rank 0's environment, or that there is none, to all ranks. Collective.
void shareSky(MpiJob& mpi, ImageRgb& sky);

/// Threads of this rank: as typed, else its share of the machine's, or all that it is bound to.
int threadsOfRank(const MpiJob& mpi, const BakeOptions& options);

/// Puts the makers of all ranks into the header. AgreedError when they run different programs or lay the scene out
/// differently; a warning when only their rays differ. Collective.
void joinMakers(MpiJob& mpi, PartHeader& header);

}  // namespace lucarne
