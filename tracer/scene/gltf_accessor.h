// Accessors: numbers in buffers, of six component types, strided, normalised, sparse.
#pragma once

#include <cstdint>
#include <span>

#include "tracer/scene/gltf_source.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// What an accessor's JSON says about its elements.
struct AccessorLayout {
  std::uint64_t count = 0;
  std::uint32_t componentType = 0;  // 5120 … 5126
  std::uint32_t components = 0;     // of a vector; rows · columns of a matrix
  std::uint32_t componentSize = 0;
  std::uint32_t elementSize = 0;  // bytes, with the padding of matrix columns
  bool normalized = false;
};

/// Fails on unknown types and on a count that cannot be.
AccessorLayout accessorLayout(const Json& accessor, const Place& place);

/// The increasing element numbers that a sparse accessor replaces; little-endian in the file's bytes.
struct SparseIndices {
  const std::uint8_t* bytes = nullptr;
  std::uint32_t size = 0;  // bytes an index
  std::size_t count = 0;
  std::uint32_t operator[](std::size_t i) const;
  /// Where `element` is in the list; `count` when it is not.
  std::size_t find(std::uint64_t element) const;
};

/// Reads the elements of one accessor. The source must outlive it. An accessor without buffer view is all zeros.
class Accessor {
 public:
  Accessor(const GltfSource& source, std::uint32_t index);

  const AccessorLayout& layout() const { return layout_; }
  std::uint64_t count() const { return layout_.count; }
  /// False for the all-zero accessor of a file that gives no data.
  bool hasData() const { return data_ != nullptr || sparseIndices_.count > 0; }

  /// Component `c` of element `i` as a number: integers as they are, or in 0..1 / −1..1 where normalised.
  double value(std::uint64_t i, std::uint32_t c) const;
  /// The same without normalisation.
  double rawValue(std::uint64_t i, std::uint32_t c) const { return raw(element(i), c); }
  /// Element of an unsigned integer accessor.
  std::uint32_t integer(std::uint64_t i) const { return static_cast<std::uint32_t>(raw(element(i), 0)); }
  /// The bytes of element `i`, elementSize of them.
  const std::uint8_t* element(std::uint64_t i) const;

 private:
  double raw(const std::uint8_t* bytes, std::uint32_t c) const;

  AccessorLayout layout_;
  const std::uint8_t* data_ = nullptr;
  std::size_t stride_ = 0;
  SparseIndices sparseIndices_;
  const std::uint8_t* sparseValues_ = nullptr;
};

/// Bounds of an accessor and of its sparse part in their buffer views; needs only the JSON.
void validateAccessor(const Json& accessor, const Json& bufferViews, const Place& place);
/// The indices of all sparse accessors: increasing, and less than the count.
void validateSparseIndices(const GltfSource& source);

}  // namespace lucarne
