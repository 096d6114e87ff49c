#include "player/overlay_picture.h"

#include "base/error.h"
#include "player/gl_context.h"
#include "player/screen_image.h"

namespace lucarne {

void drawOverlayOver(std::vector<std::uint8_t>& rgb, const OverlayText& text, const LookSettings& look) {
  const auto row = static_cast<std::size_t>(text.width) * 3, height = static_cast<std::size_t>(text.height);
  LUCARNE_CHECK_EQ(rgb.size(), row * height);
  const HeadlessGl gl;
  const ScreenImage screen(text.width, text.height);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::size_t y = 0; y < height; ++y) {  // OpenGL counts rows from the bottom
    glTextureSubImage2D(screen.color.get(), 0, 0, static_cast<GLint>(height - 1 - y), text.width, 1, GL_RGB,
                        GL_UNSIGNED_BYTE, &rgb[y * row]);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, screen.framebuffer.get());
  glViewport(0, 0, text.width, text.height);
  LookSettings changed = look;  // nobody moves a mouse here
  Overlay(nullptr).draw(text, changed);
  rgb = screen.read();
  throwOnComplaint(gl.messages(), "drawing the text");
}

}  // namespace lucarne
