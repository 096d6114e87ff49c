#include "base/handover.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <stdexcept>
#include <thread>

namespace lucarne::handover_test {
namespace {

TEST(Handover, AllWorkIsDoneByTheThreadThatServes) {
  Handover handover;
  const std::thread::id here = std::this_thread::get_id();
  int done = 0;  // no atomic: one thread adds
  handover.serve([&] {
    EXPECT_NE(std::this_thread::get_id(), here);
    tbb::parallel_for(0, 1000, [&](int) {
      int before = -1;
      handover.run([&] {
        EXPECT_EQ(std::this_thread::get_id(), here);
        before = done++;
      });
      EXPECT_GE(before, 0);  // it is done when run() returns
    });
  });
  EXPECT_EQ(done, 1000);
}

TEST(Handover, WhatTheWorkThrowsEndsThoseWhoMakeItAndIsThrownOn) {
  Handover handover;
  struct Stop {};
  std::atomic<int> ended{0};
  int done = 0;
  EXPECT_THROW(handover.serve([&] {
    std::thread others[3];
    for (std::thread& t : others) {
      t = std::thread([&] {
        try {
          for (;;) handover.run([&] { if (++done > 20) throw Stop(); });
        } catch (const std::runtime_error&) {
          ++ended;
        }
      });
    }
    for (std::thread& t : others) t.join();
  }), Stop);
  EXPECT_EQ(ended, 3);
  EXPECT_EQ(done, 21);
}

TEST(Handover, WhatTheMakerThrowsIsThrownOn) {
  Handover handover;
  EXPECT_THROW(handover.serve([] { throw std::domain_error("made up"); }), std::domain_error);
}

}  // namespace
}  // namespace lucarne::handover_test
