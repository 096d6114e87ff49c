// Pictures without a window.
#pragma once

#include "base/image_file.h"
#include "player/map_source.h"
#include "player/render_options.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// `sky` (equirectangular, cd/m²) is shown where there is no surface.
/// Linear radiance, cd/m²; the camera's yfov is kept, the width follows from the size. The same input gives the same
/// bits on one machine. Views have the values that view_kind.h says. Error(usage) for a size OpenGL cannot draw or a ψ
/// that is not there, Error(failed) without OpenGL 4.5,
/// Error(outOfResource) when the maps do not fit.
ImageRgb renderImage(const Scene& scene, const LightMaps& maps, const Camera& camera, const RenderOptions& options,
                     RenderStats* stats = nullptr, const ImageRgb* sky = nullptr);
/// Of light maps whose directional maps may still be in their file. InputError when that is damaged.
ImageRgb renderImage(OpenedDlm& opened, const Camera& camera, const RenderOptions& options, RenderStats* stats = nullptr,
                     const ImageRgb* sky = nullptr);

/// Error(usage) for a size that the current context cannot draw.
void checkPictureSize(const RenderOptions& options);

}  // namespace lucarne
