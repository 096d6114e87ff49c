#include "app/merge.h"

#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/log.h"
#include "base/units.h"
#include "cli/choices.h"
#include "cli/commands.h"
#include "cli/layout_options.h"
#include "cli/player_of_this_program.h"

namespace lucarne {
namespace {

void addOptions(CLI::App& cmd, MergeOptions& o, std::string& dropError) {
  cmd.add_option("PARTS", o.inputs, "parts, folders that hold .part files, or @LIST: a file with a path a line")
      ->required();
  cmd.add_option("-o,--output", o.output, "NAME.dlm: light maps; NAME.part: one part that holds them all");
  cmd.add_flag("--complete", o.complete,
               "refuse when photons of the bake are missing; else they are named in a warning");
  cmd.add_option("--kernel-width", o.kernelWidth, "distance in texels at which the kernel ends; not given: as baked");
  std::map<std::string, std::optional<KernelShape>> shapes;
  for (const auto& [name, shape] : kernelShapes()) shapes[name] = shape;
  addChoice<std::optional<KernelShape>>(cmd, "--kernel", o.kernel, shapes, "as baked", kKernelHelp);
  addSeams(cmd, o.seams, "as baked");
  cmd.add_option("--drop-error", dropError, kDropHelp)->default_str("as baked");
  addFormatOptions(cmd, o.format);
  cmd.add_option("--report", o.report, "write what happened to R.json and, of light maps, as a page to R.html");
  cmd.add_flag("--quiet", o.quiet, "print errors only");
}

void tell(const MergeOptions& o, const nlohmann::json& report) {
  logInfo((o.output ? "wrote " + o.output->string() : std::string("all is well")) + ": " +
          formatCount(report["parts"].get<std::uint64_t>()) + " parts, " +
          formatCount(report["photons"].get<std::uint64_t>()) + " photons, in " +
          formatDuration(report["merge_seconds"].get<double>()) +
          (report.contains("content_hash") ? ", content_hash " + report["content_hash"].get<std::string>() : ""));
}

}  // namespace

void addMerge(CLI::App& app, Action& action) {
  CLI::App* cmd = app.add_subcommand("merge", "add up the parts of a bake that was shared by several machines");
  const auto options = std::make_shared<MergeOptions>();
  const auto verify = std::make_shared<bool>(false);
  const auto dropError = std::make_shared<std::string>();
  addOptions(*cmd, *options, *dropError);
  cmd->add_flag("--verify", *verify, "only check that the parts are whole and belong together; writes nothing");
  cmd->callback([=, &action] {
    action = [=] {
      setQuiet(options->quiet);
      if (!dropError->empty()) options->dropError = parsePercentage("--drop-error", *dropError);
      if (*verify) options->output.reset();
      if (!*verify && !options->output) throw UsageError("-o NAME.dlm or NAME.part is missing (or --verify)");
      tell(*options, merge(*options, playerOfThisProgram()));
    };
  });
}

}  // namespace lucarne
