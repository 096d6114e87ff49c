// The player, in programs that have one.
#pragma once

#include "app/report_pictures.h"
#ifdef LUCARNE_HAS_PLAYER
#include "app/view/player_pictures.h"
#endif

namespace lucarne {

inline PlayerPictures playerOfThisProgram() {
#ifdef LUCARNE_HAS_PLAYER
  return playerPictures();
#else
  return {};
#endif
}

}  // namespace lucarne
