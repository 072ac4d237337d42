/// The bytes of a service of ROS 2. Its two middlewares tell in different ways which request a reply is for.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "cdr.hpp"
#include "sender.hpp"

namespace zwang::connect {

/// The reply of std_srvs/Trigger, whose request is empty.
struct TriggerReply {
  bool success = false;
  std::string message;
};

/// By the vendor in the writer's GUID, 01.10. rmw_cyclonedds writes 16 bytes ahead of the fields, which the
/// reply repeats; rmw_fastrtps goes by the sample's identity.
bool is_cyclone(const Sender& sender);

/// The reply to a request of Trigger; nullopt for a request that is damaged.
std::optional<Bytes> trigger_reply(std::span<const std::uint8_t> request, const Sender& sender,
                                   const TriggerReply& reply);

/// As DDS knows them: `rq/zwang/startRequest`, `rr/zwang/startReply`.
std::string dds_request(const std::string& service);
std::string dds_reply(const std::string& service);

}  // namespace zwang::connect
