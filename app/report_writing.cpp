#include "app/report_writing.h"

#include <algorithm>

#include "app/report_page.h"
#include "app/report_scene.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"

namespace lucarne {
namespace {

/// Seconds for pictures of cameras: little beside a bake, and never very long.
double secondsForPictures(const nlohmann::json& report) {
  constexpr double kLeast = 3, kMost = 120, kShare = 0.02;
  return std::clamp(kShare * report.value("seconds", 0.0), kLeast, kMost);
}

/// The light maps that were just written; nothing, with a warning, where memory or file does not allow.
std::optional<Dlm> writtenMaps(const BakeOptions& options) {
  if (writesPart(options) || !holdsLightMaps(options.output)) return std::nullopt;
  try {
    return readDlm(options.output);
  } catch (const Error& error) {
    logWarning(std::string("the report has no pictures of the light maps: ") + error.what());
  } catch (const std::bad_alloc&) {
    logWarning("the report has no pictures of the light maps: too little memory");
  }
  return std::nullopt;
}

ReportPictures picturesOf(const ReportContext& context, const Dlm* dlm, const LightMaps* maps, double seconds) {
  try {
    const PhotonScene* scene = context.skyMissing ? nullptr : &context.scene;
    return reportPictures({context.options, scene, dlm, maps, seconds}, context.player);
  } catch (const Error& error) {
    return {{}, {}, {std::string("no pictures: ") + error.what()}};
  } catch (const std::bad_alloc&) {
    return {{}, {}, {"no pictures: too little memory"}};
  }
}

}  // namespace

void checkReport(const std::filesystem::path& report) {
  const ReportFiles files = reportFiles(report);
  checkWritable(files.json);
  if (files.page) checkWritable(*files.page);
}

nlohmann::json writeReport(const ReportContext& context, const PartHeader& header, const LightMaps* maps,
                           nlohmann::json report) {
  if (!context.options.report) return report;
  const ReportFiles files = reportFiles(*context.options.report);
  std::optional<Dlm> dlm;
  if (files.page) dlm = writtenMaps(context.options);
  if (dlm) maps = &dlm->maps;
  addSceneToReport({context.options, context.scene, context.plan}, context.skyMissing, maps, report);
  addMakersToReport(context.options, header, report);
  writeFileAtomically(files.json, dumpJson(report));
  if (files.page)
    writeFileAtomically(
        *files.page, reportPage(report, picturesOf(context, dlm ? &*dlm : nullptr, maps, secondsForPictures(report))));
  return report;
}

}  // namespace lucarne
