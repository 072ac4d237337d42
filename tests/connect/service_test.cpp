#include "service.hpp"

#include <gtest/gtest.h>

#include <random>
#include <span>

namespace zwang::connect {
namespace {

constexpr Sender fast{0x01, 0x0f}, cyclone{0x01, 0x10};

/// The empty request of XCDR1 is one octet; Cyclone's has its client and a number in front.
Bytes request_of(const Sender& sender, std::uint64_t client, std::int64_t number) {
  Bytes bytes;
  CdrWriter write(bytes);
  if (is_cyclone(sender)) write(client), write(number);
  write(std::uint8_t{0});
  return bytes;
}

/// The payload that answers a request of Trigger; nullopt where none does.
std::optional<Bytes> trigger_reply(std::span<const std::uint8_t> request, const Sender& sender,
                                   const TriggerReply& told) {
  const auto call = take_apart(request, sender);
  if (!call) return std::nullopt;
  std::optional<Bytes> payload;
  trigger_handler([&] { return told; })(call->fields,
                                        [&](const Bytes& fields) { payload = reply_payload(*call, fields); });
  return payload;
}

TEST(Service, AReplyHasItsFields) {
  const auto reply = trigger_reply(request_of(fast, 0, 0), fast, {true, "the task begins"});
  ASSERT_TRUE(reply);
  CdrReader read(*reply);
  bool success = false;
  std::string message;
  read(success), read(message);
  EXPECT_TRUE(read.is_at_end());
  EXPECT_TRUE(success);
  EXPECT_EQ(message, "the task begins");
}

TEST(Service, AReplyToCycloneRepeatsClientAndNumber) {
  const auto reply = trigger_reply(request_of(cyclone, 0x1122334455667788U, -7), cyclone, {false, "no"});
  ASSERT_TRUE(reply);
  CdrReader read(*reply);
  std::uint64_t client = 0;
  std::int64_t number = 0;
  bool success = true;
  std::string message;
  read(client), read(number), read(success), read(message);
  EXPECT_TRUE(read.is_at_end());
  EXPECT_EQ(client, 0x1122334455667788U);
  EXPECT_EQ(number, -7);
  EXPECT_FALSE(success);
  EXPECT_EQ(message, "no");
}

TEST(Service, ARequestThatIsCutIsNotAnswered) {
  const Bytes whole = request_of(cyclone, 1, 2);
  for (std::size_t n = 0; n < 4 + 16; ++n)
    EXPECT_FALSE(trigger_reply(std::span(whole).first(n), cyclone, {})) << n;
  EXPECT_FALSE(trigger_reply({}, fast, {}));
  std::mt19937 random(24);
  for (int i = 0; i < 1000; ++i) {
    Bytes bytes(random() % 64);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    trigger_reply(bytes, i % 2 == 0 ? fast : cyclone, {});
  }
}

TEST(Service, NamesAreThoseOfRos2) {
  EXPECT_EQ(dds_request("/zwang/start"), "rq/zwang/startRequest");
  EXPECT_EQ(dds_reply("/zwang/start"), "rr/zwang/startReply");
}

}  // namespace
}  // namespace zwang::connect
