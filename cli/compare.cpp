#include "app/compare.h"

#include <cstdio>
#include <memory>

#include "base/error.h"
#include "base/json.h"
#include "base/units.h"
#include "cli/commands.h"

namespace lucarne {
namespace {

struct Texts {
  std::string points = "100k", maxRelative;
};

void addOptions(CLI::App& cmd, CompareOptions& o, Texts& texts) {
  cmd.add_option("A", o.a,
                 "the reference: a .dlm, or a picture (.exr and .hdr are linear, .png and .jpg display codes)")
      ->required();
  cmd.add_option("B", o.b, "what is compared with it: of the same kind, pictures of the same size")->required();
  cmd.add_option("--picture", o.picture,
                 "of pictures: write the FLIP of every pixel as a PNG, black 0 to pale yellow 1");
  cmd.add_option("--points", texts.points,
                 "of light maps of different layouts: points on A's surfaces where both are asked")
      ->capture_default_str();
  cmd.add_option("--max-rmse", o.maxRmse,
                 "fail when the RMSE is above: lx of light maps, else in the values of the pictures")
      ->check(CLI::NonNegativeNumber);
  cmd.add_option("--max-relative", texts.maxRelative,
                 "fail when the sum of differences is above that share of A's sum, \"2%\"");
  cmd.add_option("--max-flip", o.maxFlip, "of pictures: fail when the mean FLIP, 0 to 1, is above")
      ->check(CLI::NonNegativeNumber);
}

void run(CompareOptions& o, const Texts& texts, bool json) {
  o.points = parseCount("--points", texts.points);
  if (o.points == 0) throw UsageError("--points must be at least 1");
  if (!texts.maxRelative.empty()) o.maxRelative = parsePercentage("--max-relative", texts.maxRelative);
  const nlohmann::json compared = compare(o);
  std::fputs((json ? dumpJson(compared) : compareText(compared)).c_str(), stdout);
  std::string all;
  for (const std::string& one : exceededLimits(compared, o)) all += (all.empty() ? "" : ", ") + one;
  if (!all.empty()) throw Error(ExitCode::failed, o.a.string() + " and " + o.b.string() + " differ too much: " + all);
}

}  // namespace

void addCompare(CLI::App& app, Action& action) {
  CLI::App* cmd = app.add_subcommand("compare", "tell how much two pictures, or two sets of light maps, differ");
  cmd->footer("Ends with 0 however large the difference is, but with 1 where a --max is given and exceeded.");
  const auto options = std::make_shared<CompareOptions>();
  const auto texts = std::make_shared<Texts>();
  const auto json = std::make_shared<bool>(false);
  addOptions(*cmd, *options, *texts);
  cmd->add_flag("--json", *json, "as JSON, with every chart and direction");
  cmd->callback([=, &action] { action = [=] { run(*options, *texts, *json); }; });
}

}  // namespace lucarne
