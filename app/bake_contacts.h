// The contacts of a scene's charts (dlm/texel_contacts.h), which cost some rays a texel: found once, when first asked for.
#pragma once

#include <memory>
#include <vector>

#include "app/bake_plan.h"
#include "dlm/texel_contacts.h"
#include "tracer/transport/ray_caster.h"

namespace lucarne {

/// By side of the tallies.
using SharedContacts = std::shared_ptr<const std::vector<SideContacts>>;

/// Takes the threads of the options.
SharedContacts findContacts(const Scene& scene, const BakePlan& plan, const BakeOptions& options, const RayCaster& caster);

class BakeContacts {
 public:
  /// All must outlive this.
  BakeContacts(const Scene& scene, const BakePlan& plan, const BakeOptions& options, const RayCaster& caster)
      : scene_(scene), plan_(plan), options_(options), caster_(caster) {}

  /// One thread at a time.
  const SharedContacts& get() {
    if (!found_) found_ = findContacts(scene_, plan_, options_, caster_);
    return found_;
  }

 private:
  const Scene& scene_;
  const BakePlan& plan_;
  const BakeOptions& options_;
  const RayCaster& caster_;
  SharedContacts found_;
};

}  // namespace lucarne
