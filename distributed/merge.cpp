#include "distributed/merge.h"

#include "base/error.h"
#include "distributed/photon_run.h"

namespace lucarne {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& what) { throw Error(ExitCode::mergeRefused, what); }

/// A part that cannot be used stops the merge, with the merge's exit code.
template <class F>
auto refusing(F&& f) {
  try {
    return f();
  } catch (const PartError& error) {
    refuse(error.what());
  }
}

/// What a header has of photons, or of samples of direct light.
const IndexSet& indicesOf(const PartHeader& h, bool samples) {
  static const IndexSet kNothing;
  return !samples ? h.photons : h.direct ? h.direct->samples : kNothing;
}

/// Refuses photons or samples that the last of some files shares with an earlier one, which is looked for.
[[noreturn]] void refuseTwice(const PartHeader& part, const std::vector<fs::path>& files, std::size_t last,
                              bool samples) {
  const std::string what = samples ? "samples of direct light" : "photons";
  for (std::size_t i = 0; i < last; ++i) {
    const IndexSet common = indicesOf(PartReader(files[i]).header(), samples).common(indicesOf(part, samples));
    if (common.empty()) continue;
    refuse(files[i].string() + " and " + files[last].string() + " both hold " + what + " " + toText(common) +
           "; merge each part once");
  }
  refuse(files[last].string() + " holds " + what + " that another part holds, too; merge each part once");
}

void checkAgainst(const PartHeader& whole, const PartHeader& part, const std::vector<fs::path>& files, std::size_t i,
                  const std::set<std::string>& chosen) {
  const std::string both = files[0].string() + " and " + files[i].string();
  if (const std::string what = difference(whole.identity, part.identity, chosen); !what.empty()) {
    const bool layout = what.starts_with("layout") || what.starts_with("emitted");
    refuse(both + " differ in " + what + "; " +
           (layout ? "they are of different versions of Lucarne (" + whole.makers.begin()->build + " and " +
                         part.makers.begin()->build + "): bake all parts with one"
                   : "only parts of one scene and one set of settings can be merged"));
  }
  if (whole.lightEntries != part.lightEntries || whole.texels != part.texels ||
      whole.momentEntries != part.momentEntries) {
    refuse(both + " differ in size of their tallies although they are of one layout; one of them was altered");
  }
  if (whole.direct.has_value() != part.direct.has_value())
    refuse(both + " differ in their sets of tallies although their settings agree; one of them was altered");
  for (const bool samples : {false, true})
    if (!indicesOf(whole, samples).common(indicesOf(part, samples)).empty()) refuseTwice(part, files, i, samples);
}

/// The part read again must be the one whose header was joined.
void checkUnchanged(const PartReader& part, const Hash128& content) {
  if (part.header().content != content)
    refuse(part.path().string() + " was exchanged while it was being merged; merge again");
}

template <class F>
void forParts(const PartSet& parts, const std::function<void(std::uint64_t)>& progress, F&& f) {
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < parts.files.size(); ++i) {
    refusing([&] {
      const PartReader part(parts.files[i]);
      checkUnchanged(part, parts.contents[i]);
      f(part, i == 0);
      bytes += part.header().tallyBytes() + part.header().sceneBytes;
    });
    progress(bytes);
  }
}

}  // namespace

PartSet joinParts(const std::vector<fs::path>& files, const std::set<std::string>& chosen) {
  if (files.empty()) throw UsageError("no parts to merge; name files, folders that hold .part files, or @LIST");
  PartSet parts;
  parts.files = files;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const PartHeader header = refusing([&] { return PartReader(files[i]).header(); });
    parts.contents.push_back(header.content);
    if (i == 0) {
      parts.whole = header;
      continue;
    }
    checkAgainst(parts.whole, header, files, i, chosen);
    parts.whole.add(header);
    try {
      checkTalliesFit(parts.whole.ledger.incident);
    } catch (const Error& error) {
      throw Error(error.code(), "with " + files[i].string() + ", " + error.what());
    }
  }
  return parts;
}

std::vector<std::uint8_t> sumParts(const PartSet& parts, Tallies& tallies,
                                   const std::function<void(std::uint64_t)>& progress) {
  std::vector<std::uint8_t> scene;
  forParts(parts, progress,
           [&](const PartReader& part, bool first) { addPart(part, tallies, first ? &scene : nullptr); });
  return scene;
}

void verifyParts(const PartSet& parts, const std::function<void(std::uint64_t)>& progress) {
  forParts(parts, progress, [](const PartReader& part, bool) { part.stream({}); });
}

std::string makersWarning(const std::set<Maker>& makers) {
  std::set<std::string> kinds;
  for (const Maker& m : makers) kinds.insert(m.probeRays.hex());
  if (kinds.size() < 2) return {};
  std::string text = "the parts come from " + std::to_string(kinds.size()) +
                     " kinds of programs or processors whose rays differ in rounding (";
  for (const std::string& kind : kinds) {
    for (const Maker& m : makers) {
      if (m.probeRays.hex() != kind) continue;
      text += (text.ends_with('(') ? "" : "; ") + m.build + " on " + m.processor + ", " + m.rayCaster;
      break;
    }
  }
  return text + "): the maps are as good as any, but no single machine would give the same bits";
}

}  // namespace lucarne
