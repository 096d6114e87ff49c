#include <chrono>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/log.h"
#include "cli/commands.h"
#include "distributed/mpi_job.h"

namespace {

int fail(lucarne::ExitCode code, const std::string& message) {
  // What goes wrong before MPI starts goes wrong on every rank alike. One of them tells it; the others wait for that, since
  // the launcher kills all when the first one ends.
  if (lucarne::launchedRank() > 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  else
    std::fprintf(stderr, "lucarne: %s\n", message.c_str());
  return static_cast<int>(code);
}

/// CLI11 takes an unknown first word for a missing command; name it instead.
void checkCommand(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::string all;
  for (const CLI::App* cmd : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (cmd->get_name() == argv[1]) return;
    all += (all.empty() ? "" : ", ") + cmd->get_name();
  }
  throw lucarne::UsageError("no command '" + std::string(argv[1]) + "'; there are " + all);
}

int run(int argc, char** argv) {
  CLI::App app("Lucarne bakes the global illumination of a glTF scene into directional light maps and shows it.", "lucarne");
  app.set_version_flag("--version", "lucarne " LUCARNE_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.footer("Exit codes: 0 done, 1 failed, 2 wrong usage, 3 bad input file, 4 merge refused, 5 out of memory or disk,\n"
             "130 interrupted. `lucarne COMMAND --help` lists a command's options.");
  lucarne::Action action;
  lucarne::addBake(app, action);
  lucarne::addMerge(app, action);
  lucarne::addCheck(app, action);
  lucarne::addInfo(app, action);
  lucarne::addProbe(app, action);
  lucarne::addCompare(app, action);
#ifdef LUCARNE_HAS_PLAYER
  lucarne::addRender(app, action);
  lucarne::addPlay(app, action);
#endif
  checkCommand(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {  // --help, --version
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return fail(lucarne::ExitCode::usage, std::string(e.what()) + "; see lucarne --help");
  }
  action();
  return static_cast<int>(lucarne::ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    lucarne::setUpLogging();
    return run(argc, argv);
  } catch (const lucarne::Error& e) {
    return fail(e.code(), e.what());
  } catch (const std::bad_alloc&) {
    return fail(lucarne::ExitCode::outOfResource, "out of memory");
  } catch (const std::exception& e) {
    return fail(lucarne::ExitCode::failed, std::string("internal error: ") + e.what());
  }
}
