// The settings of a bake: one immutable struct, checked before work begins.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "distributed/part_header.h"
#include "dlm/deposit.h"
#include "dlm/direction_filter.h"
#include "dlm/dlm_writer.h"
#include "dlm/kernel.h"

namespace lucarne {

/// The name that stands for a scene which is no file.
inline constexpr const char* kBuiltinSceneName = "glossy_room.glb (built in)";

/// Piece k of n, from 1.
struct PartNumber {
  std::uint64_t k = 1, n = 1;
};

/// Who brings light that comes straight from lamps and sky: photons, or samples at every texel (direct_gather.h).
enum class DirectMode : std::uint8_t { photons, gathered };

/// Where charts come from: TEXCOORD_1 where it can be used and grown elsewhere, or all grown.
enum class ChartMode : std::uint8_t { automatic, grow };

/// What becomes of the jumps between charts that continue each other (seam_fit.h).
enum class SeamMode : std::uint8_t { fit, keep };

/// How a bake shows how far it is: a line for people, or JSON for programs.
enum class ProgressStyle : std::uint8_t { line, json };

/// `photons` of a bake that something else ends.
inline constexpr std::uint64_t kUnlimitedPhotons = std::uint64_t{1} << 60;

struct BakeOptions {
  std::optional<std::filesystem::path> scene;  // none: the built-in room
  std::filesystem::path output;                // NAME.dlm, or NAME.part
  std::uint64_t photons = 20'000'000;          // of the whole bake, at most
  std::optional<double> timeLimit;             // seconds: this run's, and what earlier ones traced
  double targetError = 0;                      // estimated relative error at which the bake ends; 0: none
  std::optional<PartNumber> part;              // bake one of n parts,
  std::optional<IndexRange> photonRange;       // or these photons; never both
  int directions = 14;
  bool chooseDirections = false;  // instead as many as the scene's surfaces can show (choose_directions.h)
  double texelsPerMetre = 16;
  std::uint64_t texelBudget = 1'000'000;
  ChartMode charts = ChartMode::automatic;
  bool keepAllDirections = false;
  DirectionFilter directionFilter = DirectionFilter::nearest;
  bool moments = false;  // mean directions beside the light of each cell (tally.h)
  KernelOptions kernel{KernelShape::adaptive, defaultKernelWidth(KernelShape::adaptive)};
  SeamMode seams = SeamMode::fit;
  double dropError = 0;  // maps of faint directions are left out under this bound (drop_maps.h)
  std::uint64_t seed = 0;
  SamplerKind sampler = SamplerKind::sobol;
  LightPart light = LightPart::all;
  DirectMode direct = DirectMode::photons;
  std::uint64_t directSamples = 64;                  // of the whole bake, a texel side
  std::optional<std::filesystem::path> environment;  // .exr or .hdr, equirectangular, cd/m²
  double environmentScale = 1;                       // times its values
  double environmentTurn = 0;                        // degrees about the vertical, counter-clockwise from above
  bool guidedEmission = true;                        // light from far away is aimed where a pilot found it useful
  // Not options: found while loading, since photons depend on them. Empty: none.
  std::string environmentHash, guideHash;
  int threads = 0;                 // of each process; 0: all
  std::optional<std::uint64_t> memoryBytes;  // that a process may take; none: what is free
  bool ownTallies = true;          // threads may have tallies of their own: not an option, off where memory is short
  int ranks = 1;                   // processes that bake together: as the MPI launcher says, not an option
  double checkpointSeconds = 300;  // 0: no states are saved
  bool resume = false;             // go on from a saved state where there is one
  bool keepPart = false;           // the tallies, too, as NAME.part
  std::optional<std::filesystem::path> report;
  std::optional<std::filesystem::path> plan;  // a plan file that the bake must be of (plan_file.h)
  DlmFormat format;
  std::string isa;  // Embree's instruction set; empty: avx2 where the processor has it
  bool quiet = false;
  ProgressStyle progress = ProgressStyle::line;
};

/// UsageError naming the option that is out of range.
void check(const BakeOptions& options);
/// Only those that decide what is baked, not where to.
void checkSettings(const BakeOptions& options);
void checkFormat(const DlmFormat& format);
/// Only those that decide how this machine works.
void checkMachine(const BakeOptions& options);

/// True when the output is a part.
bool writesPart(const BakeOptions& options);
/// NAME.part of NAME.dlm.
std::filesystem::path partPath(const BakeOptions& options);
/// NAME.preview.dlm of NAME.dlm.
std::filesystem::path previewPath(const BakeOptions& options);
/// NAME.checkpoint of NAME.dlm; beside what the name leads to when it is a link.
std::filesystem::path checkpointPath(const BakeOptions& options);
/// The photons of this piece of the bake.
IndexRange photonsOf(const BakeOptions& options);
/// True when direct light is gathered: asked for, and to be stored at all.
bool gathersDirect(const BakeOptions& options);
/// False when all light that is stored is gathered.
bool tracesPhotons(const BakeOptions& options);
/// The samples of this piece of the bake: as many of the whole as photons of theirs, cut where the photons are, so that
/// pieces that hold every photon once hold every sample once. Empty when nothing is gathered.
IndexRange samplesOf(const BakeOptions& options);
/// What is counted beyond the light that materials need.
TallyWishes tallyWishes(const BakeOptions& options);
/// The tallies of the options.
Tallies::Sets tallySets(const BakeOptions& options);

}  // namespace lucarne
