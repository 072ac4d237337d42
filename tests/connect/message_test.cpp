#include "message.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "../is_long.hpp"

#ifdef ZWANG_WITH_FASTCDR
#include <fastcdr/Cdr.h>
#endif

namespace zwang::connect {
namespace {

JointState two_joints() {
  return {{17, 250'000'000, "base_link"}, {"left_wheel", "right"}, {1.5, -2.5}, {0.25, 1e-300}, {}};
}

template <typename Message>
Bytes encoded(const Message& message) {
  Bytes bytes;
  encode(message, bytes);
  return bytes;
}

template <typename Message>
void expect_same_again(const Message& message) {
  const Bytes bytes = encoded(message);
  const auto read = decode<Message>(bytes);
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(encoded(*read), bytes);
  // Whatever is cut off by four bytes or more is no message.
  for (std::size_t n = 0; n + 4 <= bytes.size(); ++n)
    EXPECT_FALSE(decode<Message>(std::span(bytes).first(n)).has_value()) << n;
}

LaserScan scan() {
  LaserScan scan{{1, 2, "laser"}, {-0.2F, 0.2F, 0.1F, 0, 0, 0.1F, 10.0F}, {5, 3, 0.01F, 4, INFINITY}, {}};
  return scan;
}

TEST(Message, ComesBackAsItWas) {
  expect_same_again(two_joints());
  expect_same_again(Odometry{{1, 2, "odom"}, "base_link", {1, 2, 3, 0, 0, 0, 1}, {}, {1, 2, 3, 4, 5, 6}, {}});
  expect_same_again(Twist{{1, 2, 3, 4, 5, 6}});
  expect_same_again(TwistStamped{{1, 2, "x"}, {1, 2, 3, 4, 5, 6}});
  expect_same_again(PoseStamped{{1, 2, "map"}, {1, 2, 3, 0, 0, 0, 1}});
  expect_same_again(PoseWithCovarianceStamped{{1, 2, "map"}, {1, 2, 3, 0, 0, 0, 1}, {}});
  expect_same_again(WrenchStamped{{1, 2, "bumper"}, {1, 2, 3, 4, 5, 6}});
  expect_same_again(
      TransformsMessage{{{{1, 2, "map"}, "odom", {1, 2, 3, 0, 0, 0, 1}}, {{}, "base_link", {}}}});
  expect_same_again(Float64{1.25});
  expect_same_again(Float64MultiArray{{{"rows", 2, 2}}, 0, {1, 2}});
  expect_same_again(scan());
  expect_same_again(ClockMessage{12, 345'000'000});
}

// XCDR1 by hand: header, then each value at a multiple of its own size from behind the header.
TEST(Message, IsEncodedAsXcdr1Says) {
  EXPECT_EQ(encoded(Bool{true}), (Bytes{0, 1, 0, 0, 1}));
  EXPECT_EQ(encoded(Float64{1.0}), (Bytes{0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f}));
  EXPECT_EQ(encoded(ClockMessage{1, 2}), (Bytes{0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0}));
  EXPECT_EQ(dds_type(lang::to_string(lang::MessageType::clock)), "rosgraph_msgs::msg::dds_::Clock_");
  // No dimensions, offset 0, one value, padded to 16.
  EXPECT_EQ(encoded(Float64MultiArray{{}, 0, {1.0}}), (Bytes{0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,    1,   0, 0,
                                                             0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f}));
}

TEST(Message, OfAnOutputIsABoolOrANumber) {
  using lang::MessageType;
  EXPECT_EQ(read_output(MessageType::boolean, encoded(Bool{true})), 1.0);
  EXPECT_EQ(read_output(MessageType::boolean, encoded(Bool{false})), 0.0);
  EXPECT_EQ(read_output(MessageType::float64, encoded(Float64{-0.25})), -0.25);
  EXPECT_FALSE(read_output(MessageType::float64, encoded(Float64{NAN})).has_value());
  EXPECT_FALSE(read_output(MessageType::float64, encoded(Bool{true})).has_value());
  EXPECT_FALSE(read_output(MessageType::boolean, encoded(Float64{1.0})).has_value());
}

TEST(Message, IsReadInEitherByteOrder) {
  const Bytes big{0, 0, 0, 0, 0x3f, 0xf0, 0, 0, 0, 0, 0, 0};
  const auto read = decode<Float64>(big);
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->data, 1.0);
}

TEST(Message, OfACountThatLiesAsksForNoMemory) {
  Bytes bytes = encoded(Float64MultiArray{{}, 0, {1.0}});
  for (const std::size_t count_at : {4U, 12U}) {
    Bytes lying = bytes;
    for (std::size_t i = 0; i < 4; ++i) lying[count_at + i] = 0xff;
    EXPECT_FALSE(decode<Float64MultiArray>(lying).has_value());
  }
}

/// Any bytes are read as every message: a sanitizer sees what is touched.
TEST(Message, OfAnyBytesIsReadWithinThem) {
  std::mt19937 random(1);
  const std::vector<Bytes> seeds{encoded(two_joints()), encoded(scan()), encoded(Odometry{}),
                                 encoded(TransformsMessage{{{{1, 2, "map"}, "odom", {}}, {}}}),
                                 encoded(Float64MultiArray{{{"rows", 2, 2}}, 0, {1, 2}})};
  const int rounds = zwang::test::is_long() ? 1'000'000 : 20'000;
  for (int round = 0; round < rounds; ++round) {
    Bytes bytes = seeds[random() % seeds.size()];
    for (unsigned changes = random() % 8; changes > 0; --changes)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    bytes.resize(random() % (bytes.size() + 1));
    if (const auto joints = decode<JointState>(bytes)) {
      EXPECT_LE(joints->names.size(), bytes.size());
    }
    if (const auto read = decode<LaserScan>(bytes)) (void)read->nearest(-1.0, 1.0);
    (void)decode<Odometry>(bytes), (void)decode<Float64MultiArray>(bytes), (void)decode<Twist>(bytes);
    (void)decode<PoseWithCovarianceStamped>(bytes), (void)decode<WrenchStamped>(bytes),
        (void)decode<Bool>(bytes);
    (void)decode<TwistStamped>(bytes), (void)decode<PoseStamped>(bytes),
        (void)decode<TransformsMessage>(bytes);
    (void)decode<ClockMessage>(bytes), (void)decode<Float64>(bytes);
  }
}

TEST(Message, OfAScanTellsTheNearestValidRange) {
  // 5 m at -0.2, 3 m at -0.1, too near at 0, 4 m at 0.1, nothing at 0.2 rad.
  EXPECT_EQ(scan().nearest(-0.25, 0.25), 3.0);
  EXPECT_EQ(scan().nearest(0.05, 0.25), 4.0);
  EXPECT_FALSE(scan().nearest(-0.05, 0.05).has_value());
}

/// The same rays, counted from 0 to 2 pi or below -pi, stand where they stood.
TEST(Message, OfAScanKnowsThatAnglesRepeat) {
  for (const double turns : {-1.0, 1.0, 2.0}) {
    LaserScan turned = scan();
    std::get<0>(turned.facts) += static_cast<float>(turns * 2.0 * std::numbers::pi);
    EXPECT_EQ(turned.nearest(-0.25, 0.25), 3.0);
    EXPECT_EQ(turned.nearest(0.05, 0.25), 4.0);
    EXPECT_EQ(turned.nearest(2.0 * std::numbers::pi - 0.25, 2.0 * std::numbers::pi + 0.25), 3.0);
    EXPECT_FALSE(turned.nearest(-0.05, 0.05).has_value());
  }
}

TEST(Message, HasTheNamesOfRos2) {
  EXPECT_EQ(dds_type("geometry_msgs/TwistStamped"), "geometry_msgs::msg::dds_::TwistStamped_");
  EXPECT_EQ(dds_type("std_srvs/srv/Trigger"), "std_srvs::srv::dds_::Trigger_");
  EXPECT_EQ(dds_topic("/cmd_vel"), "rt/cmd_vel");
  EXPECT_NEAR(header_at(1.79e9 + 0.25).stamp(), 1.79e9 + 0.25, 1e-6);
  EXPECT_LT(header_at(0.9999999999).nanoseconds, 1'000'000'000U);
}

#ifdef ZWANG_WITH_FASTCDR
/// As rmw_fastrtps writes a JointState: the generated code serialises the fields in their order.
TEST(Message, OfJointsHasTheBytesOfFastCdr) {
  const JointState message = two_joints();
  char buffer[1024] = {};  // Fast CDR leaves padding as it was
  eprosima::fastcdr::FastBuffer memory(buffer, sizeof(buffer));
  eprosima::fastcdr::Cdr cdr(memory, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS,
                             eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  cdr << message.header.seconds << message.header.nanoseconds << message.header.frame;
  cdr << message.names << message.positions << message.velocities << message.efforts;
  EXPECT_EQ(encoded(message), Bytes(buffer, buffer + cdr.getSerializedDataLength()));
}
#endif

}  // namespace
}  // namespace zwang::connect
