// SPDX-License-Identifier: MIT
#include "backends/opengl/timing.h"

#include <epoxy/gl.h>

namespace grisaille::opengl {
namespace {

using gpu::Clock;

double milliseconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

// Nanoseconds. Waits if the timestamp is not available yet.
uint64_t read(const Object& query) {
  GLuint64 time = 0;
  glGetQueryObjectui64v(query.name(), GL_QUERY_RESULT, &time);
  return time;
}

double milliseconds(const Object& begin, const Object& end) {
  return static_cast<double>(read(end) - read(begin)) * 1e-6;
}

}  // namespace

void PassTimer::beginPass(std::string_view label) {
  if (clock_ == Clock::kNone) return;
  Pass& pass = current_.emplace_back();
  pass.label = label;
  if (clock_ == Clock::kGpu) {
    pass.begin = stamp();
  } else {
    glFinish();
    pass.wallBegin = std::chrono::steady_clock::now();
  }
}

void PassTimer::endPass() {
  if (clock_ == Clock::kNone) return;
  Pass& pass = current_.back();
  if (clock_ == Clock::kGpu) {
    pass.end = stamp();
  } else {
    glFinish();
    pass.wallEnd = std::chrono::steady_clock::now();
  }
}

void PassTimer::submit(uint64_t frame) {
  if (clock_ == Clock::kNone) return;
  pending_.push_back({.number = frame, .passes = std::move(current_)});
  current_.clear();
}

void PassTimer::drop() {
  Frame frame{.number = 0, .passes = std::move(current_)};
  current_.clear();
  recycle(frame);
}

void PassTimer::collect() {
  while (!pending_.empty() && arrived(pending_.front())) {
    done_.push_back(timesOf(pending_.front()));
    recycle(pending_.front());
    pending_.pop_front();
  }
}

std::vector<gpu::FrameTimes> PassTimer::take() {
  collect();
  return std::exchange(done_, {});
}

Object PassTimer::stamp() {
  Object query;
  if (spares_.empty()) {
    query = Object(ObjectKind::kTimestamp);
  } else {
    query = std::move(spares_.back());
    spares_.pop_back();
  }
  glQueryCounter(query.name(), GL_TIMESTAMP);
  return query;
}

// Timestamps become available in order: checking the last one is enough.
bool PassTimer::arrived(const Frame& frame) const {
  if (clock_ != Clock::kGpu || frame.passes.empty()) return true;
  GLint available = GL_FALSE;
  glGetQueryObjectiv(frame.passes.back().end.name(), GL_QUERY_RESULT_AVAILABLE, &available);
  return available == GL_TRUE;
}

gpu::FrameTimes PassTimer::timesOf(const Frame& frame) const {
  gpu::FrameTimes times;
  times.frame = frame.number;
  if (frame.passes.empty()) return times;
  const bool wall = clock_ == Clock::kWall;
  for (const Pass& pass : frame.passes) {
    times.passes.push_back({pass.label, wall ? milliseconds(pass.wallEnd - pass.wallBegin)
                                             : milliseconds(pass.begin, pass.end)});
  }
  const Pass& first = frame.passes.front();
  const Pass& last = frame.passes.back();
  times.wholeMilliseconds =
      wall ? milliseconds(last.wallEnd - first.wallBegin) : milliseconds(first.begin, last.end);
  return times;
}

void PassTimer::recycle(Frame& frame) {
  for (Pass& pass : frame.passes) {
    for (Object* query : {&pass.begin, &pass.end}) {
      if (query->name() != 0) spares_.push_back(std::move(*query));
    }
  }
}

}  // namespace grisaille::opengl
