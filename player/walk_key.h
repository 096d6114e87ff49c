// What the walker asks for with a key or a button.
#pragma once

namespace lucarne {

enum class WalkKey {
  quit,
  singlepass,
  multipass,
  brighter,
  darker,
  autoExposure,
  help,
  fly,  // or walk again
  nextCamera,
  previousCamera,
  startAgain,
  faster,
  slower,
  reload,
};

}  // namespace lucarne
