// A key that went down.
#pragma once

namespace lucarne {

struct KeyPress {
  int key = 0;  // GLFW_KEY_*
  bool shift = false;
};

}  // namespace lucarne
