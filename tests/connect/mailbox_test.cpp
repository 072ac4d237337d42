#include "mailbox.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace zwang::connect {
namespace {

TEST(Mailbox, HandsOverTheLatestValueOnce) {
  Mailbox<int> box(0);
  EXPECT_FALSE(box.take());
  for (const int value : {1, 2, 3}) {
    box.draft() = value;
    box.put();
  }
  EXPECT_TRUE(box.take());
  EXPECT_EQ(box.value(), 3);
  EXPECT_FALSE(box.take());
  EXPECT_EQ(box.value(), 3);
}

TEST(Mailbox, NeverHandsOverHalfAValue) {
  struct Pair {
    int a = 0, b = 0;
  };
  constexpr int last = 20'000;
  Mailbox<Pair> box;
  std::thread putting([&box] {
    for (int i = 1; i <= last; ++i) {
      box.draft() = {i, -i};
      box.put();
    }
  });
  int before = 0;
  while (before < last) {
    if (!box.take()) continue;
    ASSERT_EQ(box.value().a, -box.value().b);
    ASSERT_GT(box.value().a, before);
    before = box.value().a;
  }
  putting.join();
}

}  // namespace
}  // namespace zwang::connect
