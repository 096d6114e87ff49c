// glossy_room.glb, carried in the program.
#pragma once

#include <cstdint>
#include <span>

namespace lucarne {

std::span<const std::uint8_t> builtinScene();

}  // namespace lucarne
