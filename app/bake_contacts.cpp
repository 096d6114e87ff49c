#include "app/bake_contacts.h"

#include <tbb/task_arena.h>

#include "app/bake_scene.h"
#include "dlm/kernel.h"

namespace lucarne {

SharedContacts findContacts(const Scene& scene, const BakePlan& plan, const BakeOptions& options, const RayCaster& caster) {
  return tbb::task_arena(threadCount(options)).execute([&] {
    return std::make_shared<const std::vector<SideContacts>>(
        findContacts(scene, plan.charts, plan.layout, plan.tallies, caster, makeKernel(options.kernel).radius));
  });
}

}  // namespace lucarne
