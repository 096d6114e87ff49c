# Run as a script: cmake -DSOURCE=folder -DOUTPUT=file.cpp -DVERSION=v -DBUILD=type -P SourceHash.cmake
# Writes a C++ source that names the build: its version and a hash of all sources that photons and tallies depend on.
file(GLOB_RECURSE files RELATIVE "${SOURCE}"
     "${SOURCE}/base/*.h" "${SOURCE}/base/*.cpp" "${SOURCE}/tracer/*.h" "${SOURCE}/tracer/*.cpp" "${SOURCE}/dlm/*.h"
     "${SOURCE}/dlm/*.cpp" "${SOURCE}/distributed/*.h" "${SOURCE}/distributed/*.cpp")
list(SORT files)
set(all "")
foreach(file IN LISTS files)
  file(SHA256 "${SOURCE}/${file}" hash)
  string(APPEND all "${file} ${hash}\n")
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING "${hash}" 0 8 hash)
set(text "#include \"distributed/build_info.h\"

namespace lucarne {

const std::string& buildName() {
  static const std::string name = \"lucarne ${VERSION} ${hash}, ${COMPILER}, ${BUILD}\";
  return name;
}

}  // namespace lucarne
")
# Untouched when nothing changed, so that nothing is compiled again.
set(old "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" old)
endif()
if(NOT old STREQUAL text)
  file(WRITE "${OUTPUT}" "${text}")
endif()
