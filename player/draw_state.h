// The OpenGL state that drawing changes, remembered so that only changes reach the driver, and counted.
#pragma once

#include <array>

#include "player/programs.h"
#include "player/render_options.h"
#include "player/texture_upload.h"
#include "player/view_kind.h"

namespace lucarne {

class DrawState {
 public:
  /// Forgets what was bound (another user of the context may have changed it) and the counts.
  void reset();

  /// Forgets what was bound, keeps the counts.
  void forgetBindings();

  void useProgram(const ShadingProgram& program);
  /// ψ of the direction passes; `words` as MapTables::wordsPerSide. Every program gets it once.
  void setDirection(int psi, int words);
  void useMaterial(std::uint32_t material, const MaterialTextures* textures);
  /// Of the view passes.
  void setView(View view, int words);
  void countDraw() { ++counts_.draws; }

  const StateCounts& counts() const { return counts_; }

 private:
  void bindTexture(GLuint unit, GLuint texture);

  StateCounts counts_;
  const ShadingProgram* program_ = nullptr;
  std::array<GLuint, 4> textures_{};
  std::uint32_t material_ = ~0u;
  int direction_ = -1, words_ = 1;
  View view_;
};

}  // namespace lucarne
