#include "player/gpu_timer.h"

namespace lucarne {

GpuTimer::GpuTimer(bool believable) : believable_(believable) {
  if (!believable_) return;
  for (GlQuery& q : queries_) {
    GLuint name = 0;
    glCreateQueries(GL_TIME_ELAPSED, 1, &name);
    q = GlQuery(name);
  }
}

void GpuTimer::begin() {
  if (!believable_) return;
  if (pending_[current_]) {  // asked kFrames frames ago
    GLint ready = 0;
    glGetQueryObjectiv(queries_[current_].get(), GL_QUERY_RESULT_AVAILABLE, &ready);
    if (ready == 0) return;
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(queries_[current_].get(), GL_QUERY_RESULT, &nanoseconds);
    seconds_ = 1e-9 * static_cast<double>(nanoseconds);
    pending_[current_] = false;
  }
  glBeginQuery(GL_TIME_ELAPSED, queries_[current_].get());
  running_ = true;
}

void GpuTimer::end() {
  if (!running_) return;
  glEndQuery(GL_TIME_ELAPSED);
  running_ = false;
  pending_[current_] = true;
  current_ = (current_ + 1) % kFrames;
}

}  // namespace lucarne
