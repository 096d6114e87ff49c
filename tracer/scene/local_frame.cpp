#include "tracer/scene/local_frame.h"

#include <algorithm>
#include <cmath>

namespace lucarne {

LocalFrame localFrameOf(const Box& metres) {
  LocalFrame frame;
  frame.origin = metres.lo * 0.5 + metres.hi * 0.5;  // halved first: the sum may be out of range where the mean is not
  const double largest = maxComponent(metres.extent());
  if (!(largest > 0)) return frame;
  // 1/scale must be a normal number too, so exponents stop short of the range of double.
  frame.scale = std::ldexp(1.0, std::clamp(std::ilogb(largest), -1000, 1000));
  return frame;
}

}  // namespace lucarne
