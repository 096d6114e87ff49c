#include "base/system.h"

#include <sys/utsname.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "base/memory.h"

namespace lucarne {

int threadCount() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

std::string cpuName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

HostDescription describeHost() {
  utsname names{};
  const bool known = ::uname(&names) == 0;
  const std::string system = known ? std::string(names.sysname) + " " + names.machine : "unknown system";
  return {cpuName(), system, threadCount(), totalMemoryBytes()};
}

}  // namespace lucarne
