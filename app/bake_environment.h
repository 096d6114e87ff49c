// The sky of a bake: an equirectangular map around the scene.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "app/bake_options.h"
#include "tracer/optics/environment.h"

namespace lucarne {

/// The picture at options.environment, scaled and turned as the options say. UsageError for another kind of file,
/// InputError for a bad one. An empty picture where the options name none.
ImageRgb loadSky(const BakeOptions& options);

/// A picture as bytes, for other ranks, and back; InputError for bytes that are none.
std::vector<std::uint8_t> packSky(const ImageRgb& image);
ImageRgb unpackSky(const std::vector<std::uint8_t>& bytes);

/// Null for an empty picture.
std::unique_ptr<Environment> makeEnvironment(ImageRgb image, const BakeOptions& options);

/// The file's name; empty where there is none.
std::string environmentName(const BakeOptions& options);

}  // namespace lucarne
