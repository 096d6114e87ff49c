#include "tests/bench/bench_memory.h"

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <string>

#include "base/error.h"
#include "base/float_mode.h"
#include "dlm/deposit.h"
#include "tests/bench/bench_measure.h"
#include "tracer/transport/photon_tracer.h"

namespace lucarne::bench {
namespace {

/// "VmRSS" or "VmHWM" of this process, bytes.
std::uint64_t processMemory(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return 1024 * std::stoull(line.substr(name.size() + 1));
  return 0;
}

/// VmHWM starts again from VmRSS.
void forgetPeak() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// What is there of the scene before counts in `held` and `peak` by `sceneBytes`.
MemoryUse bakeAndCount(const Scene& scene) {
  constexpr std::uint64_t kPhotons = 100'000;
  MemoryUse use;
  malloc_trim(0);
  const std::uint64_t before = processMemory("VmRSS") - sceneBytes(scene);
  forgetPeak();
  const BakePlan plan = makeLargePlan(scene);
  auto photonScene = std::make_unique<PhotonScene>(scene);
  const TexelMap map(scene, plan.charts, plan.layout, plan.tallies);
  Tallies tallies(plan.tallies);
  tallies.clear();  // all of its pages are touched
  DepositSink<false> sink(map, plan.tallies, plan.directions, LightPart::all, tallies);
  Ledger ledger;
  const FlushDenormals mode;
  tracePhotons(*photonScene, {0, kPhotons}, 0, {}, sink, ledger);
  use.peak = processMemory("VmHWM") - before;
  malloc_trim(0);
  use.held = processMemory("VmRSS") - before;
  use.tallies = plan.tallies.bytes();
  use.embree = embreeBytes(std::move(photonScene));
  return use;
}

}  // namespace

MemoryUse measureMemory(const Scene& scene) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw Error(ExitCode::failed, "no pipe to a process of its own");
  const pid_t child = fork();
  if (child < 0) throw Error(ExitCode::failed, "no process of its own to measure memory in");
  if (child == 0) {
    const MemoryUse use = bakeAndCount(scene);
    _exit(write(ends[1], &use, sizeof use) == sizeof use ? 0 : 1);
  }
  close(ends[1]);
  MemoryUse use;
  const bool whole = read(ends[0], &use, sizeof use) == sizeof use;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  if (!whole) throw Error(ExitCode::failed, "measuring memory failed");
  return use;
}

}  // namespace lucarne::bench
