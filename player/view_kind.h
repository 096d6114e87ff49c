// What a picture shows of the light maps: the scene as it looks, or one thing about it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lucarne {

/// The order is that of view_pass.glsl.
enum class ViewKind : std::uint8_t {
  full,        // radiance toward the eye, cd/m²
  irradiance,  // E, lx
  direction,   // B of one ψ, lx; black where the side does not keep its light apart by direction
  photons,     // that fell into the texel
  error,       // estimated relative standard error of the texel
  density,     // texels per metre
  texels,      // E, darkened in every second texel
  charts,      // a colour for each chart
  wireframe,   // edges of the triangles over the albedo
  albedo,      // base colour
  normals,     // (n + 1)/2 of the shading normal
};

/// What the values of a view are, and so how a screen shows them.
enum class ViewScale : std::uint8_t {
  light,   // without upper bound: exposure and tone curve
  number,  // of red alone, ≥ 0: heat colours up to what is large in the picture
  colour,  // 0 … 1, linear: as it is
};

constexpr ViewScale scaleOf(ViewKind view) {
  switch (view) {
    case ViewKind::photons:
    case ViewKind::error:
    case ViewKind::density:
      return ViewScale::number;
    case ViewKind::charts:
    case ViewKind::wireframe:
    case ViewKind::albedo:
    case ViewKind::normals:
      return ViewScale::colour;
    default:
      return ViewScale::light;
  }
}

struct ViewName {
  ViewKind view;
  std::string_view name, meaning;
};
inline constexpr std::array<ViewName, 11> kViewNames = {{
    {ViewKind::full, "full", "the scene, cd/m2"},
    {ViewKind::irradiance, "irradiance", "light that falls on it, lx"},
    {ViewKind::direction, "direction", "light of one direction, lx"},
    {ViewKind::photons, "photons", "photons a texel"},
    {ViewKind::error, "error", "estimated relative error"},
    {ViewKind::density, "density", "texels a metre"},
    {ViewKind::texels, "texels", "irradiance with the grid of texels"},
    {ViewKind::charts, "charts", "a colour for each chart"},
    {ViewKind::wireframe, "wireframe", "edges of the triangles"},
    {ViewKind::albedo, "albedo", "base colour"},
    {ViewKind::normals, "normals", "shading normal"},
}};

constexpr std::string_view nameOf(ViewKind view) { return kViewNames[static_cast<std::size_t>(view)].name; }

/// A view, and of which direction.
struct View {
  ViewKind kind = ViewKind::full;
  int psi = 0;  // of ViewKind::direction, 0 … |Ω| − 1
  friend bool operator==(const View&, const View&) = default;
};

}  // namespace lucarne
