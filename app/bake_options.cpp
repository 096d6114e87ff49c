#include "app/bake_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/units.h"
#include "dlm/direct_gather.h"

namespace lucarne {

namespace {

void checkStopRules(const BakeOptions& o) {
  if (o.timeLimit && !(*o.timeLimit > 0 && std::isfinite(*o.timeLimit))) throw UsageError("--time must be more than 0 s");
  if (!(o.targetError >= 0 && o.targetError < 1)) throw UsageError("--target-error must be more than 0 and less than 100 %");
  if (o.targetError == 0 && !o.timeLimit) return;
  if (!tracesPhotons(o)) throw UsageError("--time and --target-error end the tracing of photons, and all light is gathered here: choose --direct-samples");
  if (o.targetError > 0 && (o.part || o.photonRange)) throw UsageError("--target-error is judged on the whole bake: it cannot be given with --part or --photon-range");
  if (o.part && o.photons == kUnlimitedPhotons) throw UsageError("--part cuts a known number of photons: give --photons, too");
}

void checkPiece(const BakeOptions& o) {
  if (o.part && o.photonRange) throw UsageError("--part and --photon-range cannot be given together");
  if (o.part && (o.part->n < 1 || o.part->k < 1 || o.part->k > o.part->n)) throw UsageError("--part must be K/N with K from 1 to N");
  if (o.part && o.part->n > kMostParts) throw UsageError("--part: at most " + formatExactCount(kMostParts) + " parts");
  if (!o.photonRange) return;
  if (o.photonRange->begin >= o.photonRange->end) throw UsageError("--photon-range must be A:B with A below B");
  if (o.photonRange->end > o.photons) {
    throw UsageError("--photon-range ends at " + formatExactCount(o.photonRange->end) + ", beyond --photons " + formatExactCount(o.photons));
  }
}

}  // namespace

void checkSettings(const BakeOptions& o) {
  if (o.photons == 0) throw UsageError("--photons must be at least 1");
  if (o.directions < 1 || o.directions > 4096) throw UsageError("--directions must be 1 to 4096");
  if (!(o.texelsPerMetre > 0) || !std::isfinite(o.texelsPerMetre)) throw UsageError("--density must be a positive number of texels per metre");
  if (o.texelBudget == 0) throw UsageError("--texels must be at least 1");
  if (o.directSamples == 0 || o.directSamples > kMostDirectSamples)
    throw UsageError("--direct-samples must be 1 to " + formatExactCount(kMostDirectSamples));
  if (!(o.environmentScale >= 0 && o.environmentScale <= 1e12)) throw UsageError("--environment-scale must be 0 to 1e12");
  if (!std::isfinite(o.environmentTurn)) throw UsageError("--environment-turn must be a number of degrees");
  if (!(o.kernel.width >= 0.5 && o.kernel.width <= 16)) throw UsageError("--kernel-width must be 0.5 to 16 texels");
  if (!(o.dropError >= 0 && o.dropError < 1)) throw UsageError("--drop-error must be 0 to below 100%");
}

void checkFormat(const DlmFormat& format) {
  if (!(format.kMax >= 1 && format.kMax <= 1e6)) throw UsageError("--kmax must be 1 to 1e6");
}

void checkMachine(const BakeOptions& o) {
  checkFormat(o.format);
  if (o.memoryBytes && *o.memoryBytes == 0) throw UsageError("--memory must be more than 0");
  if (o.threads < 0 || o.threads > 1024) throw UsageError("--threads must be 0 (all) to 1024");
  // Embree passes over names that it does not know.
  constexpr std::array<std::string_view, 6> kSets = {"", "sse2", "sse4.2", "avx", "avx2", "avx512"};
  if (std::find(kSets.begin(), kSets.end(), o.isa) == kSets.end()) throw UsageError("--isa must be sse2, sse4.2, avx, avx2 or avx512, not '" + o.isa + "'");
}

void check(const BakeOptions& o) {
  checkSettings(o);
  checkMachine(o);
  if (o.output.empty()) throw UsageError("-o OUT.dlm is missing");
  if (!(o.checkpointSeconds >= 0) || !std::isfinite(o.checkpointSeconds)) throw UsageError("--checkpoint must be a time, or 0 for none");
  checkPiece(o);
  checkStopRules(o);
}

bool writesPart(const BakeOptions& o) { return o.part || o.photonRange || o.output.extension() == ".part"; }

std::filesystem::path partPath(const BakeOptions& o) { return std::filesystem::path(o.output).replace_extension(".part"); }

std::filesystem::path previewPath(const BakeOptions& o) {
  std::filesystem::path place = o.output;
  if (!place.has_filename()) place = place.parent_path();  // "room.dlm/"
  return place.replace_extension(".preview.dlm");
}

std::filesystem::path checkpointPath(const BakeOptions& o) {
  std::filesystem::path place = o.output;
  if (std::filesystem::is_symlink(place)) place = resolveTarget(place);
  return place.replace_extension(".checkpoint");
}

IndexRange photonsOf(const BakeOptions& o) {
  if (o.part) return shareOf(o.photons, o.part->k, o.part->n);
  return o.photonRange.value_or(IndexRange{0, o.photons});
}

bool gathersDirect(const BakeOptions& o) { return o.direct == DirectMode::gathered && o.light != LightPart::indirect; }

bool tracesPhotons(const BakeOptions& o) { return !gathersDirect(o) || o.light != LightPart::direct; }

IndexRange samplesOf(const BakeOptions& o) {
  if (!gathersDirect(o)) return {};
  const IndexRange photons = photonsOf(o);
  __extension__ typedef unsigned __int128 Wide;  // holds any product of two numbers of 64 bits
  const auto cut = [&](std::uint64_t i) {
    return static_cast<std::uint64_t>((Wide{o.directSamples} * i + o.photons - 1) / o.photons);
  };
  return {cut(photons.begin), cut(photons.end)};
}

TallyWishes tallyWishes(const BakeOptions& o) { return {o.keepAllDirections, o.moments}; }

Tallies::Sets tallySets(const BakeOptions& o) {
  return gathersDirect(o) ? Tallies::Sets::photonsAndDirect : Tallies::Sets::photons;
}

}  // namespace lucarne
