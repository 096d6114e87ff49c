// What the sections of a check are made from.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/bake_needs.h"
#include "app/bake_plan.h"
#include "tracer/transport/photon_scene.h"

namespace lucarne {

struct CheckInput {
  const BakeOptions& options;
  const PhotonScene& photonScene;
  const BakePlan& plan;
  std::uint64_t glbBytes = 0;   // of the packed scene
  double secondsOfSetup = 0;    // reading, charts, ray caster
  MemorySoFar memory{};         // the scene with all that is built on it, no tallies

  const Scene& scene() const { return photonScene.scene(); }
};

/// 'name' or (unnamed), cut where it is very long; control characters, which a terminal would obey, become question
/// marks.
std::string quotedName(const std::string& name);

/// Advice, in the order in which it was found. An id is stable; its text is for people.
class CheckWarnings {
 public:
  void add(const std::string& id, const std::string& text) { list_.push_back({{"id", id}, {"text", text}}); }
  const nlohmann::json& list() const { return list_; }

 private:
  nlohmann::json list_ = nlohmann::json::array();
};

}  // namespace lucarne
