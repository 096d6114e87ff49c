// What the keys and the panel of the walkthrough change about the picture.
#pragma once

#include <optional>
#include <string_view>

#include "base/vec.h"
#include "player/render_options.h"
#include "player/tonemap.h"
#include "player/view_kind.h"

namespace lucarne {

struct LookSettings {
  View view{};
  LobeKind lobe = LobeKind::cell;
  ToneCurve curve = ToneCurve::filmic;
  float stops = 0;              // brighter than the automatic exposure, or than the locked one
  bool exposureLocked = false;  // the exposure of this moment stays
  bool smoothEdges = true;
  bool panel = false;    // the controls are shown
  bool compare = false;  // the right part of the picture is the path-traced truth
  float divider = 0.5f;  // where that part begins, 0 … 1 of the width
  // Asked for; whoever does it takes the wish back.
  bool screenshot = false;
  std::optional<Vec2d> inspectAt;  // 0 … 1 of the picture, from its upper left corner
};

/// The next view, or the one before; of the last the first.
ViewKind neighbourOf(ViewKind view, int step);
std::string_view nameOf(LobeKind lobe);
std::string_view nameOf(ToneCurve curve);
LobeKind nextOf(LobeKind lobe);
ToneCurve nextOf(ToneCurve curve);

}  // namespace lucarne
