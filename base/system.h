// The machine, as reports name it.
#pragma once

#include <cstdint>
#include <string>

namespace lucarne {

/// Hardware threads that this process may use (a launcher may have bound it to some of them); at least 1.
int threadCount();
/// Hardware threads of the machine.
int machineThreadCount();
/// "AMD EPYC 7B13", or "unknown processor".
std::string cpuName();

/// What a report says about where it ran. No names of hosts or users.
struct HostDescription {
  std::string cpu, system;  // system: "Linux x86_64"
  int threads = 1;
  std::uint64_t memoryBytes = 0;
};
HostDescription describeHost();

}  // namespace lucarne
