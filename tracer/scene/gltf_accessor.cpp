#include "tracer/scene/gltf_accessor.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace lucarne {
namespace {

enum ComponentType : std::uint32_t { kByte = 5120, kUnsignedByte, kShort, kUnsignedShort, kUnsignedInt = 5125, kFloat };

// Without data behind it a count costs its author nothing, so it is bounded.
constexpr std::uint64_t kMaxCountWithoutData = std::uint64_t{1} << 24;
constexpr std::uint64_t kMaxSparseIndices = std::uint64_t{1} << 28;  // of a file; its accessors may share them

std::uint32_t componentSizeOf(std::uint64_t type) {
  switch (type) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

struct Shape {
  const char* name;
  std::uint32_t rows, columns;
};
constexpr std::array<Shape, 7> kShapes = {
    {{"SCALAR", 1, 1}, {"VEC2", 2, 1}, {"VEC3", 3, 1}, {"VEC4", 4, 1}, {"MAT2", 2, 2}, {"MAT3", 3, 3}, {"MAT4", 4, 4}}};

/// Fails unless `count` elements of `size` bytes, `stride` apart, from `offset` lie in the view. None of the terms can
/// overflow: a view lies in a buffer of at most 4 GiB, and count is compared by division.
void checkBounds(std::uint64_t count, std::uint64_t size, std::uint64_t stride, std::uint64_t offset,
                 std::uint64_t viewLength, const Place& place) {
  const bool fits =
      offset <= viewLength && size <= viewLength - offset && (count - 1) <= (viewLength - offset - size) / stride;
  if (!fits) place.fail("reaches past the end of its buffer view");
}

std::uint64_t strideOf(const Json& view, std::uint64_t size, const Place& place) {
  return std::max<std::uint64_t>(countOf(view, "byteStride", size, place), 1);
}

void validateSparse(const Json& sparse, const AccessorLayout& layout, const Json& bufferViews, const Place& place) {
  const std::uint64_t count = requiredCount(sparse, "count", place);
  if (count < 1 || count > layout.count) place.fail("has a count outside 1 .. the accessor's count");
  for (const char* part : {"indices", "values"}) {
    const Json* object = findObject(sparse, part, place);
    const Place where = place.in(part);
    if (object == nullptr) where.fail("is missing");
    std::uint64_t size = layout.elementSize;
    if (*part == 'i') {
      const std::uint64_t type = requiredCount(*object, "componentType", where);
      if (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt)
        where.fail("has no unsigned component type");
      size = componentSizeOf(type);
    }
    const Json& view = bufferViews[requiredIndex(*object, "bufferView", bufferViews.size(), where)];
    if (findMember(view, "byteStride") != nullptr) where.fail("lies in a buffer view with a stride");
    checkBounds(count, size, size, countOf(*object, "byteOffset", 0, where), requiredCount(view, "byteLength", where),
                where);
  }
}

SparseIndices sparseIndicesOf(const GltfSource& source, const Json& sparse, const Place& place) {
  const Json& indices = sparse["indices"];
  const auto view = static_cast<std::uint32_t>(requiredCount(indices, "bufferView", place));
  return {source.viewBytes(view).data() + countOf(indices, "byteOffset", 0, place),
          componentSizeOf(requiredCount(indices, "componentType", place)), requiredCount(sparse, "count", place)};
}

void checkIncreasing(const SparseIndices& list, std::uint64_t elements, const Place& place) {
  for (std::size_t i = 1; i < list.count; ++i) {
    if (list[i] <= list[i - 1]) place.fail("has indices that do not increase");
  }
  if (list[list.count - 1] >= elements) place.fail("has an index past the accessor's count");
}

template <class T>
double load(const std::uint8_t* bytes, std::uint32_t index) {
  T value;
  std::memcpy(&value, bytes + index * sizeof(T), sizeof(T));
  return static_cast<double>(value);
}

}  // namespace

AccessorLayout accessorLayout(const Json& accessor, const Place& place) {
  AccessorLayout layout;
  const std::uint64_t type = requiredCount(accessor, "componentType", place);
  layout.componentSize = componentSizeOf(type);
  if (layout.componentSize == 0) place.fail("has the unknown componentType " + std::to_string(type));
  layout.componentType = static_cast<std::uint32_t>(type);
  const std::string shapeName = textOf(accessor, "type", "", place);
  const auto shape = std::find_if(kShapes.begin(), kShapes.end(), [&](const Shape& s) { return shapeName == s.name; });
  if (shape == kShapes.end()) place.fail("has an unknown type");
  layout.components = shape->rows * shape->columns;
  const std::uint32_t column = shape->rows * layout.componentSize;
  layout.elementSize = shape->columns == 1 ? column : (column + 3) / 4 * 4 * shape->columns;
  layout.normalized = flagOf(accessor, "normalized", false, place);
  layout.count = requiredCount(accessor, "count", place);
  if (layout.count < 1 || layout.count > kNone) place.fail("has a count outside 1 .. 4294967295");
  return layout;
}

void validateAccessor(const Json& accessor, const Json& bufferViews, const Place& place) {
  const AccessorLayout layout = accessorLayout(accessor, place);
  const std::uint64_t offset = countOf(accessor, "byteOffset", 0, place);
  const std::uint32_t view = indexOf(accessor, "bufferView", bufferViews.size(), place);
  if (view != kNone) {
    const std::uint64_t stride = strideOf(bufferViews[view], layout.elementSize, place);
    if (stride < layout.elementSize) place.fail("has elements larger than the stride of its buffer view");
    checkBounds(layout.count, layout.elementSize, stride, offset, requiredCount(bufferViews[view], "byteLength", place),
                place);
  } else if (layout.count > kMaxCountWithoutData) {
    place.fail("has " + std::to_string(layout.count) + " elements and no data for them");
  }
  const Json* sparse = findObject(accessor, "sparse", place);
  if (sparse != nullptr) validateSparse(*sparse, layout, bufferViews, place.in("sparse"));
}

void validateSparseIndices(const GltfSource& source) {
  const Json& accessors = source.list("accessors");
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < accessors.size(); ++i) {
    const Json* sparse = findMember(accessors[i], "sparse");
    if (sparse == nullptr) continue;
    const Place place = source.place().in("accessors", i).in("sparse");
    const SparseIndices list = sparseIndicesOf(source, *sparse, place);
    total += list.count;
    if (total > kMaxSparseIndices) place.fail("makes the sparse accessors of the file too long");
    checkIncreasing(list, requiredCount(accessors[i], "count", place), place);
  }
}

