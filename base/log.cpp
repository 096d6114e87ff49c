#include "base/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace lucarne {
namespace {

/// The text is an argument, never a format: file names may hold braces.
void log(spdlog::level::level_enum level, const std::string& text) {
  spdlog::default_logger_raw()->log(level, spdlog::string_view_t(text));
}

}  // namespace

void setUpLogging() {
  auto logger = std::make_shared<spdlog::logger>("lucarne", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%n: %v");
  logger->set_level(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

void setQuiet(bool quiet) { spdlog::set_level(quiet ? spdlog::level::err : spdlog::level::info); }

void logInfo(const std::string& text) { log(spdlog::level::info, text); }
void logWarning(const std::string& text) { log(spdlog::level::warn, "warning: " + text); }
void logError(const std::string& text) { log(spdlog::level::err, text); }

}  // namespace lucarne
