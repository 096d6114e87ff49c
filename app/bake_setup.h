// A bake that is ready to trace.
#pragma once

#include <chrono>

#include "app/bake_contacts.h"
#include "app/bake_plan.h"
#include "app/report_pictures.h"
#include "distributed/job_control.h"
#include "distributed/mpi_job.h"
#include "tracer/scene/gltf_packer.h"
#include "tracer/transport/photon_scene.h"

namespace lucarne {

/// All of it must outlive this.
struct BakeSetup {
  MpiJob* mpi;  // null: this process alone
  const BakeOptions& options;
  const PackedScene& packed;
  const PhotonScene& scene;
  const BakePlan& plan;
  const JobControl& control;
  const PlayerPictures& player;  // of the report's page
  BakeContacts& contacts;
  std::chrono::steady_clock::time_point start;  // of this run

  bool root() const { return mpi == nullptr || mpi->rank() == 0; }
};

}  // namespace lucarne
