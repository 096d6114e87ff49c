// The player's pictures, as reports want them.
#pragma once

#include "app/report_pictures.h"

namespace lucarne {

PlayerPictures playerPictures();

}  // namespace lucarne
