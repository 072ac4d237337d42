#include "sender.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace zwang::connect {
namespace {

Sender sender(std::uint8_t of) {
  Sender sender{};
  sender[3] = of;
  return sender;
}

TEST(OnePublisher, TheFirstIsObeyedUntilItIsSilent) {
  OnePublisher publisher;
  double time = 0.0;
  for (; time < 5.0; time += 0.5 * OnePublisher::silence) {
    EXPECT_TRUE(publisher.admits(sender(1), time));
    EXPECT_FALSE(publisher.admits(sender(2), time));
  }
  // Another one may take its place, and is then the first.
  time += 1.1 * OnePublisher::silence;
  EXPECT_TRUE(publisher.admits(sender(2), time));
  EXPECT_FALSE(publisher.admits(sender(1), time));
}

TEST(Machine, AProcessWithoutAForeignAddressIsOfThisMachine) {
  const std::vector<Address> own{{127, 0, 0, 1}, {192, 168, 1, 5}, {172, 17, 0, 1}};
  EXPECT_TRUE(is_of_this_machine({{192, 168, 1, 5}}, own));
  EXPECT_TRUE(is_of_this_machine({{127, 0, 0, 1}}, own));
  EXPECT_TRUE(is_of_this_machine({{192, 168, 1, 5}, {172, 17, 0, 1}}, own));
  EXPECT_FALSE(is_of_this_machine({{192, 168, 1, 6}}, own));
  // Both machines have the same virtual network; the other address tells them apart.
  EXPECT_FALSE(is_of_this_machine({{172, 17, 0, 1}, {192, 168, 1, 6}}, own));
  EXPECT_FALSE(is_of_this_machine({}, own));
}

TEST(Machine, HasTheLoopbackAddress) {
  const std::vector<Address> own = own_addresses();
  EXPECT_NE(std::find(own.begin(), own.end(), Address{127, 0, 0, 1}), own.end());
}

}  // namespace
}  // namespace zwang::connect
