// A zeroed array in its own pages, asked to be huge pages: random adds into gigabytes cost half as much with them.
#pragma once

#include <cstddef>
#include <span>
#include <utility>

namespace lucarne {

/// Anonymous zeroed memory; Error(outOfResource) when the system refuses it.
class PageBlock {
 public:
  PageBlock() = default;
  explicit PageBlock(std::size_t bytes);
  ~PageBlock();
  PageBlock(PageBlock&& o) noexcept : data_(std::exchange(o.data_, nullptr)), bytes_(std::exchange(o.bytes_, 0)) {}
  PageBlock& operator=(PageBlock&& o) noexcept {
    std::swap(data_, o.data_);
    std::swap(bytes_, o.bytes_);
    return *this;
  }
  void* data() const { return data_; }

 private:
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};

template <class T>
class HugeBuffer {
 public:
  HugeBuffer() = default;
  explicit HugeBuffer(std::size_t count) : block_(count * sizeof(T)), count_(count) {}
  std::span<T> span() const { return {static_cast<T*>(block_.data()), count_}; }
  T* data() const { return static_cast<T*>(block_.data()); }
  std::size_t size() const { return count_; }

 private:
  PageBlock block_;
  std::size_t count_ = 0;
};

}  // namespace lucarne
