#include "player/look_settings.h"

namespace lucarne {

ViewKind neighbourOf(ViewKind view, int step) {
  const int count = static_cast<int>(kViewNames.size());
  return static_cast<ViewKind>((static_cast<int>(view) + step % count + count) % count);
}

std::string_view nameOf(LobeKind lobe) {
  return lobe == LobeKind::barsi ? "barsi" : lobe == LobeKind::sample ? "sample" : "cell";
}

std::string_view nameOf(ToneCurve curve) { return curve == ToneCurve::plain ? "plain" : "filmic"; }

LobeKind nextOf(LobeKind lobe) {
  return lobe == LobeKind::cell ? LobeKind::barsi : lobe == LobeKind::barsi ? LobeKind::sample : LobeKind::cell;
}

ToneCurve nextOf(ToneCurve curve) { return curve == ToneCurve::plain ? ToneCurve::filmic : ToneCurve::plain; }

}  // namespace lucarne
