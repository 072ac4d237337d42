/// The bytes of a service of ROS 2. Its two middlewares tell in different ways which request a reply is for.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "cdr.hpp"
#include "sender.hpp"

namespace zwang::connect {

/// By the vendor in the writer's GUID, 01.10. rmw_cyclonedds writes 16 bytes ahead of the fields, which the
/// reply repeats; rmw_fastrtps goes by the sample's identity.
bool is_cyclone(const Sender& sender);

/// A request, taken apart.
struct ServiceCall {
  Bytes fields;  ///< a payload of its own: `CdrReader` reads it
  bool is_cyclone = false;
  std::uint64_t client = 0;  ///< of Cyclone
  std::int64_t number = 0;   ///< likewise
};
/// nullopt for a request that is damaged.
std::optional<ServiceCall> take_apart(std::span<const std::uint8_t> request, const Sender& sender);
/// The payload of the reply to a call, whose fields are a payload of their own.
Bytes reply_payload(const ServiceCall& call, const Bytes& fields);

/// Sends the reply to one request, now or later, from any thread. Once the service has ended it does nothing.
using Reply = std::function<void(const Bytes& fields)>;
/// Takes a request's fields. It must not throw. A request without a reply is one that was not understood.
using Handler = std::function<void(std::span<const std::uint8_t> fields, const Reply& reply)>;

/// The reply of std_srvs/Trigger, whose request is empty.
struct TriggerReply {
  bool success = false;
  std::string message;
};
/// Answers a service of the type std_srvs/srv/Trigger.
Handler trigger_handler(std::function<TriggerReply()> answer);

/// As DDS knows them: `rq/zwang/startRequest`, `rr/zwang/startReply`.
std::string dds_request(const std::string& service);
std::string dds_reply(const std::string& service);

}  // namespace zwang::connect
