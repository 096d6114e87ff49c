// The settings of a bake: one immutable struct, checked before work begins.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "dlm/deposit.h"
#include "dlm/dlm_writer.h"
#include "dlm/kernel.h"

namespace lucarne {

struct BakeOptions {
  std::optional<std::filesystem::path> scene;  // none: the built-in room
  std::filesystem::path output;                // NAME.dlm
  std::uint64_t photons = 20'000'000;
  int directions = 14;
  double texelsPerMetre = 16;
  std::uint64_t texelBudget = 1'000'000;
  bool keepAllDirections = false;
  KernelOptions kernel;
  std::uint64_t seed = 0;
  LightPart light = LightPart::all;
  int threads = 0;  // 0: all
  std::optional<std::filesystem::path> report;
  DlmFormat format;
  std::string isa;  // Embree's instruction set; empty: avx2 where the processor has it
  bool quiet = false;
};

/// UsageError naming the option that is out of range.
void check(const BakeOptions& options);

}  // namespace lucarne
