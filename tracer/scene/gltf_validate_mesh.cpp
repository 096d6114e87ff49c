#include "tracer/scene/gltf_validate_mesh.h"

#include "tracer/scene/gltf_accessor.h"

namespace lucarne {
namespace {

/// Accessors and sizes that primitives refer to.
struct MeshContext {
  const Json& accessors;
  std::size_t materials;
};

std::uint32_t componentsOf(const std::string& attribute, bool isTarget) {
  if (attribute == "POSITION" || attribute == "NORMAL") return 3;
  if (attribute == "TANGENT") return isTarget ? 3 : 4;
  return attribute.starts_with("TEXCOORD_") ? 2 : 0;
}

/// All attributes of a primitive or morph target; `count` is the number of vertices, 0 while unknown.
void validateAttributes(const Json& attributes, bool isTarget, std::uint64_t& count, const MeshContext& context,
                        const Place& place) {
  for (const auto& [name, value] : attributes.items()) {
    const Place where = place.in(name);
    const AccessorLayout layout =
        accessorLayout(context.accessors[asIndex(value, context.accessors.size(), where)], where);
    const std::uint32_t components = componentsOf(name, isTarget);
    if (components != 0 && layout.components != components) {
      where.fail("has " + std::to_string(layout.components) + " components, not " + std::to_string(components));
    }
    if (count != 0 && layout.count != count) where.fail("has not as many elements as the other attributes");
    count = layout.count;
  }
}

void validateIndices(const Json& primitive, const MeshContext& context, const Place& place) {
  const std::uint32_t index = indexOf(primitive, "indices", context.accessors.size(), place);
  if (index == kNone) return;
  const AccessorLayout layout = accessorLayout(context.accessors[index], place.in("indices"));
  const bool isUnsigned = layout.componentType == 5121 || layout.componentType == 5123 || layout.componentType == 5125;
  if (layout.components != 1 || !isUnsigned || layout.normalized)
    place.in("indices").fail("is not a list of unsigned integers");
}

void validatePrimitive(const Json& primitive, const MeshContext& context, const Place& place) {
  const Json* attributes = findObject(primitive, "attributes", place);
  if (attributes == nullptr) place.fail("has no attributes");
  std::uint64_t count = 0;
  validateAttributes(*attributes, false, count, context, place.in("attributes"));
  validateIndices(primitive, context, place);
  indexOf(primitive, "material", context.materials, place);
  if (countOf(primitive, "mode", 4, place) > 6) place.in("mode").fail("is none of 0 to 6");
  const Json& targets = objectArray(primitive, "targets", place);
  for (std::size_t i = 0; i < targets.size(); ++i)
    validateAttributes(targets[i], true, count, context, place.in("targets", i));
}

}  // namespace

void validateMeshes(const Json& json, const Place& file) {
  static const Json none = Json::array();
  const Json* accessors = findMember(json, "accessors");
  const Json* materials = findMember(json, "materials");
  const MeshContext context{accessors == nullptr ? none : *accessors, materials == nullptr ? 0 : materials->size()};
  const Json& meshes = objectArray(json, "meshes", file);
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const Place place = file.in("meshes", m);
    textOf(meshes[m], "name", "", place);
    const Json& primitives = objectArray(meshes[m], "primitives", place);
    for (std::size_t p = 0; p < primitives.size(); ++p)
      validatePrimitive(primitives[p], context, place.in("primitives", p));
  }
}

}  // namespace lucarne