std::uint32_t SparseIndices::operator[](std::size_t i) const {
  std::uint32_t value = 0;
  for (std::uint32_t b = 0; b < size; ++b) value |= std::uint32_t{bytes[i * size + b]} << (8 * b);
  return value;
}

std::size_t SparseIndices::find(std::uint64_t element) const {
  std::size_t lo = 0, hi = count;
  while (lo < hi) {
    const std::size_t middle = (lo + hi) / 2;
    if ((*this)[middle] < element) {
      lo = middle + 1;
    } else {
      hi = middle;
    }
  }
  return lo < count && (*this)[lo] == element ? lo : count;
}

Accessor::Accessor(const GltfSource& source, std::uint32_t index) {
  const Place place = source.place().in("accessors", index);
  const Json& accessor = source.list("accessors")[index];
  layout_ = accessorLayout(accessor, place);
  const Json& views = source.list("bufferViews");
  const std::uint32_t view = indexOf(accessor, "bufferView", views.size(), place);
  if (view != kNone) {
    data_ = source.viewBytes(view).data() + countOf(accessor, "byteOffset", 0, place);
    stride_ = strideOf(views[view], layout_.elementSize, place);
  }
  const Json* sparse = findObject(accessor, "sparse", place);
  if (sparse == nullptr) return;
  sparseIndices_ = sparseIndicesOf(source, *sparse, place);
  const Json& values = (*sparse)["values"];
  const std::uint32_t valuesView = requiredIndex(values, "bufferView", views.size(), place);
  sparseValues_ = source.viewBytes(valuesView).data() + countOf(values, "byteOffset", 0, place);
}

const std::uint8_t* Accessor::element(std::uint64_t i) const {
  static constexpr std::array<std::uint8_t, 64> zeros{};
  const std::size_t sparse = sparseIndices_.find(i);
  if (sparse < sparseIndices_.count) return sparseValues_ + sparse * layout_.elementSize;
  return data_ == nullptr ? zeros.data() : data_ + i * stride_;
}

double Accessor::raw(const std::uint8_t* bytes, std::uint32_t c) const {
  switch (layout_.componentType) {
    case kByte:
      return load<std::int8_t>(bytes, c);
    case kUnsignedByte:
      return load<std::uint8_t>(bytes, c);
    case kShort:
      return load<std::int16_t>(bytes, c);
    case kUnsignedShort:
      return load<std::uint16_t>(bytes, c);
    case kUnsignedInt:
      return load<std::uint32_t>(bytes, c);
    default:
      return load<float>(bytes, c);
  }
}

double Accessor::value(std::uint64_t i, std::uint32_t c) const {
  const double number = raw(element(i), c);
  if (!layout_.normalized) return number;
  switch (layout_.componentType) {
    case kByte:
      return std::max(number / 127, -1.0);
    case kUnsignedByte:
      return number / 255;
    case kShort:
      return std::max(number / 32767, -1.0);
    case kUnsignedShort:
      return number / 65535;
    default:
      return number;
  }
}

}  // namespace lucarne
