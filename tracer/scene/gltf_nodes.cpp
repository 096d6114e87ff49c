#include "tracer/scene/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lucarne {
namespace {

double largestEntry(const Affine& a) {
  double largest = 0;
  for (const Vec3d& c : {a.c0, a.c1, a.c2}) {
    largest = std::max({largest, std::fabs(c.x), std::fabs(c.y), std::fabs(c.z)});
  }
  return largest;
}

bool isFinite(const Affine& a) {
  return lucarne::isFinite(a.c0) && lucarne::isFinite(a.c1) && lucarne::isFinite(a.c2) && lucarne::isFinite(a.t);
}

/// Columns of a rotation; the quaternion x, y, z, w is brought to unit length first.
Affine rotationOf(const std::array<double, 4>& quaternion, const Place& place) {
  const double largest = std::max(
      {std::fabs(quaternion[0]), std::fabs(quaternion[1]), std::fabs(quaternion[2]), std::fabs(quaternion[3])});
  if (!(largest > 0)) place.in("rotation").fail("is a quaternion of zeros");
  double q[4], squares = 0;
  for (int i = 0; i < 4; ++i) {
    q[i] = quaternion[static_cast<std::size_t>(i)] / largest;
    squares += q[i] * q[i];
  }
  const double norm = std::sqrt(squares), x = q[0] / norm, y = q[1] / norm, z = q[2] / norm, w = q[3] / norm;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)},
          {}};
}

struct LocalTransform {
  Affine full, rotation;
};

LocalTransform matrixTransform(const Json& node, const Place& place) {
  const auto m = numbersOf<16>(node, "matrix", {}, place);
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) place.in("matrix").fail("has a last row that is not 0 0 0 1");
  LocalTransform local;
  local.full = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  const auto axis = [](Vec3d column, Vec3d fallback) {
    const double l = maxComponent(Vec3d{std::fabs(column.x), std::fabs(column.y), std::fabs(column.z)});
    return l > 0 ? normalize(column / l) : fallback;
  };
  local.rotation = {axis(local.full.c0, {1, 0, 0}), axis(local.full.c1, {0, 1, 0}), axis(local.full.c2, {0, 0, 1}), {}};
  return local;
}

LocalTransform localTransform(const Json& node, const Place& place) {
  if (findMember(node, "matrix") != nullptr) return matrixTransform(node, place);
  const auto t = numbersOf<3>(node, "translation", {0, 0, 0}, place);
  const auto s = numbersOf<3>(node, "scale", {1, 1, 1}, place);
  const Affine r = rotationOf(numbersOf<4>(node, "rotation", {0, 0, 0, 1}, place), place);
  return {{r.c0 * s[0], r.c1 * s[1], r.c2 * s[2], {t[0], t[1], t[2]}}, r};
}

const Json& nodesOf(const Json& json) {
  static const Json none = Json::array();
  const Json* nodes = findMember(json, "nodes");
  return nodes == nullptr ? none : *nodes;
}

const Json& childrenOf(const Json& node, const Place& place) {
  static const Json none = Json::array();
  const Json* children = findArray(node, "children", place);
  return children == nullptr ? none : *children;
}

/// The parent of each node; kNone for roots.
std::vector<std::uint32_t> parentsOf(const Json& nodes, const Place& file) {
  std::vector<std::uint32_t> parents(nodes.size(), kNone);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const Place place = file.in("nodes", i);
    for (const Json& value : childrenOf(nodes[i], place)) {
      const std::uint32_t child = asIndex(value, nodes.size(), place.in("children"));
      if (parents[child] != kNone) file.in("nodes", child).fail("is the child of two nodes");
      parents[child] = i;
    }
  }
  return parents;
}

/// With one parent a node at most, all nodes hang from roots exactly when there is no loop.
void checkNoLoop(const Json& nodes, const std::vector<std::uint32_t>& parents, const Place& file) {
  std::vector<std::uint8_t> hangs(nodes.size(), 0);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    std::vector<std::uint32_t> path;
    std::uint32_t node = i;
    while (node != kNone && hangs[node] == 0) {
      hangs[node] = 2;  // on the path
      path.push_back(node);
      node = parents[node];
    }
    if (node != kNone && hangs[node] == 2) file.in("nodes", node).fail("is its own ancestor");
    for (const std::uint32_t p : path) hangs[p] = 1;
  }
}

