// The scene as OpenGL objects.
#pragma once

#include "dlm/light_maps.h"
#include "player/draw_list.h"
#include "player/gl_objects.h"
#include "player/texture_upload.h"

namespace lucarne {

struct GpuScene {
  GpuScene(const Scene& scene, const LightMaps& maps);  // needs a current context

  DrawList list;  // `vertices` is emptied after the upload
  SceneTextures textures;
  GlBuffer vertices, materials;
  GlVertexArray layout;
  GlTexture specularTable;
  GLsizei vertexCount = 0;
};

}  // namespace lucarne
