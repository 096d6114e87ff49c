// Which program this is.
#pragma once

#include <string>

namespace lucarne {

/// "lucarne 0.1.0 1a2b3c4d, GNU 12.2.0, Release": version, hash of the sources that photons and tallies depend on,
/// compiler, kind of build. Programs of one name trace alike on one processor.
const std::string& buildName();

}  // namespace lucarne
