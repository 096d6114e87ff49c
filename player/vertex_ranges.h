// Ranges of vertices that are drawn together.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <vector>

namespace lucarne {

class VertexRanges {
 public:
  void reset() {
    first_.clear();
    count_.clear();
  }
  /// A range that goes on where the last one ends becomes part of it.
  void add(std::uint32_t first, std::uint32_t count) {
    const auto f = static_cast<GLint>(first), c = static_cast<GLsizei>(count);
    if (!first_.empty() && first_.back() + count_.back() == f) {
      count_.back() += c;
    } else {
      first_.push_back(f);
      count_.push_back(c);
    }
  }
  bool empty() const { return first_.empty(); }
  /// One call to OpenGL.
  void draw() const {
    glMultiDrawArrays(GL_TRIANGLES, first_.data(), count_.data(), static_cast<GLsizei>(first_.size()));
  }

 private:
  std::vector<GLint> first_;
  std::vector<GLsizei> count_;
};

}  // namespace lucarne
