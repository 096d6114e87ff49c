// glTF extensions: which we read, which we leave out and in what words, which we refuse.
#pragma once

#include <string>
#include <vector>

#include "tracer/scene/gltf_json.h"

namespace lucarne {

/// Throws an InputError for an extension without which the file cannot be understood.
void requireKnownExtension(const std::string& name, const Place& file);

/// What a user should know about an extension that a file uses; empty for those that are read in full. `count` objects
/// have it.
std::string extensionLeftOut(const std::string& name, std::size_t count);

}  // namespace lucarne
