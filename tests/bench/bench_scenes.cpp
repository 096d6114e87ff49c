#include "tests/bench/bench_scenes.h"

#include "tests/bench/bench_mesh.h"

namespace lucarne::bench {
namespace {

using test::SceneBuilder;

struct Palette {
  std::uint32_t white, grey, red, green, lamp;
};

Palette addPalette(SceneBuilder& builder) {
  return {builder.addDiffuse({0.7f, 0.7f, 0.7f}), builder.addDiffuse({0.6f, 0.58f, 0.55f}),
          builder.addDiffuse({0.6f, 0.5f, 0.5f}), builder.addDiffuse({0.5f, 0.6f, 0.5f}),
          builder.addDiffuse({0.5f, 0.5f, 0.5f}, {1000, 1000, 1000})};
}

/// A room as long as `size`, fronts inward, from the origin up. Floor and walls are cut into three strips each, the
/// ceiling into 3 × 3 fields with the lamp in the middle: 48 triangles.
void addShell(SceneBuilder& builder, const Palette& m, Vec3d size) {
  const auto at = [&](double x, double y, double z) { return Vec3d{x * size.x, y * size.y, z * size.z}; };
  for (int i = 0; i < 3; ++i) {
    const double a = i / 3.0, b = (i + 1) / 3.0;
    builder.addQuad(at(0, 0, b), at(1, 0, b), at(1, 0, a), at(0, 0, a), m.grey);
    builder.addQuad(at(0, 0, b), at(0, 0, a), at(0, 1, a), at(0, 1, b), m.red);
    builder.addQuad(at(1, 0, a), at(1, 0, b), at(1, 1, b), at(1, 1, a), m.green);
    builder.addQuad(at(a, 0, 0), at(b, 0, 0), at(b, 1, 0), at(a, 1, 0), m.white);
    builder.addQuad(at(b, 0, 1), at(a, 0, 1), at(a, 1, 1), at(b, 1, 1), m.white);
    for (int j = 0; j < 3; ++j) {
      const double c = j / 3.0, d = (j + 1) / 3.0;
      builder.addQuad(at(a, 1, c), at(b, 1, c), at(b, 1, d), at(a, 1, d), i == 1 && j == 1 ? m.lamp : m.white);
    }
  }
}

void addBoxes(SceneBuilder& builder, const Palette& m) {
  for (int i = 0; i < 12; ++i) {
    const double x = 0.6 + 1.3 * (i % 4), z = 0.7 + 1.6 * (i / 4);  // NOLINT: whole rows
    const double height = 0.4 + 0.15 * ((i * 5) % 12);
    builder.addBox({x, 0.05, z}, {x + 0.55, 0.05 + height, z + 0.5}, i % 2 == 0 ? m.white : m.grey);
  }
}

void addSphere(Scene& scene, Vec3d center, double radius, std::uint32_t material, bool smooth) {
  addGrid(scene, 128, 64, material, smooth, [&](double u, double v) {
    const Vec2d equator = onCircle(u), meridian = onCircle(0.5 * v);
    return center + Vec3d{equator.x * meridian.y, -meridian.x, -equator.y * meridian.y} * radius;
  });
}

void addTorus(Scene& scene, Vec3d center, double radius, double thickness, std::uint32_t material, bool smooth) {
  addGrid(scene, 128, 84, material, smooth, [&](double u, double v) {
    const Vec2d around = onCircle(u), tube = onCircle(v);
    const double r = radius + thickness * tube.x;
    return center + Vec3d{r * around.x, thickness * tube.y, -r * around.y};
  });
}

Scene makeRoom(bool curved, bool smooth) {
  SceneBuilder builder;
  const Palette m = addPalette(builder);
  addShell(builder, m, {6, 3.5, 6});
  addBoxes(builder, m);
  Scene scene = builder.build();
  if (!curved) return scene;
  for (int i = 0; i < 8; ++i)
    addSphere(scene, {0.8 + 1.45 * (i % 4), 2.6 - 0.2 * (i % 3), 1.5 + 3.0 * (i / 4)}, 0.35, m.white,
              smooth);  // NOLINT
  for (int i = 0; i < 6; ++i)
    addTorus(scene, {1.2 + 1.8 * (i % 3), 2.3 + 0.2 * (i % 2), 0.7 + 4.4 * (i / 3)}, 0.4, 0.12, m.grey,
             smooth);  // NOLINT
  finishGrids(scene);
  return scene;
}

// The hall: 30 m long, 10 m high, 14 m wide; two rows of ten columns on each of two storeys of 5 m, the upper one on
// galleries along both sides.
constexpr double kStorey = 5, kBay = 2.8, kFirstColumn = 2.4;
constexpr int kColumns = 10, kDrapes = 8;

/// A column with 24 flutes and a slight belly, without its ends.
void addColumn(Scene& scene, Vec3d foot, double height, std::uint32_t material, bool smooth) {
  addGrid(scene, 96, 128, material, smooth, [&](double u, double v) {
    const Vec2d around = onCircle(u);
    const double r = 0.35 * (1 + 0.1 * sinPi(v)) + 0.012 * cosPi(48 * u);
    return foot + Vec3d{r * around.x, v * height, -r * around.y};
  });
}

/// Half a ring of round section along x, from column to column.
void addArch(Scene& scene, Vec3d middle, std::uint32_t material, bool smooth) {
  addGrid(scene, 24, 64, material, smooth, [&](double u, double v) {
    const Vec2d section = onCircle(u), along = onCircle(0.5 * v);
    const double r = kBay / 2 + 0.2 * section.x;
    return middle + Vec3d{r * along.x, 0.6 * r * along.y, -0.2 * section.y};
  });
}

/// Cloth in folds that deepen downward; both of its sides take light.
void addDrape(Scene& scene, Vec3d corner, std::uint32_t material, bool smooth) {
  addGrid(scene, 128, 96, material, smooth, [&](double u, double v) {
    const double fold = (0.04 + 0.12 * (1 - v)) * sinPi(14 * u + 0.6 * v);
    return corner + Vec3d{2.2 * u, 3.0 * v, fold};
  });
}

/// Galleries, and a plinth and a capital for each column: its ends and those of the arches are inside them.
void addHallBoxes(SceneBuilder& builder, const Palette& m) {
  for (const double z : {0.05, 10.45}) builder.addBox({0.05, kStorey - 0.35, z}, {29.95, kStorey, z + 3.5}, m.grey);
  for (int i = 0; i < 2 * kColumns; ++i) {
    const double x = kFirstColumn + kBay * (i % kColumns), z = i < kColumns ? 3.0 : 11.0;
    for (const double floor : {0.0, kStorey}) {
      builder.addBox({x - 0.45, floor + 0.02, z - 0.45}, {x + 0.45, floor + 0.3, z + 0.45}, m.white);
      builder.addBox({x - 0.45, floor + 3.2, z - 0.45}, {x + 0.45, floor + 3.5, z + 0.45}, m.white);
    }
  }
}

Scene makeHall(bool smooth) {
  SceneBuilder builder;
  const Palette m = addPalette(builder);
  Material cloth = test::diffuseMaterial({0.6f, 0.52f, 0.5f});
  cloth.doubleSided = true;
  const std::uint32_t drape = builder.addMaterial(cloth);
  addShell(builder, m, {30, 2 * kStorey, 14});
  addHallBoxes(builder, m);
  Scene scene = builder.build();
  for (int storey = 0; storey < 2; ++storey) {
    for (const double z : {3.0, 11.0}) {
      for (int i = 0; i < kColumns; ++i) {
        const Vec3d foot{kFirstColumn + kBay * i, storey * kStorey + 0.25, z};
        addColumn(scene, foot, 3.0, m.white, smooth);
        if (i + 1 < kColumns) addArch(scene, foot + Vec3d{kBay / 2, 3.2, 0}, m.grey, smooth);
      }
    }
  }
  for (int i = 0; i < kDrapes; ++i)
    addDrape(scene, {2.7 + 2 * kBay * (i % 4), 0.6 + kStorey, i < 4 ? 2.2 : 11.8}, drape, smooth);
  finishGrids(scene);
  return scene;
}

Scene makeBareRoom(bool smooth) { return makeRoom(false, smooth); }
Scene makeCurvedRoom(bool smooth) { return makeRoom(true, smooth); }

}  // namespace

const std::vector<SceneRecipe>& sceneRecipes() {
  static const std::vector<SceneRecipe> recipes{
      {"room", makeBareRoom}, {"room_250k", makeCurvedRoom}, {"hall_1m", makeHall}};
  return recipes;
}

}  // namespace lucarne::bench
