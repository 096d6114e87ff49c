// Notes to the user. They go to stderr, because stdout belongs to results.
#pragma once

#include <string>

namespace lucarne {

/// To be called once, by main: makes the process's default logger one that writes "lucarne: …" lines to stderr.
void setUpLogging();
/// Quiet: errors only.
void setQuiet(bool quiet);

void logInfo(const std::string& text);
void logWarning(const std::string& text);
void logError(const std::string& text);

}  // namespace lucarne