/// Of the node's extras: "lucarne.texels_per_metre": N, or "lucarne": {"texels_per_metre": N}. `inherited` where it has
/// none. Extras may be anything; only a density that is none is an error.
double densityOf(const Json& node, double inherited, const Place& place) {
  const Json* extras = findMember(node, "extras");
  if (extras == nullptr || !extras->is_object()) return inherited;
  const Json* value = findMember(*extras, "lucarne.texels_per_metre");
  if (const Json* ours = findMember(*extras, "lucarne"); value == nullptr && ours != nullptr && ours->is_object())
    value = findMember(*ours, "texels_per_metre");
  if (value == nullptr) return inherited;
  const double density = value->is_number() ? value->get<double>() : 0;
  if (!(density > 0 && density <= 1e9))
    place.in("extras").in("lucarne.texels_per_metre").fail("is not a number of texels above 0");
  return density;
}

std::vector<std::uint32_t> rootsOf(const Json& json, const std::vector<std::uint32_t>& parents, const Place& file) {
  std::vector<std::uint32_t> roots;
  const Json* scenes = findMember(json, "scenes");
  if (scenes == nullptr || scenes->empty()) {
    for (std::uint32_t i = 0; i < parents.size(); ++i) {
      if (parents[i] == kNone) roots.push_back(i);
    }
    return roots;
  }
  const std::uint32_t chosen = indexOf(json, "scene", scenes->size(), file);
  const std::uint32_t scene = chosen == kNone ? 0 : chosen;
  const Json* list = findArray((*scenes)[scene], "nodes", file.in("scenes", scene));
  if (list == nullptr) return roots;
  for (const Json& value : *list) roots.push_back(asIndex(value, parents.size(), file.in("scenes", scene).in("nodes")));
  return roots;
}

}  // namespace

Affine balanced(const Affine& a) {
  const double largest = largestEntry(a);
  if (!(largest > 0)) return a;
  const double s = std::ldexp(1.0, std::clamp(-std::ilogb(largest), -1000, 1000));
  return {a.c0 * s, a.c1 * s, a.c2 * s, a.t};
}

void validateNodeGraph(const Json& json, const Place& file) {
  const Json& nodes = nodesOf(json);
  const std::vector<std::uint32_t> parents = parentsOf(nodes, file);
  checkNoLoop(nodes, parents, file);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    localTransform(nodes[i], file.in("nodes", i));
    densityOf(nodes[i], 0, file.in("nodes", i));
  }
  const Json& scenes = objectArray(json, "scenes", file);
  indexOf(json, "scene", scenes.size(), file);
  std::vector<std::size_t> listed(nodes.size(), 0);  // 1 + the last scene that lists the node
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const Place place = file.in("scenes", s);
    const Json* list = findArray(scenes[s], "nodes", place);
    if (list == nullptr) continue;
    for (const Json& value : *list) {
      const std::uint32_t node = asIndex(value, nodes.size(), place.in("nodes"));
      if (parents[node] != kNone) place.fail("lists node " + std::to_string(node) + ", which is not a root");
      if (std::exchange(listed[node], s + 1) == s + 1) place.fail("lists node " + std::to_string(node) + " twice");
    }
  }
}

std::vector<WorldNode> flattenNodes(const Json& json, const Place& file) {
  const Json& nodes = nodesOf(json);
  std::vector<WorldNode> flat;
  std::vector<WorldNode> stack;  // node, and the transforms of its parent
  const std::vector<std::uint32_t> roots = rootsOf(json, parentsOf(nodes, file), file);
  for (auto it = roots.rbegin(); it != roots.rend(); ++it) stack.push_back({*it, {}, {}, false, 0});
  while (!stack.empty()) {
    WorldNode current = stack.back();
    stack.pop_back();
    const Place place = file.in("nodes", current.node);
    const LocalTransform local = localTransform(nodes[current.node], place);
    current.world = current.world * local.full;
    current.rotation = current.rotation * local.rotation;
    if (!isFinite(current.world)) place.fail("has a world transform that is not finite");
    current.mirrors = balanced(current.world).determinant() < 0;
    current.texelsPerMetre = densityOf(nodes[current.node], current.texelsPerMetre, place);
    flat.push_back(current);
    const Json& children = childrenOf(nodes[current.node], place);
    for (auto it = children.rbegin(); it != children.rend(); ++it) {
      stack.push_back({asIndex(*it, nodes.size(), place), current.world, current.rotation, false, current.texelsPerMetre});
    }
  }
  return flat;
}

}  // namespace lucarne
