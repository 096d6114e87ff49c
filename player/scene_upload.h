// The scene as OpenGL objects.
#pragma once

#include "dlm/light_maps.h"
#include "player/draw_list.h"
#include "player/gl_objects.h"
#include "player/texture_upload.h"

namespace lucarne {

struct GpuScene {
  GpuScene(const Scene& scene, const LightMaps& maps);  // needs a current context

  /// The layout of `vertices`. Contexts share all objects but this: it belongs to the one in which it is first asked for.
  GLuint layout();
  /// Another context is to draw from now on.
  void forgetLayout() { layout_ = {}; }

  DrawList list;  // `vertices` is emptied after the upload
  SceneTextures textures;
  GlBuffer vertices, materials;
  GlTexture specularTable;

 private:
  GlVertexArray layout_;
};

}  // namespace lucarne
