// The driver has nothing to complain of, whatever is drawn after whatever.
#include "player/display_pass.h"
#include "player/frame_renderer.h"
#include "player/look_settings.h"
#include "player/read_back.h"
#include "tests/player/gl_available.h"
#include "tests/player/synthetic_maps.h"

namespace lucarne::frame_errors_test {
namespace {

class Frames : public test::GlTest {};

TEST_F(Frames, NoViewRendererOrLobeLeavesAnError) {
  const HeadlessGl gl;
  const test::BakedScene room = test::furnishedRoom(5);
  FrameRenderer renderer(room.scene, room.maps, LightMapFormat::rgb9e5);
  renderer.setSky({4, 2, std::vector<Rgb>(8, Rgb(1.f))});
  const FrameTarget frame(40, 30, false), window(40, 30, true), exact(23, 31, true);
  DisplayPass display;
  const auto drawn = [&](FrameView view, RendererKind kind, const FrameTarget& target, const char* what) {
    renderer.draw(view, kind, target);
    const ViewScale scale = scaleOf(view.view.kind);
    DisplayStyle style{scale, ToneCurve::filmic, display.meter(target, scale), true, frame.color.get(), 0.5f};
    display.show(target, style, 40, 30, window.shading.get());
    glFinish();
    EXPECT_EQ(gl.messages().errors, 0u) << what << ": " << gl.messages().first;
  };
  const FrameView full{room.scene.cameras.at(0)};
  for (const ViewName& v : kViewNames) {
    for (const FrameTarget* target : {&frame, &exact}) {
      FrameView view = full;
      view.view = {v.view, 3};
      drawn(view, RendererKind::singlepass, *target, v.name.data());
      drawn(full, RendererKind::multipass, *target, "full after it");
    }
  }
  for (LobeKind lobe = LobeKind::barsi; lobe != LobeKind::cell; lobe = nextOf(lobe)) {
    renderer.setLobe(lobe);
    for (const RendererKind kind : {RendererKind::singlepass, RendererKind::multipass})
      drawn(full, kind, frame, "lobe");
  }
}

TEST_F(Frames, LobesCanBeChangedAndChangedBack) {
  const HeadlessGl gl;
  const test::BakedScene room = test::furnishedRoom(14);
  FrameRenderer renderer(room.scene, room.maps, LightMapFormat::half);
  const FrameTarget frame(40, 30, true);
  const FrameView view{room.scene.cameras.at(0)};
  const auto picture = [&](LobeKind lobe) {
    renderer.setLobe(lobe);
    renderer.draw(view, RendererKind::singlepass, frame);
    return readBack(frame).pixels;
  };
  const auto cell = picture(LobeKind::cell), barsi = picture(LobeKind::barsi);
  EXPECT_NE(cell, barsi);
  EXPECT_EQ(picture(LobeKind::cell), cell);
}

TEST(LookSettings, StepsGoThroughAllAndComeBack) {
  ViewKind view = ViewKind::full;
  for (std::size_t i = 0; i < kViewNames.size(); ++i) {
    EXPECT_EQ(kViewNames[i].view, view);
    EXPECT_EQ(neighbourOf(neighbourOf(view, 1), -1), view);
    view = neighbourOf(view, 1);
  }
  EXPECT_EQ(view, ViewKind::full);
  EXPECT_EQ(nextOf(nextOf(nextOf(LobeKind::cell))), LobeKind::cell);
  EXPECT_EQ(nextOf(nextOf(ToneCurve::filmic)), ToneCurve::filmic);
}

}  // namespace
}  // namespace lucarne::frame_errors_test
