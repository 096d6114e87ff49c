#include "base/system.h"

#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "base/memory.h"

namespace lucarne {

int threadCount() {
  cpu_set_t usable;
  if (::sched_getaffinity(0, sizeof(usable), &usable) != 0) return machineThreadCount();  // more than a cpu_set_t holds
  return std::max(1, CPU_COUNT(&usable));
}

int machineThreadCount() { return std::max(1, static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN))); }

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
